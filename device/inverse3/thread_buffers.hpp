// Buffers between the haptic thread and the network thread: the newest pose, the newest force, and
// a wake.
#pragma once

#include <chrono>
#include <cstdint>

#include "core/haptics/vec.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/realtime/wake.hpp"
#include "device/hand/epoch.hpp"

namespace dibhr::inverse3 {

/// A pose as received, in the service's axes.
struct TimedPose {
    Vec3 position_m{0.0};
    std::uint8_t buttons{0};  ///< debounced
    std::chrono::steady_clock::time_point at{};
    Epoch epoch{kNoEpoch};
    std::uint64_t number{0};  ///< counts from 1 since the start
    int exchange_ms{1};       ///< DelayWatch::within_ms()
};

/// A force in the service's axes.
struct TimedForce {
    Vec3 newton{0.0};
    std::chrono::steady_clock::time_point at{};
    Epoch epoch{kNoEpoch};  ///< epoch of the pose that the force was computed for
};

struct ThreadBuffers {
    TripleBuffer<TimedPose> poses{};    ///< network thread to haptic thread
    TripleBuffer<TimedForce> forces{};  ///< haptic thread to network thread
    Wake wake{};
};

}  // namespace dibhr::inverse3
