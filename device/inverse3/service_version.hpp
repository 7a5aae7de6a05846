// The version of the Inverse Service, and the fault when it cannot be used.
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

/// Parses "3.5.0", "3.3.2-rc1"; nothing for a text that does not begin with two numbers.
[[nodiscard]] std::optional<ServiceVersion> version_of(std::string_view text);

/// Reads /version on the WebSocket's port, else on the older port; nothing when neither answers.
/// Takes at most 0.6 s.
[[nodiscard]] std::optional<ServiceVersion> ask_version(const ConnectionOptions& options);

/// Stage and sentence for a service without a connection.
struct ServiceFault {
    Stage stage{};
    std::string sentence{};
};
/// `status`: its version, and whether it is installed.
[[nodiscard]] ServiceFault service_fault(const LinkError& error, const Status& status);

/// Whether one of the service's files is found.
[[nodiscard]] bool is_installed(const ConnectionOptions& options);

}  // namespace dibhr::inverse3
