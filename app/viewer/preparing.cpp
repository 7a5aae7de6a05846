// A background task that cleans, and its state on the panel.
#include "app/viewer/preparing.hpp"

#include <sys/resource.h>

#include <exception>
#include <utility>

#include "app/settings/settings.hpp"
#include "app/touching/touch_session.hpp"

namespace dibhr {

namespace {

constexpr int kLowPriority = 10;  // touching and drawing come first

template <typename Watch>
PreparingEnd prepared(const OpenRequest& open, const CleaningOptions& cleaning, Watch& watch) {
    setpriority(PRIO_PROCESS, 0, kLowPriority);  // of this thread and those that it starts
    try {
        const PrepareRequest request{.cache = prepared_cache_path(),
                                     .cleaning = cleaning,
                                     .most_bytes = kMostPreparedBytes,
                                     .progress = [&watch](double share) {
                                         watch.share = share;
                                         return !watch.stops;
                                     }};
        return {prepare(open_media(open.colour, open.depth, open.request), request), {}};
    } catch (const std::exception& error) {
        return {{}, error.what()};
    }
}

}  // namespace

void ViewerPreparing::begin_or_cancel(ViewerState& state) {
    if (watch_) {
        watch_->stops = true;
        return;
    }
    const MediaState& media = state.media;
    OpenRequest open{media.colour_path, media.depth_path, false, media.opened.request};
    const auto watch = std::make_shared<Watch>();
    const CleaningOptions cleaning = wanted_cleaning(state.settings, media);
    if (!making_.start([open, cleaning, watch] { return prepared(open, cleaning, *watch); }))
        return;
    watch_ = watch;
    prepares_ = std::move(open);
}

bool ViewerPreparing::shows_prepared(const ViewerState& state) const {
    return !state.touch.replay && state.media.colour_path == prepares_.colour &&
           state.media.depth_path == prepares_.depth;
}

std::optional<PreparingEnd> ViewerPreparing::poll(ViewerState& state) {
    state.ui.preparing.reset();
    if (!watch_) return {};
    state.ui.preparing = {
        .share = watch_->share,
        .file = shows_prepared(state) ? std::string() : prepares_.colour.filename().string()};
    auto end = making_.take();
    if (!end) return {};
    watch_.reset();
    state.ui.preparing.reset();
    return end;
}

void ViewerPreparing::end() {
    if (watch_) watch_->stops = true;
}

}  // namespace dibhr
