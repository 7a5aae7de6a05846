// Which poses of a device belong together.
#pragma once

#include <cstdint>

namespace dibhr {

/// Poses of one epoch belong together; a new one begins with every link and whenever a device's
/// position jumps, as a Falcon's does with every homing.
using Epoch = std::uint32_t;
inline constexpr Epoch kNoEpoch = 0;  ///< positions mean nothing: not ready, or no link

}  // namespace dibhr
