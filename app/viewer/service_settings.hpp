// The settings that the services of force devices store for them.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "app/viewer/errand.hpp"

namespace dibhr {

/// Requested when a device is found, again a few times while no answer comes, on other threads.
class ServiceSettings {
  public:
    explicit ServiceSettings(Errands& errands) : errands_(errands) {}

    /// Once a picture, after the session's poll(): copies the answers into `devices`.
    void follow(const Settings& settings, std::vector<DeviceNews>& devices);

  private:
    struct Asking {
        explicit Asking(Errands& errands) : answer(errands) {}

        std::string device{};  ///< id of the device of the last request
        int tries{0};
        std::chrono::steady_clock::time_point at{};
        Errand<std::vector<DeviceLine>> answer;
    };

    static void follow(const Settings& settings, DeviceNews& news, Asking& asking);

    Errands& errands_;
    std::map<std::size_t, Asking> asking_{};  // by the device's kind
};

}  // namespace dibhr
