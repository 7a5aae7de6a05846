// Leads a person through the first touch at the first start: press, stroke, choose a material.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/task_group.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/guide/regions.hpp"

namespace dibhr {

/// Shows the steps and takes no input: each step ends when the person has done it, or after 6.5 s.
/// A finger that moves on the jumper prolongs the step of the stroke.
class ViewerLead {
  public:
    /// The sample is shown: leads, unless somebody was led before, or the regions lack the nose or
    /// the jumper. `saving` must outlive this object; it keeps in the user's state folder that the
    /// first step was shown.
    void begin(std::shared_ptr<const Regions> regions, const ViewerState& state, TaskQueue& saving);
    void end(ViewerState& state);

    /// Once a turn, after the guide has named the region that is touched.
    void follow(const DepthBlend& shown, double now_s, ViewerState& state);

  private:
    void keep_led() const;
    void begin_step(LeadStep step, ViewerState& state);
    void find_nose(const DepthBlend& shown);
    void find_jumper(const DepthBlend& shown);
    [[nodiscard]] bool is_done(const DepthBlend& shown, const ViewerState& state);

    /// A place in the label picture, as shares of its width and height.
    struct Place {
        double x{0.0}, y{0.0};
    };

    std::shared_ptr<const Regions> regions_{};  // null: does not lead
    TaskQueue* saving_{nullptr};
    std::string material_{};            // when the lead began
    Place from_{}, to_{};               // of the way; of the nose only from_
    std::optional<int> picture_{};      // the label picture in which they were found
    double turn_s_{0.0};                // when the last turn was
    double time_s_{0.0};                // since the first step began
    double since_s_{0.0};               // of that time, when this step began
    double until_s_{0.0};               // likewise, when it ends
    std::optional<double> done_s_{};    // likewise, when the person had done it
    std::optional<Vec3> stroked_to_{};  // the proxy on the jumper in the last turn
    double stroked_px_{0.0};
};

}  // namespace dibhr
