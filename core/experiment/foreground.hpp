// Where on the image somebody stands.
#pragma once

#include "core/haptics/vec.hpp"
#include "core/video/depth_in_time.hpp"

namespace dibhr {

/// An upright rectangle of the image [px].
struct ImageArea {
    Vec2 centre{0.0};
    Vec2 half_size{0.0};
};

/// The largest rectangle that stands out from the background all the time: all its vertices are
/// above a quarter of the height at ten moments of the clip. A little of its border is left out.
/// The whole image when nothing stands out.
[[nodiscard]] ImageArea foreground_area(const DepthClip& clip);

}  // namespace dibhr
