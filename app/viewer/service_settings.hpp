// The settings that the services of force devices store for them.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "app/viewer/task_group.hpp"

namespace dibhr {

/// Requested when a device is found, again a few times while no answer comes, on other threads.
class ServiceSettings {
  public:
    explicit ServiceSettings(TaskGroup& tasks) : tasks_(tasks) {}

    /// Once a turn, after the session's poll(): copies the answers into `devices`.
    void update(const Settings& settings, std::vector<DeviceInfo>& devices);

  private:
    struct Asking {
        explicit Asking(TaskGroup& tasks) : answer(tasks) {}

        std::string device{};  ///< id of the device of the last request
        int tries{0};
        std::chrono::steady_clock::time_point at{};
        BackgroundTask<std::vector<DeviceLine>> answer;
    };

    static void update(const Settings& settings, DeviceInfo& info, Asking& asking);

    TaskGroup& tasks_;
    std::map<std::size_t, Asking> asking_{};  // by the device's kind
};

}  // namespace dibhr
