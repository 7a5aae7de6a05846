// Which way of making surfaces of files this is.
#pragma once

namespace dibhr {

/// One more whenever the same file gives another surface than before, because holes, spikes, steps
/// or the true shape are treated otherwise: who replays an older session is told.
/// 1: version 0.1 and before this was recorded. 2: pits, holes that keep their level, lenses. 3:
/// silhouettes, time and noise; 8-bit steps in 128ths of a level. 4: silhouettes stay within the
/// levels, and there are none in a picture of more than 3 million ramps.
inline constexpr int kSurfaceVersion = 4;

}  // namespace dibhr
