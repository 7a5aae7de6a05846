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
    if (making_.running()) return false;
    DepthOffer offer{.colour = colour,
                     .text =
                         "There is no depth in it or beside it. Open it together with its "
                         "depth file, or let an estimator make it."};
    for (const Estimator& one : state.settings.estimators) offer.estimators.push_back(one.name);
    state.ui.depth_offer = std::move(offer);
    return true;
}

void ViewerEstimating::withdraw_offer(ViewerState& state) const {
    if (!making_.running() && state.ui.depth_offer && state.ui.depth_offer->depth.empty())
        state.ui.depth_offer.reset();
}

void ViewerEstimating::start(const Estimator& estimator, ViewerState& state) {
    DepthOffer& offer = *state.ui.depth_offer;
    const EstimateRequest request{.colour = offer.colour,
                                  .command = estimator.command,
                                  .meaning = estimator.meaning,
                                  .cache = depth_cache_path(),
                                  .priority = ChildPriority::low};
    const auto watch = std::make_shared<EstimateWatch>();
    if (!making_.start([request, watch] { return make(request, *watch); })) return;
    watch_ = watch;
    open_before_ = file_shown(state);
    offer.text.clear();
    offer.unconfirmed_command.clear();
    offer.progress.emplace();
}

std::optional<OpenRequest> ViewerEstimating::perform(DepthOfferCommand command,
                                                     ViewerState& state) {
    if (!state.ui.depth_offer) return {};
    const auto chosen = static_cast<std::size_t>(state.ui.depth_offer->chosen);
    const auto& estimators = state.settings.estimators;
    const bool runs = command == DepthOfferCommand::make || command == DepthOfferCommand::agree;
    if (runs && chosen >= estimators.size()) return {};
    switch (command) {
        case DepthOfferCommand::make:
            if (Consent().has_agreed_to(estimators[chosen].command))
                start(estimators[chosen], state);
            else
                state.ui.depth_offer->unconfirmed_command =
                    escaped_text(estimators[chosen].command);
            return {};
        case DepthOfferCommand::agree:
            start(estimators[chosen], state);
            Consent().agree(estimators[chosen].command);
            return {};
        case DepthOfferCommand::cancel:
            if (watch_) watch_->stop();
            state.ui.depth_offer->ending = true;
            return {};
        case DepthOfferCommand::open:
            return take_open_request(state);
        case DepthOfferCommand::close:
            state.ui.depth_offer.reset();
            return {};
    }
    return {};
}

std::optional<OpenRequest> ViewerEstimating::take_open_request(ViewerState& state) {
    OpenRequest request{state.ui.depth_offer->colour, state.ui.depth_offer->depth};
    state.ui.depth_offer.reset();
    return request;
}

std::optional<OpenRequest> ViewerEstimating::poll(ViewerState& state) {
    if (!state.ui.depth_offer || !watch_) return {};
    DepthOffer& offer = *state.ui.depth_offer;
    if (making_.running()) offer.progress = watch_->progress();
    const auto made = making_.take();
    if (!made) return {};
    watch_.reset();
    offer.progress.reset();
    const bool cancelled = std::exchange(offer.ending, false);
    if (!made->depth) {
        offer.text = cancelled && made->failure.empty()
                         ? "Cancelled; what is done is kept for the next time."
                         : made->failure;
        return {};
    }
    offer.depth = made->depth->depth;
    if (file_shown(state) != open_before_) return {};
    return take_open_request(state);
}

void ViewerEstimating::end() {
    if (watch_) watch_->stop_at_once();
}

}  // namespace dibhr
