// Timing of pictures: the least time from one to the next, and heartbeats while one is drawn.
#pragma once

#include <chrono>
#include <functional>

namespace dibhr {

/// Least time between two pictures; zero without `sync`. `software`: the processor draws.
[[nodiscard]] std::chrono::nanoseconds least_picture_time(bool sync, bool software);

/// Calls `beat` while the processor's threads draw, for a second at most. Software drawing can take
/// long on a busy machine; the window handles no keys meanwhile, but it is not hung.
void beat_while_drawing(const std::function<void()>& beat);

}  // namespace dibhr
