// Which version of the Inverse Service is there, and why none talks.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "device/inverse3/service_link.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

struct ServiceVersion {
    int major{0};
    int minor{0};
    std::string text{};  ///< "3.5.0"

    [[nodiscard]] bool at_least(int wanted_major, int wanted_minor) const noexcept;
};

/// Of "3.5.0", "3.3.2-rc1"; nothing for what begins with no two numbers.
[[nodiscard]] std::optional<ServiceVersion> version_of(std::string_view text);

/// What /version tells, on the WebSocket's port or else the older one; nothing when none answers.
/// Takes at most 0.6 s.
[[nodiscard]] std::optional<ServiceVersion> ask_version(const ConnectionOptions& options);

/// What to tell of a service that does not talk.
struct Unheard {
    Stage stage{};
    std::string sentence{};
};
/// `status`: its version, and whether it is installed.
[[nodiscard]] Unheard why_unheard(const LinkError& error, const Status& status);

/// The service is installed, as far as can be seen.
[[nodiscard]] bool is_installed(const ConnectionOptions& options);

}  // namespace dibhr::inverse3
