// The threads that software OpenGL draws with, and their share of the processor.
#pragma once

namespace dibhr {

/// How much less urgent drawing is than decoding and cleaning, as `nice` counts: a quarter of the
/// time of a core that both want. A late picture is seen less than a late video is, and felt not at
/// all.
inline constexpr int kDrawingNiceness = 5;

/// Lets the driver's own threads give way to the rest of the program, once there is a context:
/// each core has one, and together they would take half of a busy machine. They and the calling
/// thread, which waits for them, take long turns (core/realtime/time_slice.hpp), so that what a
/// hand is waited for by, a device's service among it, need not wait for them. For software alone:
/// where a graphics card draws there is little to give way.
void let_drawing_give_way();

}  // namespace dibhr
