// What guides whoever touches a recording: the region under the finger, outlines as ridges, and
// captions.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/painting/painting.hpp"
#include "app/viewer/task_group.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/guide/captions.hpp"
#include "core/video/guide/regions.hpp"
#include "core/video/playing/player.hpp"

namespace dibhr {

/// What lies beside a recording for that, or why it cannot be read.
struct FoundGuide {
    FoundRegions regions{};
    std::shared_ptr<const Captions> captions{};  ///< null: there are none
    std::string trouble{};
};

/// Reads files: not for the window's thread.
[[nodiscard]] FoundGuide find_guide(const MediaDescription& media);

class ViewerGuide {
  public:
    /// The task group must outlive it.
    explicit ViewerGuide(TaskGroup& tasks) : raising_(tasks) {}

    /// A recording was opened.
    void begin(const FoundGuide& found, ViewerState& state);
    [[nodiscard]] const std::shared_ptr<const Regions>& regions() const { return regions_; }
    /// The regions, which may have been painted since.
    void show(const std::shared_ptr<const Regions>& regions, ViewerState& state);

    /// Once a turn, after the frames of this turn are known: shows the caption, and names the
    /// region that is touched.
    void follow(const DepthBlend& shown, double now_s, ViewerState& state);
    /// Once a turn: lays the ridges of the shown moment over what is painted, or takes them off.
    void follow_ridges(const DepthBlend& shown, const ViewerState& state, ViewerPainting& painting,
                       Player& player);

  private:
    void take(const std::shared_ptr<const Regions>& regions, ViewerState& state);
    void follow_finger(const DepthBlend& shown, double now_s, ViewerState& state);
    /// What the ridges were laid over, and of which label picture they are.
    struct Ridges {
        std::shared_ptr<const TouchMaps> painted{};
        std::shared_ptr<const Regions> regions{};
        std::optional<int> picture{};  ///< nothing: no ridges
        bool operator==(const Ridges&) const = default;
    };
    struct Raised {
        Ridges of{};
        std::shared_ptr<const TouchMaps> maps{};
    };

    /// The same number for the same ridges over the same paint.
    [[nodiscard]] std::uint32_t version_of(const Ridges& ridges, ViewerPainting& painting);

    std::shared_ptr<const Regions> regions_{};
    std::shared_ptr<const Captions> captions_{};
    const Region* touched_{nullptr};  // of regions_
    glm::dvec2 rested_at_{0.0};       // where the hand did
    double rested_since_s_{0.0};
    double left_s_{0.0};  // when it was last touched
    Ridges laid_{};
    std::shared_ptr<const TouchMaps> numbered_for_{};
    std::map<int, std::uint32_t> versions_{};
    BackgroundTask<Raised> raising_;
};

}  // namespace dibhr
