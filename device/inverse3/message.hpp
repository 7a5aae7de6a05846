// Messages of the service: its devices as plain data, in memory that every message reuses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "core/haptics/vec.hpp"
#include "device/inverse3/short_text.hpp"

namespace dibhr::inverse3 {

/// Opaque; so far hex digits for an arm, decimal digits for a grip.
using DeviceId = ShortText<48>;
using ShortWord = ShortText<32>;

enum class Handedness : std::uint8_t { unknown, left, right };

/// Configuration of an arm, which is only in a whole state.
struct ArmConfig {
    bool minverse{false};
    Handedness handedness{Handedness::unknown};
    ShortWord preset{};  ///< empty: missing, as before 3.5
    ShortWord basis{};   ///< "XYZ"; empty: missing

    bool operator==(const ArmConfig&) const = default;
};

/// An Inverse3 or a Minverse. Metres and newtons, the service's axes: x right, y forward, z up.
struct Arm {
    DeviceId id{};
    std::optional<ArmConfig> config{};
    /// Nothing where it is missing, no number, or farther away than any arm reaches.
    std::optional<Vec3> position_m{};
    std::optional<Vec3> velocity_m_per_s{};
    std::optional<Vec3> force_newton{};  ///< current force in the service; missing before 3.5
    bool calibrated{false};              ///< false where it is missing
    bool powered{true};                  ///< true where it is missing: no power gives no force
    bool in_use{false};
    bool locked{false};  ///< not ready, although calibrated and powered
};

/// A grip with buttons, wired or not.
struct Grip {
    DeviceId id{};
    bool wired{false};
    bool connected{true};
    bool awake{true};
    std::uint8_t buttons{0};          ///< from bit 0: a, b, c, home; or button_0 .. button_3
    std::optional<double> battery{};  ///< full: 1
};

/// One message.
struct ServiceMessage {
    static constexpr std::size_t kMost = 4;  ///< of each kind; more are left out

    std::array<Arm, kMost> arms{};
    std::size_t arm_count{0};
    std::array<Grip, kMost> grips{};
    std::size_t grip_count{0};
    bool has_session{false};      ///< has the name of the session, as from 3.5 on
    ShortText<160> error_text{};  ///< the error that the service reports; empty: none

    /// The arm with this ID; null: not in the message.
    [[nodiscard]] const Arm* arm(const DeviceId& id) const noexcept;
};

/// Reads messages; nothing is allocated after construction.
class MessageReader {
  public:
    /// Longer messages are rejected. A message with the greatest number of devices has some 4 KiB.
    static constexpr std::size_t kLongest_bytes = std::size_t{256} * 1024;

    MessageReader();
    ~MessageReader();
    MessageReader(const MessageReader&) = delete;
    MessageReader& operator=(const MessageReader&) = delete;

    /// False, and an empty message, for a text that is no JSON object. Unknown keys are ignored,
    /// missing ones are normal, and a device without a valid ID is left out.
    [[nodiscard]] bool read(std::string_view text, ServiceMessage& message) noexcept;

  private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
};

}  // namespace dibhr::inverse3
