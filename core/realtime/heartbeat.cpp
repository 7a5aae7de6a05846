// Beats by the monotonic clock; the kernel shows on what a silent thread waits.
#include "core/realtime/heartbeat.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace dibhr {

Heartbeat::~Heartbeat() {
    if (const int file = system_call_; file >= 0) close(file);
}

void Heartbeat::count_computing_as_beat() noexcept {
    const int of_this_thread = open("/proc/thread-self/syscall", O_RDONLY | O_CLOEXEC);
    const int before = system_call_;
    if (before < 0 || of_this_thread < 0) {
        system_call_ = std::max(before, of_this_thread);
        return;
    }
    // Another thread now owns the heartbeat. The number stays: a monitor may be reading.
    dup3(of_this_thread, before, O_CLOEXEC);
    close(of_this_thread);
}

/// The file (proc_pid_syscall(5)) says "running", or begins with the number of the call in which
/// the thread waits: in futex() it waits for another thread.
Heartbeat::Activity Heartbeat::activity() const noexcept {
    const int file = system_call_.load(std::memory_order_acquire);  // it was opened before
    std::array<char, 16> text{};
    if (file < 0 || pread(file, text.data(), text.size() - 1, 0) <= 0) return Activity::waits;
    if (std::string_view(text.data()).starts_with("running")) return Activity::computes;
    return std::strtol(text.data(), nullptr, 10) == SYS_futex ? Activity::waits_for_threads
                                                              : Activity::waits;
}

Heartbeat::Clock::duration HeartbeatMonitor::silence(Heartbeat::Clock::time_point now) noexcept {
    if (heart_ == nullptr) return {};
    const auto last = heart_->last_.load(std::memory_order_relaxed);
    if (last == Heartbeat::kIdle || now < last) return {};
    if (now - last >= kKernelCheckAfter && now - checked_ >= kKernelCheckInterval) {
        checked_ = now;
        const auto activity = heart_->activity();
        const bool waits_in_vain = now - last >= kLongestWaitForThreads;
        if (activity == Heartbeat::Activity::computes ||
            (activity == Heartbeat::Activity::waits_for_threads && !waits_in_vain)) {
            computed_ = now;
        }
    }
    return now - std::max(last, computed_);
}

}  // namespace dibhr
