// The 1 kHz thread of the haptic ticks.
#include "core/loop/haptic_loop.hpp"

namespace dibhr {

HapticLoop::HapticLoop(const HapticConnections& connections) : tick_(connections) {
    thread_ = std::thread([this] { run(); });
}

void HapticLoop::stop() noexcept {
    stopping_.store(true, std::memory_order_relaxed);
    if (thread_.joinable()) thread_.join();
}

std::optional<RealtimeGrants> HapticLoop::grants() const {
    if (!granted_.load(std::memory_order_acquire)) return {};
    return grants_;
}

void HapticLoop::run() {
    grants_ = become_realtime("dibhr haptic");
    granted_.store(true, std::memory_order_release);
    while (!stopping_.load(std::memory_order_relaxed)) {
        const TickTiming timing = timer_.wait();
        tick_.run(timing, timer_.schedule().late_ticks());
    }
    tick_.send_zero_force();
}

}  // namespace dibhr
