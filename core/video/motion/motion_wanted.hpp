// What of the time between two frames is to be found out.
#pragma once

namespace dibhr {

struct MotionWanted {
    bool motion{false};       ///< where each pixel goes, by which a proxy is carried
    bool in_betweens{false};  ///< what moves is on its way between frames; finds the motion, too

    [[nodiscard]] bool any() const noexcept { return motion || in_betweens; }
    bool operator==(const MotionWanted&) const = default;
};

}  // namespace dibhr
