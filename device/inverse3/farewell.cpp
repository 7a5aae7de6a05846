// A message in a frame of its own: the library makes frames only for a connection that it has.
#include "device/inverse3/farewell.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace dibhr::inverse3 {

namespace {

constexpr std::uint8_t kWholeText = 0x81;
constexpr std::uint8_t kMasked = 0x80;
constexpr std::uint8_t kLengthInTwoBytes = 126;
// It hides a page's words from proxies; there are neither on the way to this machine.
constexpr std::array<std::uint8_t, 4> kMask{0x5d, 0x1b, 0x48, 0x72};

}  // namespace

Farewell farewell(const DeviceId& arm, ForceDialect dialect) noexcept {
    OrderWriter writer;
    const std::string_view text =
        writer.write({.arm = arm, .force_newton = Vec3{0.0}, .dialect = dialect});
    std::array<std::uint8_t, Farewell::kMostBytes> frame{};
    std::size_t size = 0;
    frame[size++] = kWholeText;
    if (text.size() < kLengthInTwoBytes) {
        frame[size++] = static_cast<std::uint8_t>(kMasked | text.size());
    } else {
        frame[size++] = kMasked | kLengthInTwoBytes;
        frame[size++] = static_cast<std::uint8_t>(text.size() >> 8U);
        frame[size++] = static_cast<std::uint8_t>(text.size());
    }
    for (const std::uint8_t byte : kMask) frame[size++] = byte;
    Farewell last{.over = Farewell::Over::stream};
    if (size + text.size() > frame.size()) return last;
    for (std::size_t k = 0; k < text.size(); ++k) {
        frame[size++] = static_cast<std::uint8_t>(text[k]) ^ kMask[k % kMask.size()];
    }
    last.say(std::span(frame).first(size));
    return last;
}

}  // namespace dibhr::inverse3
