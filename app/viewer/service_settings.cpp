// Requests to the services of force devices.
#include "app/viewer/service_settings.hpp"

#include <memory>
#include <utility>

#include "device/force_devices.hpp"

namespace dibhr {

void ServiceSettings::follow(const Settings& settings, std::vector<DeviceNews>& devices) {
    for (DeviceNews& news : devices) {
        if (force_device_kinds()[news.kind]->ask_kept == nullptr) continue;
        follow(settings, news, asking_.try_emplace(news.kind, errands_).first->second);
    }
}

void ServiceSettings::follow(const Settings& settings, DeviceNews& news, Asking& asking) {
    constexpr int kMostTries = 3;
    constexpr std::chrono::seconds kBetween{3};
    if (auto kept = asking.answer.take()) news.kept = std::move(*kept);
    if (asking.answer.under_way()) return;
    if (news.state.id != asking.device) {
        asking.device = news.state.id;
        news.kept.clear();
        asking.tries = 0;
        asking.at = {};
    }
    const auto now = std::chrono::steady_clock::now();
    if (asking.device.empty() || !news.kept.empty() || asking.tries == kMostTries ||
        now < asking.at + kBetween)
        return;
    ++asking.tries;
    asking.at = now;
    asking.answer.start([ask = force_device_kinds()[news.kind]->ask_kept,
                         own = settings.devices[news.kind].clone(),
                         device = asking.device] { return ask(*own, device); });
}

}  // namespace dibhr
