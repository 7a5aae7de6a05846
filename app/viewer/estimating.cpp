// A background task for the estimator, and its state on the panel.
#include "app/viewer/estimating.hpp"

#include <cstddef>
#include <exception>
#include <utility>

#include "app/settings/consent.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

const fs::path& file_shown(const ViewerState& state) {
    return state.touch.replay ? state.touch.replay->file : state.media.colour_path;
}

EstimateMade make(const EstimateRequest& request, EstimateWatch& watch) {
    try {
        return {estimate_depth(request, watch), {}};
    } catch (const std::exception& error) {
        return {{}, error.what()};
    }
}

}  // namespace

bool ViewerEstimating::offer(const fs::path& colour, ViewerState& state) {
    if (making_.under_way()) return false;
    DepthOffer offer{.colour = colour,
                     .words =
                         "There is no depth in it or beside it. Open it together with its "
                         "depth file, or let an estimator make it."};
    for (const Estimator& one : state.settings.estimators) offer.estimators.push_back(one.name);
    state.ui.depth_offer = std::move(offer);
    return true;
}

void ViewerEstimating::something_opened(ViewerState& state) const {
    if (!making_.under_way() && state.ui.depth_offer && state.ui.depth_offer->depth.empty())
        state.ui.depth_offer.reset();
}

void ViewerEstimating::start(const Estimator& estimator, ViewerState& state) {
    DepthOffer& offer = *state.ui.depth_offer;
    const EstimateRequest request{.colour = offer.colour,
                                  .command = estimator.command,
                                  .meaning = estimator.meaning,
                                  .cache = depth_cache_path(),
                                  .manner = ChildManner::polite};
    const auto watch = std::make_shared<EstimateWatch>();
    if (!making_.start([request, watch] { return make(request, *watch); })) return;
    watch_ = watch;
    open_before_ = file_shown(state);
    offer.words.clear();
    offer.asks.clear();
    offer.progress.emplace();
}

std::optional<OpenRequest> ViewerEstimating::perform(DepthWish wish, ViewerState& state) {
    if (!state.ui.depth_offer) return {};
    const auto chosen = static_cast<std::size_t>(state.ui.depth_offer->chosen);
    const auto& estimators = state.settings.estimators;
    const bool runs = wish == DepthWish::make || wish == DepthWish::agree;
    if (runs && chosen >= estimators.size()) return {};
    switch (wish) {
        case DepthWish::make:
            if (Consent().knows(estimators[chosen].command))
                start(estimators[chosen], state);
            else
                state.ui.depth_offer->asks = escaped_text(estimators[chosen].command);
            return {};
        case DepthWish::agree:
            start(estimators[chosen], state);
            Consent().agree(estimators[chosen].command);
            return {};
        case DepthWish::cancel:
            if (watch_) watch_->stop();
            state.ui.depth_offer->ending = true;
            return {};
        case DepthWish::open:
            return opened(state);
        case DepthWish::close:
            state.ui.depth_offer.reset();
            return {};
    }
    return {};
}

std::optional<OpenRequest> ViewerEstimating::opened(ViewerState& state) {
    OpenRequest request{state.ui.depth_offer->colour, state.ui.depth_offer->depth};
    state.ui.depth_offer.reset();
    return request;
}

std::optional<OpenRequest> ViewerEstimating::take_news(ViewerState& state) {
    if (!state.ui.depth_offer || !watch_) return {};
    DepthOffer& offer = *state.ui.depth_offer;
    if (making_.under_way()) offer.progress = watch_->progress();
    const auto made = making_.take();
    if (!made) return {};
    watch_.reset();
    offer.progress.reset();
    const bool cancelled = std::exchange(offer.ending, false);
    if (!made->depth) {
        offer.words = cancelled && made->failure.empty()
                          ? "Cancelled; what is done is kept for the next time."
                          : made->failure;
        return {};
    }
    offer.depth = made->depth->depth;
    if (file_shown(state) != open_before_) return {};
    return opened(state);
}

void ViewerEstimating::end() {
    if (watch_) watch_->stop_at_once();
}

}  // namespace dibhr
