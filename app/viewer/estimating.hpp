// Depth that is made for a video of colour alone while the window goes on.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/estimators.hpp"
#include "app/viewer/errand.hpp"
#include "core/estimate/depth_estimate.hpp"

namespace dibhr {

/// What came of one.
struct EstimateMade {
    std::optional<DepthEstimate> depth{};  ///< nothing: it was cancelled, or failed
    std::string failure{};
};

class ViewerEstimating {
  public:
    /// `errands` outlives it.
    explicit ViewerEstimating(Errands& errands) : making_(errands) {}

    /// For a video that could not be opened. False while depth is made for another one.
    bool offer(const std::filesystem::path& colour, ViewerState& state);

    /// Whoever has opened something else wants no more of an offer that was not taken.
    void something_opened(ViewerState& state) const;

    /// What a person wants of it. What is to be opened then, if anything. A command to which nobody
    /// has agreed here is asked about before it runs. Throws InputError where that cannot be kept.
    [[nodiscard]] std::optional<OpenRequest> perform(DepthWish wish, ViewerState& state);

    /// Once a picture: how it goes. What is to be opened, once it is made and nothing else was
    /// opened meanwhile.
    [[nodiscard]] std::optional<OpenRequest> take_news(ViewerState& state);

    /// At the end of the program: no estimator is left behind.
    void end();

  private:
    void start(const Estimator& estimator, ViewerState& state);
    [[nodiscard]] std::optional<OpenRequest> opened(ViewerState& state);

    Errand<EstimateMade> making_;
    std::shared_ptr<EstimateWatch> watch_{};
    std::filesystem::path open_before_{};  ///< what was shown when it began
};

}  // namespace dibhr
