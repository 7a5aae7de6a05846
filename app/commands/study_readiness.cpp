// Looks after device, clock and stability.
#include "app/commands/study_readiness.hpp"

#include <algorithm>
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
#include "device/inverse3/survey.hpp"

namespace dibhr {

namespace {

constexpr int kTicks = 1000;

/// True: one can be used.
bool print_inverse3() {
    const inverse3::Survey survey =
        inverse3::survey_service(connection_of(load_settings(settings_path()).inverse3));
    const bool usable = std::any_of(survey.arms.begin(), survey.arms.end(),
                                    [](const inverse3::SurveyedArm& arm) { return arm.usable(); });
    for (const inverse3::SurveyedArm& arm : survey.arms)
        std::cout << "a Haply Inverse3 (" << arm.id << ") is there: " << arm.sentence << '\n';
    return usable;
}

void print_device() {
    const bool inverse3 = print_inverse3();
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

void print_stability(const Protocol& protocol) {
    const DeviceLimits limits = falcon::specification_of().limits;
    double least = std::numeric_limits<double>::infinity();
    std::string of;
    for (const Condition& condition : protocol.conditions) {
        TouchParameters parameters;
        request_of(condition.values).given.apply(parameters);
        const Coupling held = held_coupling(parameters.coupling, limits);
        if (held.stiffness_newton_per_mm < parameters.coupling.stiffness_newton_per_mm)
            std::cout << condition.name << ": asks for "
                      << number_text(parameters.coupling.stiffness_newton_per_mm)
                      << " N/mm, a Falcon stands " << number_text(held.stiffness_newton_per_mm)
                      << '\n';
        const Coupling felt = stable_coupling(held, held.stiffness_newton_per_mm, limits.dynamics);
        const double margin = stability_margin(felt, limits.dynamics);
        if (margin >= least) continue;
        least = margin;
        of = condition.name;
    }
    std::cout << "stability margin on a Falcon, damped as it needs: at least "
              << short_text(least, 3) << " N s/m (" << of << ")\n";
}

}  // namespace

void print_readiness(const Protocol& protocol) {
    print_device();
    print_rate();
    print_stability(protocol);
}

}  // namespace dibhr
