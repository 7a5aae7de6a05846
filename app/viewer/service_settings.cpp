// Requests to the services of force devices.
#include "app/viewer/service_settings.hpp"

#include <memory>
#include <utility>

#include "device/force_devices.hpp"

namespace dibhr {

void ServiceSettings::update(const Settings& settings, std::vector<DeviceInfo>& devices) {
    for (DeviceInfo& info : devices) {
        if (force_device_kinds()[info.kind]->read_kept_settings == nullptr) continue;
        update(settings, info, asking_.try_emplace(info.kind, tasks_).first->second);
    }
}

void ServiceSettings::update(const Settings& settings, DeviceInfo& info, Asking& asking) {
    constexpr int kMostTries = 3;
    constexpr std::chrono::seconds kBetween{3};
    if (auto kept = asking.answer.take()) info.kept = std::move(*kept);
    if (asking.answer.running()) return;
    if (info.state.id != asking.device) {
        asking.device = info.state.id;
        info.kept.clear();
        asking.tries = 0;
        asking.at = {};
    }
    const auto now = std::chrono::steady_clock::now();
    if (asking.device.empty() || !info.kept.empty() || asking.tries == kMostTries ||
        now < asking.at + kBetween)
        return;
    ++asking.tries;
    asking.at = now;
    asking.answer.start([ask = force_device_kinds()[info.kind]->read_kept_settings,
                         own = settings.devices[info.kind].clone(),
                         device = asking.device] { return ask(*own, device); });
}

}  // namespace dibhr
