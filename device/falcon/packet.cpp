// The Falcon's run-time packets.
#include "device/falcon/packet.hpp"

#include <algorithm>

namespace dibhr::falcon {

namespace {

constexpr std::uint8_t kStart = '<';
constexpr std::uint8_t kEnd = '>';
constexpr std::uint8_t kZero = 'A';  // the letter of a nibble, and of the flags, of value 0

constexpr std::size_t kFlagsAt = 13;
constexpr std::size_t kUnknownAt = 14;
constexpr std::size_t kEndAt = kPacketBytes - 1;

constexpr std::uint8_t kHomingBit = 1;
constexpr unsigned kButtonBits = 0x0F;
constexpr unsigned kHomedShift = 4;
constexpr std::uint8_t kMostFlags = 0x7F;  // three homed axes and four buttons

constexpr std::size_t kNibbles = 4;

/// Whether `byte` can stand at `place` of a reply. Nobody knows what byte 14 means.
bool fits(std::size_t place, std::uint8_t byte) noexcept {
    if (place == 0) return byte == kStart;
    if (place < kFlagsAt) return byte >= kZero && byte <= kZero + 0x0F;
    if (place == kFlagsAt) return byte >= kZero && byte <= kZero + kMostFlags;
    if (place == kUnknownAt) return true;
    return byte == kEnd;
}

/// Where the letters of an axis' number begin.
constexpr std::size_t place_of(std::size_t axis) noexcept {
    return 1 + kNibbles * axis;
}

}  // namespace

Packet encode(const Command& command) noexcept {
    Packet packet{};
    packet[0] = kStart;
    for (std::size_t axis = 0; axis < command.motor.size(); ++axis) {
        auto bits = static_cast<std::uint16_t>(command.motor[axis]);
        for (std::size_t k = 0; k < kNibbles; ++k) {
            packet[place_of(axis) + k] = static_cast<std::uint8_t>(kZero + (bits & 0x0FU));
            bits = static_cast<std::uint16_t>(bits >> 4U);
        }
    }
    const auto led = static_cast<std::uint8_t>(command.led);
    packet[kFlagsAt] = static_cast<std::uint8_t>(kZero + led + (command.homing ? kHomingBit : 0));
    packet[kUnknownAt] = kZero;
    packet[kEndAt] = kEnd;
    return packet;
}

std::optional<Reply> decode(const Packet& packet) noexcept {
    for (std::size_t place = 0; place < kPacketBytes; ++place) {
        if (!fits(place, packet[place])) return std::nullopt;
    }
    Reply reply;
    for (std::size_t axis = 0; axis < reply.encoder.size(); ++axis) {
        unsigned bits = 0;
        for (std::size_t k = kNibbles; k-- > 0;) {
            bits = bits << 4U | static_cast<unsigned>(packet[place_of(axis) + k] - kZero);
        }
        reply.encoder[axis] = static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
    }
    const auto flags = static_cast<unsigned>(packet[kFlagsAt] - kZero);
    reply.buttons = static_cast<std::uint8_t>(flags & kButtonBits);
    reply.homed = static_cast<std::uint8_t>(flags >> kHomedShift);
    return reply;
}

std::optional<Reply> ReplyStream::add(std::span<const std::uint8_t>& bytes) noexcept {
    while (!bytes.empty()) {
        const std::uint8_t byte = bytes.front();
        bytes = bytes.subspan(1);
        bytes_[size_] = byte;
        if (fits(size_++, byte)) {
            if (size_ < kPacketBytes) continue;
            size_ = 0;
            return decode(bytes_);
        }
        drop_to_next_start();
    }
    return std::nullopt;
}

// The bytes kept can still become a reply. Two replies cannot overlap (a '<' is the first or, at
// most, the second to last byte), so no whole reply is ever dropped.
void ReplyStream::drop_to_next_start() noexcept {
    std::size_t dropped = 1;
    const auto remainder_fits = [&] {
        for (std::size_t place = 0; dropped + place < size_; ++place) {
            if (!fits(place, bytes_[dropped + place])) return false;
        }
        return true;
    };
    while (!remainder_fits()) ++dropped;
    std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(dropped),
              bytes_.begin() + static_cast<std::ptrdiff_t>(size_), bytes_.begin());
    size_ -= dropped;
    discarded_ += dropped;
}

}  // namespace dibhr::falcon
