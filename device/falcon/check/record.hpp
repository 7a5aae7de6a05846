// The questions of the check of a Falcon, which ../README.md leaves open.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/vec.hpp"
#include "device/hand/check/record.hpp"

namespace dibhr::falcon {

[[nodiscard]] inline Json as_json(Vec3 values) {
    return Json::array({values.x, values.y, values.z});
}

/// "0A 44 2C 0D".
[[nodiscard]] inline std::string hexadecimal(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string text;
    for (const std::uint8_t byte : bytes) {
        if (!text.empty()) text += ' ';
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

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

inline constexpr std::array<CheckQuestion, 15> kOpenQuestions{{
    {"identity", "What it says it is"},
    {"upload-speed", "Firmware at 142 857 and 140 351 baud"},
    {"stray-bytes", "Stray bytes before the hello's and the A's answer"},
    {"loading-again", "Loading again without a power cycle"},
    {"last-byte", "Byte 14 of a reply"},
    {"reply-rate", "Replies a second"},
    {"event-character", "The event character >"},
    {"homing-bit", "The homing bit cleared"},
    {"end-stops", "Counts at the end stops"},
    {"angle-at-zero", "Thigh angle at count 0"},
    {"after-last-packet", "The force after the last packet"},
    {"torque-scale", "Motor counts a newton metre"},
    {"buttons", "Button bits"},
    {"usb-unplugged", "USB unplugged, power on"},
    {"power-lost", "Power off, USB on"},
}};
static_assert(kOpenQuestions.size() == static_cast<std::size_t>(OpenQuestion::power_lost) + 1);

}  // namespace dibhr::falcon
