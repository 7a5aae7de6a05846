// Looks after device, clock and stability.
#include "app/commands/study_readiness.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <limits>
#include <string>

#include "app/settings/settings.hpp"
#include "app/settings/study_values.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/stability.hpp"
#include "core/realtime/tick_timer.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/falcon/survey.hpp"
#include "device/inverse3/inverse3_device.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr {

namespace {

constexpr int kTicks = 1000;

/// True: one can be used.
bool print_inverse3(const Settings& settings) {
    const inverse3::Survey survey = inverse3::survey_service(connection_of(settings.inverse3));
    const bool usable = std::any_of(survey.arms.begin(), survey.arms.end(),
                                    [](const inverse3::SurveyedArm& arm) { return arm.usable(); });
    for (const inverse3::SurveyedArm& arm : survey.arms)
        std::cout << "a Haply Inverse3 (" << arm.id << ") is there: " << arm.sentence << '\n';
    return usable;
}

void print_device(const Settings& settings) {
    const bool inverse3 = print_inverse3(settings);
    try {
        const auto falcons = falcon::attached_falcons();
        if (!falcons.empty())
            std::cout << "a Novint Falcon is attached; dibhr devices says whether it can be used\n";
        else if (!inverse3)
            std::cout << "no Novint Falcon is attached, and no Haply Inverse3: with the mouse "
                         "nothing is felt, only seen and heard\n";
    } catch (const DeviceError& error) {
        std::cout << "it is not known whether a Novint Falcon is attached: " << error.what()
                  << '\n';
    }
}

void print_rate() {
    TickTimer timer;
    for (int k = 0; k < kTicks; ++k) timer.wait();
    const LatenessHistogram& lateness = timer.schedule().lateness();
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(lateness.quantile(0.99));
    std::cout << "1 kHz for a second: " << timer.schedule().late_ticks()
              << " ticks late, 99 % within " << us.count() << " us\n";
}

/// A device as a person has set it up.
struct SetUpDevice {
    const char* name;   ///< with its article
    const char* known;  ///< how well it is known how it moves
    DeviceLimits limits{};
};

std::array<SetUpDevice, 2> devices_as_set_up(const Settings& settings) {
    return {{{"a Falcon", "",
              at_scale(falcon::specification_of().limits, settings.falcon.workspace.scale)},
             {"an Inverse3", "; its mass and delay are assumed, not measured",
              at_scale(inverse3::specification_of().limits,
                       settings.inverse3.tuning.workspace.scale)}}};
}

void print_stability(const Protocol& protocol, const SetUpDevice& device) {
    double least = std::numeric_limits<double>::infinity();
    std::string of;
    for (const Condition& condition : protocol.conditions) {
        TouchParameters parameters;
        request_of(condition.values).given.apply(parameters);
        const double asked = parameters.coupling.stiffness_newton_per_mm;
        const Coupling held = held_coupling(parameters.coupling, device.limits);
        const double stood = held.stiffness_newton_per_mm;
        if (stood < asked)
            std::cout << condition.name << ": asks for " << number_text(asked) << " N/mm, "
                      << device.name << " stands " << number_text(stood) << '\n';
        const Coupling felt = stable_coupling(held, stood, device.limits.dynamics);
        const double margin = stability_margin(felt, device.limits.dynamics);
        if (margin >= least) continue;
        least = margin;
        of = condition.name;
    }
    std::cout << "stability margin on " << device.name << ", damped as it needs: at least "
              << short_text(least, 3) << " N s/m (" << of << ")" << device.known << '\n';
}

}  // namespace

void print_readiness(const Protocol& protocol) {
    const Settings settings = load_settings(settings_path());
    print_device(settings);
    print_rate();
    for (const SetUpDevice& device : devices_as_set_up(settings)) print_stability(protocol, device);
}

}  // namespace dibhr
