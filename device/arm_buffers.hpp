// Buffers between the haptic thread and the thread of a device whose arm gives a position in metres
// and takes a force in newtons: the newest pose, the newest force, the limits, and a wake.
#pragma once

#include <chrono>
#include <cstdint>

#include "core/haptics/safety.hpp"
#include "core/haptics/vec.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/realtime/wake.hpp"
#include "device/hand/epoch.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr {

/// A pose as received, in the arm's own axes.
struct TimedPose {
    Vec3 position_m{0.0};
    std::uint8_t buttons{0};  ///< debounced
    std::chrono::steady_clock::time_point at{};
    Epoch epoch{kNoEpoch};
    std::uint64_t number{0};  ///< counts from 1 since the start
    int exchange_ms{1};       ///< DelayWatch::within_ms()
};

/// A force in the arm's own axes.
struct TimedForce {
    Vec3 newton{0.0};
    std::chrono::steady_clock::time_point at{};
    Epoch epoch{kNoEpoch};  ///< epoch of the pose that the force was computed for
};

struct ArmBuffers {
    TripleBuffer<TimedPose> poses{};      ///< the device's thread to the haptic thread
    TripleBuffer<DeviceLimits> limits{};  ///< likewise; of the connected arm, hand millimetres
    TripleBuffer<TimedForce> forces{};    ///< haptic thread to the device's thread
    Wake wake{};

    static constexpr std::chrono::milliseconds kOldestForce{20};

    /// For the device's thread: the newest force. Zero where the force was computed for a pose of
    /// another epoch, is older than 20 ms or not finite, or where the program is about to end.
    [[nodiscard]] Vec3 force_for(Epoch epoch, std::chrono::steady_clock::time_point now) noexcept {
        const TimedForce& requested = forces.front();
        const bool may = epoch != kNoEpoch && requested.epoch == epoch &&
                         now < requested.at + kOldestForce && !Guardian::alarmed() &&
                         is_finite(requested.newton);
        return may ? requested.newton : Vec3{0.0};
    }
};

}  // namespace dibhr
