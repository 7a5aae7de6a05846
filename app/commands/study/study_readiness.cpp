// Checks device, clock and stability before a study.
#include "app/commands/study/study_check.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "app/settings/settings.hpp"
#include "app/settings/study_values.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/stability.hpp"
#include "core/realtime/tick_timer.hpp"
#include "core/report/report_sentences.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

namespace {

constexpr int kTicks = 1000;
constexpr std::int64_t kMostLate = 10;  // one in a hundred

void print_line(const std::string& line) {
    std::cout << line << '\n';
}

/// The last kind first. Returns for each kind whether one is attached.
std::vector<bool> print_devices(const AllDeviceSettings& chosen) {
    const auto kinds = force_device_kinds();
    std::vector<bool> attached(kinds.size(), false);
    for (std::size_t k = kinds.size(); k-- > 0;)
        attached[k] = kinds[k]->print_attached(chosen[k], print_line);
    if (std::ranges::find(attached, true) != attached.end()) return attached;
    std::cout << "no " << kinds.front()->title << " is attached";
    for (std::size_t k = 1; k < kinds.size(); ++k)
        std::cout << (k == 1 ? ", and no " : " or ") << kinds[k]->title;
    std::cout << ": with the mouse nothing is felt, only seen and heard\n";
    return attached;
}

/// Returns how many of kTicks came late.
std::int64_t print_rate() {
    TickTimer timer;
    for (int k = 0; k < kTicks; ++k) timer.wait();
    const LatenessHistogram& lateness = timer.schedule().lateness();
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(lateness.quantile(0.99));
    const auto late = static_cast<std::int64_t>(timer.schedule().late_ticks());
    std::cout << "1 kHz for a second: " << counted(late, "tick") << " late (" << kMostLate
              << " at most are good), 99 % within " << us.count() << " us\n";
    return late;
}

/// What one kind of device with its settings makes of the conditions.
struct Margin {
    double least_ns_per_m{std::numeric_limits<double>::infinity()};
    std::string of{};                   ///< the condition with the least
    std::vector<std::string> softer{};  ///< a sentence for each condition that is too stiff for it
    bool moves{true};                   ///< a force moves it
};

Margin margin_on(const Protocol& protocol, const ForceDeviceKind& kind,
                 const DeviceLimits& limits) {
    Margin margin{.moves = limits.dynamics.moves()};
    for (const Condition& condition : protocol.conditions) {
        TouchParameters parameters;
        request_of(condition.values).given.apply(parameters);
        const double requested = parameters.coupling.stiffness_newton_per_mm;
        const Coupling held = held_coupling(parameters.coupling, limits);
        const double supported = held.stiffness_newton_per_mm;
        if (supported < requested)
            margin.softer.push_back(condition.name + ": requests " + number_text(requested) +
                                    " N/mm, " + kind.article + " can give " +
                                    number_text(supported));
        const Coupling effective = stable_coupling(held, supported, limits.dynamics);
        const double least = stability_margin(effective, limits.dynamics);
        if (least >= margin.least_ns_per_m) continue;
        margin.least_ns_per_m = least;
        margin.of = condition.name;
    }
    return margin;
}

void print_margin(const Margin& margin, const ForceDeviceKind& kind) {
    for (const std::string& line : margin.softer) print_line(line);
    std::cout << "stability margin on " << kind.article;
    if (!margin.moves) {
        std::cout << ": no force moves it, so that nothing swings\n";
        return;
    }
    std::cout << ", with the damping that it needs: at least "
              << short_text(margin.least_ns_per_m, 3) << " N s/m (" << margin.of << ")"
              << kind.known << '\n';
}

/// In short, of a device that is not attached: "an Inverse3 0.51 N s/m, 2 conditions softer".
std::string margin_text(const Margin& margin, const ForceDeviceKind& kind) {
    const auto softer = static_cast<std::int64_t>(margin.softer.size());
    return std::string(kind.article) + ' ' +
           (margin.moves ? short_text(margin.least_ns_per_m, 3) + " N s/m" : "without swinging") +
           (softer == 0 ? "" : " (" + counted(softer, "condition") + " softer than requested)");
}

/// Returns the attached kinds on which every condition is stable.
std::vector<std::string> print_margins(const Protocol& protocol, const AllDeviceSettings& chosen,
                                       const std::vector<bool>& attached) {
    std::vector<std::string> usable;
    std::vector<std::string> others;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const ForceDeviceKind& kind = *force_device_kinds()[k];
        const Margin margin = margin_on(protocol, kind, chosen[k].limits());
        if (!attached[k]) {
            others.push_back(margin_text(margin, kind));
            continue;
        }
        print_margin(margin, kind);
        if (margin.least_ns_per_m >= 0.0) usable.emplace_back(kind.article);
    }
    if (!others.empty())
        std::cout << "least stability margin on devices that are not attached: " << listed(others)
                  << '\n';
    return usable;
}

/// The one line for who reads no other.
std::string verdict(std::int64_t late, bool any_attached, const std::vector<std::string>& usable) {
    if (late > kMostLate)
        return "not ready: " + std::to_string(late) + " of " + std::to_string(kTicks) +
               " ticks came late, which people may feel; close other programs and check again "
               "(dibhr bench measures longer)";
    if (!usable.empty()) return "ready: the study can be run here with " + listed(usable, " or ");
    if (any_attached)
        return "not ready: some condition may swing on the device that is attached; lower its "
               "stiffness";
    return "not ready for touch: without a force device participants feel nothing, and answer by "
           "what they see and hear; attach one";
}

}  // namespace

void print_readiness(const Protocol& protocol) {
    const AllDeviceSettings chosen = load_settings(settings_path()).devices;
    const std::vector<bool> attached = print_devices(chosen);
    const std::int64_t late = print_rate();
    const std::vector<std::string> usable = print_margins(protocol, chosen, attached);
    const bool any = std::ranges::find(attached, true) != attached.end();
    print_line(verdict(late, any, usable));
}

}  // namespace dibhr
