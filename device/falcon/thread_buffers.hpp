// Buffers between the haptic thread and the USB thread: the newest reply, the newest command, and a
// wake.
#pragma once

#include <chrono>
#include <cstdint>

#include "core/realtime/triple_buffer.hpp"
#include "core/realtime/wake.hpp"
#include "device/falcon/packet.hpp"
#include "device/hand/epoch.hpp"

namespace dibhr::falcon {

struct TimedReply {
    Reply reply{};  ///< with debounced buttons
    std::chrono::steady_clock::time_point at{};
    Epoch epoch{kNoEpoch};
    std::uint64_t number{0};  ///< counts from 1 since the start
    int exchange_ms{1};       ///< DelayWatch::within_ms()
};

struct TimedCommand {
    Counts motor{};
    std::chrono::steady_clock::time_point at{};
    Epoch epoch{kNoEpoch};  ///< epoch of the pose that the command was computed for
};

struct ThreadBuffers {
    TripleBuffer<TimedReply> replies{};     ///< USB thread to haptic thread
    TripleBuffer<TimedCommand> commands{};  ///< haptic thread to USB thread
    Wake wake{};
};

}  // namespace dibhr::falcon
