// What the sound of touch hears of a haptic tick, and the way it takes from the tick to the sound.
#pragma once

#include "core/haptics/vec.hpp"
#include "core/realtime/broadcast_ring.hpp"

namespace dibhr {

inline constexpr double kSoundTicks_hz = 1000.0;
/// When ticks stay away for longer nothing is touched any more.
inline constexpr double kSoundPatience_s = 0.02;

/// One millisecond of touch.
struct SoundTick {
    Vec3 proxy_mm{0.0};        ///< axes of grid space
    double force_newton{0.0};  ///< length of the force sent
    bool contact{false};
    bool force_on{false};  ///< false: nothing may be felt, and so nothing is heard
};

/// For speakers and game pads alike: how many listen costs a tick nothing.
using SoundRing = BroadcastRing<SoundTick, 1024>;
using SoundListener = SoundRing::Listener;

}  // namespace dibhr
