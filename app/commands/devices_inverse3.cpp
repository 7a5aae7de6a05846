// The Haply Inverse Service in `dibhr devices`.
#include "app/commands/devices_inverse3.hpp"

#include <cmath>
#include <iostream>
#include <utility>

#include "device/inverse3/simulated/hand_script.hpp"
#include "device/inverse3/simulated/service.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr {

namespace {

using inverse3::Survey;
using inverse3::SurveyedArm;

std::string name_of(const SurveyedArm& arm) {
    const std::string kind = arm.minverse ? "Haply Minverse " : "Haply Inverse3 ";
    return kind + arm.id;
}

void tell(const inverse3::GripStatus& grip) {
    std::cout << "Haply grip " << grip.id << ": " << (grip.wired ? "wired" : "wireless")
              << (grip.awake ? "" : ", asleep: press its button");
    if (grip.battery) std::cout << ", battery " << std::lround(100.0 * *grip.battery) << " %";
    std::cout << '\n';
}

void tell(const SurveyedArm& arm) {
    std::cout << name_of(arm) << ": " << (arm.usable() ? "usable, " : "not usable yet, ")
              << arm.sentence << '\n';
    if (arm.kept.empty()) return;
    std::cout << "  kept by the service for all programs, not changed by dibhr:\n";
    for (const inverse3::KeptSetting& kept : arm.kept)
        std::cout << "    " << kept.name << ": " << kept.words << '\n';
}

}  // namespace

DevicesFound tell_inverse3(const inverse3::ConnectionOptions& connection) {
    const Survey survey = survey_service(connection);
    if (survey.stage != inverse3::Stage::ready) {
        std::cout << "Haply Inverse3: none usable, " << survey.sentence << '\n';
        return {};
    }
    std::cout << "Haply Inverse Service" << (survey.version.empty() ? "" : " " + survey.version)
              << '\n';
    DevicesFound found;
    for (const SurveyedArm& arm : survey.arms) {
        tell(arm);
        found.usable = found.usable || arm.usable();
        if (found.refusal.empty()) {
            found.refusal = name_of(arm) + " is not usable yet, " + arm.sentence;
        }
    }
    for (const inverse3::GripStatus& grip : survey.grips) tell(grip);
    return found;
}

void simulate_inverse3(const inverse3::ConnectionOptions& connection) {
    inverse3::simulated::Scene scene;
    scene.grips = {inverse3::simulated::Grip{}};
    inverse3::simulated::Service service(std::move(scene), connection.port, connection.older_port);
    std::cout << "A simulated Inverse3 answers on port " << service.port()
              << ". Start dibhr in another terminal.\n"
              << inverse3::simulated::kHandCommands << std::flush;
    inverse3::simulated::HandScript script(service);
    for (std::string line; std::getline(std::cin, line);) {
        const std::string answer = script.obey(line);
        if (!answer.empty()) std::cout << answer << std::endl;
    }
}

}  // namespace dibhr
