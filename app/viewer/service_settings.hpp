// What the services of force devices keep of them.
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

/// Asked when a device comes, a few times while nothing is answered, away from the window's thread.
class ServiceSettings {
  public:
    explicit ServiceSettings(Errands& errands) : errands_(errands) {}

    /// Once a picture, after the session's poll(): what is kept, into the news.
    void follow(const Settings& settings, std::vector<DeviceNews>& devices);

  private:
    struct Asking {
        explicit Asking(Errands& errands) : answer(errands) {}

        std::string device{};  ///< that was asked of last
        int tries{0};
        std::chrono::steady_clock::time_point at{};
        Errand<std::vector<DeviceLine>> answer;
    };

    static void follow(const Settings& settings, DeviceNews& news, Asking& asking);

    Errands& errands_;
    std::map<std::size_t, Asking> asking_{};  // by the device's kind
};

}  // namespace dibhr
