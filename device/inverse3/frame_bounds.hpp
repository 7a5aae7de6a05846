// Where one frame of a WebSocket ends in what came over its socket.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dibhr::inverse3 {

/// Cuts the service's bytes at the end of the HTTP head and of every frame (RFC 6455, 5.2), so that
/// nobody reads ahead, and what was not asked for is seen to wait.
class FrameBounds {
  public:
    /// How many of the bytes to come belong to the same head or frame: 1 .. their number. They are
    /// then gone. `bytes` is not empty.
    [[nodiscard]] std::size_t take(std::span<const std::uint8_t> bytes) noexcept;

  private:
    [[nodiscard]] std::size_t take_http(std::span<const std::uint8_t> bytes) noexcept;
    void add_to_head(std::uint8_t byte) noexcept;
    [[nodiscard]] std::size_t head_length() const noexcept;
    [[nodiscard]] std::uint64_t payload_length() const noexcept;

    static constexpr std::size_t kLongestHead = 14;

    bool in_http_{true};
    std::size_t line_ends_{0};  // of "\r\n\r\n", how many came in a row
    std::array<std::uint8_t, kLongestHead> head_{};
    std::size_t head_size_{0};
    std::uint64_t left_{0};  // of the payload
};

}  // namespace dibhr::inverse3
