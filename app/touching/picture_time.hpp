// How long a picture may take: at the least, so that others have time, and to be drawn.
#pragma once

#include <chrono>
#include <functional>

namespace dibhr {

/// Least time from picture to picture; zero, not in sync: do not wait. `software`: draws.
[[nodiscard]] std::chrono::nanoseconds shortest_picture(bool sync, bool software);

/// On a busy machine software takes long, and goes on: the processor's threads draw, for a second
/// at most, while this one hears of keys only with the next picture.
void beat_while_drawing(const std::function<void()>& beat);

}  // namespace dibhr
