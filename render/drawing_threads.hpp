// The threads that software OpenGL draws with, and their share of the processor.
#pragma once

namespace dibhr {

/// The `nice` value of drawing above that of decoding and cleaning: drawing gets a quarter of a
/// core that both need. A late picture is less visible than a late frame, and cannot be felt.
inline constexpr int kDrawingNiceness = 5;

/// Lowers the priority of the driver's threads of software OpenGL; call it when there is a context.
/// The driver has a thread on each core; together they would take half of a busy machine. They and
/// the calling thread, which waits for them, get long time slices (core/realtime/time_slice.hpp),
/// so that they do not delay threads with deadlines, such as a device's service. Of little use
/// where a graphics card draws.
void lower_drawing_priority();

/// Processor time that those threads and the calling one have taken [s].
[[nodiscard]] double drawing_s();

}  // namespace dibhr
