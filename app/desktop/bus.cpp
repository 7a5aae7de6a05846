// Waits for a message bus and a cancellation at once.
#include "app/desktop/bus.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace dibhr {

namespace {

/// From now on, at least 0.
int milliseconds_to(SteadyClock::time_point time) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(time - SteadyClock::now());
    return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 1'000'000));
}

}  // namespace

void wait_for_bus(sd_bus* bus, const Cancellation& cancellation, const Deadline& latest) {
    const auto events = static_cast<short>(sd_bus_get_events(bus));
    std::array<pollfd, 2> waited{pollfd{sd_bus_get_fd(bus), events, 0},
                                 pollfd{cancellation.descriptor(), POLLIN, 0}};
    int wait_ms = latest ? milliseconds_to(*latest) : -1;
    std::uint64_t due_us = UINT64_MAX;  // of the monotonic clock, as that of the deadline
    if (sd_bus_get_timeout(bus, &due_us) >= 0 && due_us != UINT64_MAX) {
        const int due_ms = milliseconds_to(
            SteadyClock::time_point(std::chrono::microseconds(static_cast<std::int64_t>(due_us))));
        wait_ms = wait_ms < 0 ? due_ms : std::min(wait_ms, due_ms);
    }
    ::poll(waited.data(), waited.size(), wait_ms);
}

}  // namespace dibhr
