// Runs a depth estimator for a video without depth, while the window goes on.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/estimators.hpp"
#include "app/viewer/task_group.hpp"
#include "core/estimate/depth_estimate.hpp"

namespace dibhr {

/// Result of an estimator.
struct EstimateMade {
    std::optional<DepthEstimate> depth{};  ///< nothing: cancelled or failed
    std::string failure{};
};

class ViewerEstimating {
  public:
    /// The task group must outlive it.
    explicit ViewerEstimating(TaskGroup& tasks) : making_(tasks) {}

    /// Offers to make depth for a video that has none. False while an estimator runs.
    bool offer(const std::filesystem::path& colour, ViewerState& state);

    /// Withdraws an offer that was not used, as other files were opened.
    void withdraw_offer(ViewerState& state) const;

    /// Does what the user chose. Returns what to open then, if anything. Asks for consent before a
    /// new command runs. Throws InputError where the consent cannot be saved.
    [[nodiscard]] std::optional<OpenRequest> perform(DepthOfferCommand command, ViewerState& state);

    /// Once a turn: updates the progress. Returns what to open, once the depth is made and no
    /// other file was opened meanwhile.
    [[nodiscard]] std::optional<OpenRequest> poll(ViewerState& state);

    /// At the end of the program: ends the estimator.
    void end();

  private:
    void start(const Estimator& estimator, ViewerState& state);
    [[nodiscard]] std::optional<OpenRequest> take_open_request(ViewerState& state);

    BackgroundTask<EstimateMade> making_;
    std::shared_ptr<EstimateWatch> watch_{};
    std::filesystem::path open_before_{};  ///< the file that was shown when the estimator started
};

}  // namespace dibhr
