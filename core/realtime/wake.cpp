// Ends the poll() of another thread, by an eventfd.
#include "core/realtime/wake.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <string>

#include "core/error.hpp"

namespace dibhr {

Wake::Wake() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (descriptor_ < 0) {
        throw DeviceError(std::string("a thread that waits cannot be made (") +
                          std::strerror(errno) + "): close other programs");
    }
}

Wake::~Wake() {
    ::close(descriptor_);
}

void Wake::signal() const noexcept {
    const std::uint64_t one = 1;
    // Fails only when the counter is full: then the descriptor is readable anyway.
    [[maybe_unused]] const auto written = ::write(descriptor_, &one, sizeof one);
}

void Wake::clear() const noexcept {
    std::uint64_t signals = 0;
    // Fails only when there was no signal.
    [[maybe_unused]] const auto got = ::read(descriptor_, &signals, sizeof signals);
}

void Wake::wait_until(std::chrono::steady_clock::time_point until) const noexcept {
    using std::chrono::nanoseconds;
    const nanoseconds left =
        std::max<nanoseconds>(until - std::chrono::steady_clock::now(), nanoseconds::zero());
    const auto whole = std::chrono::duration_cast<std::chrono::seconds>(left);
    const timespec limit{static_cast<time_t>(whole.count()),
                         static_cast<long>((left - whole).count())};
    pollfd watched{descriptor_, POLLIN, 0};
    if (ppoll(&watched, 1, &limit, nullptr) > 0) clear();
}

}  // namespace dibhr
