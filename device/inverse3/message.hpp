// What the service says: its devices as plain data, in memory that is used again for every message.
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

/// Opaque: hex digits for an arm, decimal ones for a grip, whatever comes.
using DeviceId = ShortText<48>;
using ShortWord = ShortText<32>;

enum class Handedness : std::uint8_t { unknown, left, right };

/// What is told of a device only with the whole state.
struct ArmConfig {
    bool minverse{false};
    Handedness handedness{Handedness::unknown};
    ShortWord preset{};  ///< empty: not told, as before 3.5
    ShortWord basis{};   ///< "XYZ"; empty: not told

    bool operator==(const ArmConfig&) const = default;
};

/// An Inverse3 or a Minverse. Metres and newtons, the service's axes: x right, y forward, z up.
struct Arm {
    DeviceId id{};
    std::optional<ArmConfig> config{};
    /// Nothing where it is missing, no number, or farther off than any arm reaches.
    std::optional<Vec3> position_m{};
    std::optional<Vec3> velocity_m_per_s{};
    std::optional<Vec3> force_newton{};  ///< as the service holds it; not told before 3.5
    bool calibrated{false};              ///< not told counts as not
    bool powered{true};                  ///< not told counts as yes: without power no force comes
    bool in_use{false};
    bool locked{false};  ///< told not to be ready though it is calibrated and powered
};

/// A grip with buttons, wired or not.
struct Grip {
    DeviceId id{};
    bool wired{false};
    bool connected{true};
    bool awake{true};
    std::uint8_t buttons{0};          ///< bits 0 ..: a, b, c and home, or 0 .. 3
    std::optional<double> battery{};  ///< full: 1
};

/// One message.
struct ServiceMessage {
    static constexpr std::size_t kMost = 4;  ///< of each kind; more are left out

    std::array<Arm, kMost> arms{};
    std::size_t arm_count{0};
    std::array<Grip, kMost> grips{};
    std::size_t grip_count{0};
    bool has_session{false};     ///< names its session, as from 3.5 on
    ShortText<160> complaint{};  ///< what the service says was wrong

    /// The arm of that name; null: not told of.
    [[nodiscard]] const Arm* arm(const DeviceId& id) const noexcept;
};

/// Reads messages; nothing is allocated after construction.
class MessageReader {
  public:
    /// A longer one is not understood: with every device that fits it has some 4 KiB.
    static constexpr std::size_t kLongest_bytes = std::size_t{256} * 1024;

    MessageReader();
    ~MessageReader();
    MessageReader(const MessageReader&) = delete;
    MessageReader& operator=(const MessageReader&) = delete;

    /// False, and an empty message, for what is no JSON object. Unknown keys are passed over,
    /// missing ones are normal, and a device without a usable name is left out.
    [[nodiscard]] bool read(std::string_view text, ServiceMessage& message) noexcept;

  private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
};

}  // namespace dibhr::inverse3
