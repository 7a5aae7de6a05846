// A service's end of RFC 6455: the handshake's answer, frames out, frames in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dibhr::inverse3::simulated {

enum class Opcode : std::uint8_t { rest = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

/// Of Sec-WebSocket-Key: what Sec-WebSocket-Accept has to be (RFC 6455, 4.2.2).
[[nodiscard]] std::string accept_of(std::string_view key);

/// How a frame is written.
struct FrameForm {
    Opcode opcode{Opcode::text};
    bool last{true};
};

/// A frame as a service sends it, without a mask.
[[nodiscard]] std::string frame(std::string_view payload, FrameForm form = {});

/// One frame as it came.
struct Frame {
    Opcode opcode{Opcode::text};
    bool last{true};
    std::string payload{};
};

/// The first frame of `bytes`, unmasked and taken off them; nothing while it is not whole.
[[nodiscard]] std::optional<Frame> take_frame(std::string& bytes);

}  // namespace dibhr::inverse3::simulated
