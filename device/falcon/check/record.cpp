// What the check of a Falcon is to find.
#include "device/falcon/check/record.hpp"

#include <string_view>

namespace dibhr::falcon {

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

}  // namespace dibhr::falcon
