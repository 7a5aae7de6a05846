// What the Inverse3's service keeps of the device.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "app/viewer/errand.hpp"
#include "device/inverse3/kept_settings.hpp"

namespace dibhr {

/// Asked when a device comes, a few times while nothing is answered, away from the window's thread.
class ServiceSettings {
  public:
    explicit ServiceSettings(Errands& errands) : asking_(errands) {}

    /// Once a picture, after the session's poll(): what is kept, into the news.
    void follow(const Inverse3Settings& settings, std::optional<Inverse3News>& inverse3);

  private:
    std::string device_{};  ///< that was asked of last
    int tries_{0};
    std::chrono::steady_clock::time_point asked_{};
    Errand<std::vector<inverse3::KeptSetting>> asking_;
};

}  // namespace dibhr
