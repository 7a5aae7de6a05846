// The version of how surfaces are made of files.
#pragma once

namespace dibhr {

/// Raised whenever the same file and steps give another surface than before, as when holes, spikes,
/// terraces, the true shape or motion are computed differently. A replay of an older session then
/// reports it. 1: version 0.1 and earlier. 2: pits, holes that keep their level, lenses. 3:
/// silhouettes, time and noise; 8-bit steps in 128ths of a level. 4: silhouettes stay within the
/// levels, and there are none in a picture of more than 3 million ramps. 5: time reaches 16 frames
/// far, noise is weighed band by band; outlines without teeth, ramps as a whole; plain things move
/// as their outlines do.
inline constexpr int kSurfaceVersion = 5;

}  // namespace dibhr
