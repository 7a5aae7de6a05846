// What the check of a Falcon is to find of the questions that ../README.md leaves open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/vec.hpp"
#include "device/falcon/usb.hpp"
#include "device/hand/check/record.hpp"

namespace dibhr::falcon {

[[nodiscard]] Json as_json(Vec3 values);
/// "0A 44 2C 0D".
[[nodiscard]] std::string hexadecimal(std::span<const std::uint8_t> bytes);

/// In the order of the steps that answer them.
enum class OpenQuestion : std::size_t {
    identity,
    upload_speed,
    stray_bytes,
    loading_again,
    last_byte,
    reply_rate,
    event_character,
    homing_bit,
    end_stops,
    angle_at_zero,
    after_last_packet,
    torque_scale,
    buttons,
    usb_unplugged,
    power_lost
};

inline constexpr std::size_t kOpenQuestions =
    static_cast<std::size_t>(OpenQuestion::power_lost) + 1;

/// What was found of them, and lines for the [falcon] table of the settings file.
class Findings final : public CheckFindings {
  public:
    Findings();
    /// Once more: the last answer counts.
    void settle(OpenQuestion question, std::string found) {
        CheckFindings::settle(static_cast<std::size_t>(question), std::move(found));
    }
};

/// "falcon-check-SERIAL-DATE.json".
[[nodiscard]] CheckedDevice checked_device(const AttachedFalcon& falcon);

}  // namespace dibhr::falcon
