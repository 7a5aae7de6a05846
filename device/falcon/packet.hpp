// The Falcon's run-time packets: 16 bytes each way, strictly request and reply
// (README.md, Run-time packets).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace dibhr::falcon {

inline constexpr std::size_t kPacketBytes = 16;
using Packet = std::array<std::uint8_t, kPacketBytes>;

/// One value an axis: 1 = top, 2 = right, 3 = left, seen from the front.
using Counts = std::array<std::int16_t, 3>;

/// The logo's colour; the values are the bits of the command packet.
enum class Led : std::uint8_t { off = 0, green = 2, blue = 4, red = 8 };

/// Bits of Reply::buttons.
enum class Button : std::uint8_t { plus = 1, forward = 2, centre = 4, minus = 8 };

struct Command {
    Counts motor{};  ///< -4095 .. 4095; positive pulls the thigh down
    Led led{Led::off};
    bool homing{false};  ///< the firmware detects the references of the axes

    bool operator==(const Command&) const = default;
};

struct Reply {
    Counts encoder{};
    std::uint8_t buttons{0};  ///< bits of Button
    std::uint8_t homed{0};    ///< bits 0..2: axes 1..3
};

/// Reply::homed when all three are.
inline constexpr std::uint8_t kAllAxes = 7;

/// A command without force. Its homing bit is set, as in every packet.
[[nodiscard]] constexpr Command no_force(Led led) noexcept {
    return {.motor = {}, .led = led, .homing = true};
}

[[nodiscard]] Packet encode(const Command& command) noexcept;

/// Nothing when the packet is no reply: wrong frame bytes, or letters that code no number.
[[nodiscard]] std::optional<Reply> decode(const Packet& packet) noexcept;

/// Finds the replies in a stream of bytes that may be split, joined or damaged anywhere.
class ReplyStream {
  public:
    /// Consumes bytes up to the end of the next whole reply, and returns it. The bytes after that
    /// reply stay in `bytes`, to be added next.
    [[nodiscard]] std::optional<Reply> add(std::span<const std::uint8_t>& bytes) noexcept;
    /// Drops an incomplete reply.
    void clear() noexcept { size_ = 0; }
    /// Number of bytes that belonged to no reply.
    [[nodiscard]] std::uint64_t discarded() const noexcept { return discarded_; }

  private:
    void drop_to_next_start() noexcept;

    Packet bytes_{};
    std::size_t size_{0};
    std::uint64_t discarded_{0};
};

}  // namespace dibhr::falcon
