// A connection to a message bus (sd-bus), and how a thread waits on it.
#pragma once

#include <systemd/sd-bus.h>

#include <chrono>
#include <memory>
#include <optional>

#include "app/desktop/cancellation.hpp"

namespace dibhr {

using SteadyClock = std::chrono::steady_clock;
using Deadline = std::optional<SteadyClock::time_point>;  // nothing: no limit, for a person

struct CloseBus {
    void operator()(sd_bus* bus) const { sd_bus_close_unref(bus); }
};
struct UnrefMessage {
    void operator()(sd_bus_message* message) const { sd_bus_message_unref(message); }
};
using Bus = std::unique_ptr<sd_bus, CloseBus>;
using Message = std::unique_ptr<sd_bus_message, UnrefMessage>;

/// Waits until the bus has something to do, the deadline, or cancel().
void wait_for_bus(sd_bus* bus, const Cancellation& cancellation, const Deadline& latest);

/// Runs the bus until `done`; false: deadline passed, bus lost, or called off.
template <typename Done>
bool run_until(sd_bus* bus, const Cancellation& cancellation, const Deadline& latest,
               const Done& done) {
    while (!done()) {
        const int worked = sd_bus_process(bus, nullptr);
        if (worked < 0 || cancellation.is_cancelled()) return false;
        if (worked > 0) continue;
        if (latest && SteadyClock::now() >= *latest) return false;
        wait_for_bus(bus, cancellation, latest);
    }
    return true;
}

}  // namespace dibhr
