// What the check of a Falcon is to find.
#include "device/falcon/check/record.hpp"

#include <array>
#include <string_view>

namespace dibhr::falcon {

namespace {

constexpr std::array<CheckQuestion, kOpenQuestions> kNamed{{
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

}  // namespace

Json as_json(Vec3 values) {
    return Json::array({values.x, values.y, values.z});
}

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string text;
    for (const std::uint8_t byte : bytes) {
        if (!text.empty()) text += ' ';
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

Findings::Findings() : CheckFindings(kNamed, "falcon") {}

CheckedDevice checked_device(const AttachedFalcon& falcon) {
    return {"falcon", "serial", falcon.serial};
}

}  // namespace dibhr::falcon
