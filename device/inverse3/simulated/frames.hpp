// The server's side of RFC 6455: the answer to a handshake, frames out, frames in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dibhr::inverse3::simulated {

enum class Opcode : std::uint8_t { rest = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

/// The value of Sec-WebSocket-Accept for a Sec-WebSocket-Key (RFC 6455, 4.2.2).
[[nodiscard]] std::string accept_of(std::string_view key);

/// How a frame is written.
struct FrameForm {
    Opcode opcode{Opcode::text};
    bool last{true};
};

/// A frame as a server sends it, without a mask.
[[nodiscard]] std::string frame(std::string_view payload, FrameForm form = {});

/// A received frame.
struct Frame {
    Opcode opcode{Opcode::text};
    bool last{true};
    std::string payload{};
};

/// Removes the first frame from `bytes` and returns it unmasked; nothing while it is incomplete.
[[nodiscard]] std::optional<Frame> take_frame(std::string& bytes);

}  // namespace dibhr::inverse3::simulated
