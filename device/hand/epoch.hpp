// Epochs: poses of one epoch have the same origin.
#pragma once

#include <cstdint>

namespace dibhr {

/// Poses of one epoch can be compared. A new epoch begins with every link, and whenever the
/// position of the device jumps, as that of a Falcon does at every homing.
using Epoch = std::uint32_t;
inline constexpr Epoch kNoEpoch = 0;  ///< no valid positions: not ready, or no link

}  // namespace dibhr
