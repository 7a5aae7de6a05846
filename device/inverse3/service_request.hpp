// Messages to the service, written into a buffer that is reused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/haptics/vec.hpp"
#include "device/inverse3/message.hpp"

namespace dibhr::inverse3 {

/// The JSON format of a force. Sources differ; which service takes which format is not known.
enum class ForceDialect : std::uint8_t { vector, values };

/// "vector", "values".
[[nodiscard]] const char* name_of(ForceDialect dialect) noexcept;
[[nodiscard]] constexpr ForceDialect other(ForceDialect dialect) noexcept {
    return dialect == ForceDialect::vector ? ForceDialect::values : ForceDialect::vector;
}

/// One message to the service.
struct ServiceRequest {
    DeviceId arm{};                 ///< empty: addresses no device
    bool sets_session_name{false};  ///< sets the name of the session
    ShortWord preset{};             ///< to be set; empty: unchanged
    bool whole_state{false};        ///< requests an answer with all configurations
    /// [N], the service's axes; nothing: requests the pose and sends no force.
    std::optional<Vec3> force_newton{};
    ForceDialect dialect{ForceDialect::vector};
};

class RequestWriter {
  public:
    /// Valid until the next call. A force that is not finite is written as zero.
    [[nodiscard]] std::string_view write(const ServiceRequest& request) noexcept;

  private:
    void add(std::string_view text) noexcept;
    void add_quoted(std::string_view text) noexcept;
    void add_number(double number) noexcept;
    void add_session(const ServiceRequest& request) noexcept;
    void add_arm(const ServiceRequest& request) noexcept;
    void add_force(Vec3 force_newton, ForceDialect dialect) noexcept;

    std::array<char, 1024> text_{};  // the longest has 660 bytes
    std::size_t size_{0};
};

}  // namespace dibhr::inverse3
