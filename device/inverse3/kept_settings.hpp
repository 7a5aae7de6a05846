// What the service keeps of a device for all programs, such as gravity compensation: shown, never
// changed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

struct KeptSetting {
    std::string name{};   ///< "gravity compensation"
    std::string words{};  ///< "on"
    std::string told{};   ///< as the service spells it, cut where it is long
};

/// Those that the service tells of, over HTTP: for at most 300 ms each.
[[nodiscard]] std::vector<KeptSetting> ask_kept_settings(const ConnectionOptions& options,
                                                         const std::string& device);

/// A value that is told as JSON, in words: `{"enabled":true,"gain":0.3}` is "on, gain 0.3", an
/// error "not told: " and its reason; text that is no JSON is itself.
[[nodiscard]] std::string words_of_setting(std::string_view told);

}  // namespace dibhr::inverse3
