// Settings that the service keeps for all programs, such as gravity compensation: they are shown,
// never changed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

struct KeptSetting {
    std::string name{};    ///< "gravity compensation"
    std::string text{};    ///< "on"
    std::string answer{};  ///< the service's own text, cut where it is long
};

/// Reads them from the service over HTTP; those without an answer in 300 ms are left out.
[[nodiscard]] std::vector<KeptSetting> fetch_kept_settings(const ConnectionOptions& options,
                                                           const std::string& device);

/// The text for an answer in JSON: `{"enabled":true,"gain":0.3}` gives "on, gain 0.3", an error
/// gives "not told: " and its reason. Text that is no JSON stays as it is.
[[nodiscard]] std::string setting_text(std::string_view answer);

}  // namespace dibhr::inverse3
