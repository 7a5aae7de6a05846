// The values of a haptic tick for the sound of touch, and the ring from the tick to the sound.
#pragma once

#include "core/haptics/vec.hpp"
#include "core/realtime/broadcast_ring.hpp"

namespace dibhr {

inline constexpr double kSoundTicks_hz = 1000.0;
/// Timeout of ticks: after it nothing is touched.
inline constexpr double kSoundTimeout_s = 0.02;

/// One millisecond of touch.
struct SoundTick {
    Vec3 proxy_mm{0.0};        ///< axes of grid space
    double force_newton{0.0};  ///< length of the force sent
    bool contact{false};
    bool force_on{false};  ///< false: no force, and so no sound
};

/// For speakers and game pads: the number of listeners costs a tick nothing.
using SoundRing = BroadcastRing<SoundTick, 1024>;
using SoundListener = SoundRing::Listener;

}  // namespace dibhr
