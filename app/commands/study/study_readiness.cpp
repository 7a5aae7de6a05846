// Checks device, clock and stability before a study.
#include "app/commands/study/study_check.hpp"

#include <chrono>
#include <cstddef>
#include <iostream>
#include <limits>
#include <string>

#include "app/settings/settings.hpp"
#include "app/settings/study_values.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/stability.hpp"
#include "core/realtime/tick_timer.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

namespace {

constexpr int kTicks = 1000;

void print_line(const std::string& line) {
    std::cout << line << '\n';
}

/// The last kind first.
void print_devices(const AllDeviceSettings& chosen) {
    const auto kinds = force_device_kinds();
    bool any = false;
    for (std::size_t k = kinds.size(); k-- > 0;) {
        const bool there = kinds[k]->print_attached(chosen[k], print_line);
        any = any || there;
    }
    if (any) return;
    std::cout << "no " << kinds.front()->title << " is attached";
    for (std::size_t k = 1; k < kinds.size(); ++k)
        std::cout << (k == 1 ? ", and no " : " or ") << kinds[k]->title;
    std::cout << ": with the mouse nothing is felt, only seen and heard\n";
}

void print_rate() {
    TickTimer timer;
    for (int k = 0; k < kTicks; ++k) timer.wait();
    const LatenessHistogram& lateness = timer.schedule().lateness();
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(lateness.quantile(0.99));
    std::cout << "1 kHz for a second: " << timer.schedule().late_ticks()
              << " ticks late, 99 % within " << us.count() << " us\n";
}

/// For one kind of device with its settings.
void print_stability(const Protocol& protocol, const ForceDeviceKind& kind,
                     const DeviceLimits& limits) {
    double least = std::numeric_limits<double>::infinity();
    std::string of;
    for (const Condition& condition : protocol.conditions) {
        TouchParameters parameters;
        request_of(condition.values).given.apply(parameters);
        const double requested = parameters.coupling.stiffness_newton_per_mm;
        const Coupling held = held_coupling(parameters.coupling, limits);
        const double supported = held.stiffness_newton_per_mm;
        if (supported < requested)
            std::cout << condition.name << ": asks for " << number_text(requested) << " N/mm, "
                      << kind.article << " can give " << number_text(supported) << '\n';
        const Coupling effective = stable_coupling(held, supported, limits.dynamics);
        const double margin = stability_margin(effective, limits.dynamics);
        if (margin >= least) continue;
        least = margin;
        of = condition.name;
    }
    std::cout << "stability margin on " << kind.article;
    if (!limits.dynamics.moves()) {
        std::cout << ": no force moves it, so that nothing swings\n";
        return;
    }
    std::cout << ", with the damping that it needs: at least " << short_text(least, 3) << " N s/m ("
              << of << ")" << kind.known << '\n';
}

}  // namespace

void print_readiness(const Protocol& protocol) {
    const AllDeviceSettings chosen = load_settings(settings_path()).devices;
    print_devices(chosen);
    print_rate();
    for (std::size_t k = 0; k < chosen.size(); ++k)
        print_stability(protocol, *force_device_kinds()[k], chosen[k].limits());
}

}  // namespace dibhr
