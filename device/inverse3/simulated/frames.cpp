// The server's side of RFC 6455.
#include "device/inverse3/simulated/frames.hpp"

#include <array>
#include <bit>

#include "core/files/plain_text.hpp"

namespace dibhr::inverse3::simulated {

namespace {

using Digest = std::array<std::uint32_t, 5>;

std::uint32_t word_at(std::string_view text, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k) word = word << 8U | static_cast<std::uint8_t>(text[at + k]);
    return word;
}

void add_block(Digest& digest, std::string_view block) {
    std::array<std::uint32_t, 80> w{};
    for (std::size_t k = 0; k < 16; ++k) w[k] = word_at(block, 4 * k);
    for (std::size_t k = 16; k < w.size(); ++k) {
        w[k] = std::rotl(w[k - 3] ^ w[k - 8] ^ w[k - 14] ^ w[k - 16], 1);
    }
    auto [a, b, c, d, e] = digest;
    for (std::size_t k = 0; k < w.size(); ++k) {
        const std::uint32_t f = k < 20   ? (b & c) | (~b & d)
                                : k < 40 ? b ^ c ^ d
                                : k < 60 ? (b & c) | (b & d) | (c & d)
                                         : b ^ c ^ d;
        constexpr std::array<std::uint32_t, 4> kRounds{0x5A827999, 0x6ED9EBA1, 0x8F1BBCDC,
                                                       0xCA62C1D6};
        const std::uint32_t next = std::rotl(a, 5) + f + e + kRounds[k / 20] + w[k];
        e = d;
        d = c;
        c = std::rotl(b, 30);
        b = a;
        a = next;
    }
    digest = {digest[0] + a, digest[1] + b, digest[2] + c, digest[3] + d, digest[4] + e};
}

/// RFC 3174, as the handshake needs it.
std::string sha1(std::string text) {
    Digest digest{0x67452301, 0xEFCDAB89, 0x98BADCFE, 0x10325476, 0xC3D2E1F0};
    const std::uint64_t bits = 8 * text.size();
    text += '\x80';
    while (text.size() % 64 != 56) text += '\0';
    for (int shift = 56; shift >= 0; shift -= 8) text += static_cast<char>(bits >> shift);
    for (std::size_t at = 0; at < text.size(); at += 64) {
        add_block(digest, std::string_view(text).substr(at, 64));
    }
    std::string bytes;
    for (const std::uint32_t word : digest) {
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift);
    }
    return bytes;
}

std::string big_endian(std::uint64_t number, int bytes) {
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
        text += static_cast<char>(number >> shift);
    }
    return text;
}

}  // namespace

std::string accept_of(std::string_view key) {
    return base64_text(sha1(std::string(key) + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"));
}

std::string frame(std::string_view payload, FrameForm form) {
    std::string bytes(
        1, static_cast<char>((form.last ? 0x80U : 0U) | static_cast<unsigned>(form.opcode)));
    const std::size_t size = payload.size();
    if (size > 0xFFFF) {
        bytes += '\x7F' + big_endian(size, 8);
    } else if (size > 125) {
        bytes += '\x7E' + big_endian(size, 2);
    } else {
        bytes += static_cast<char>(size);
    }
    return bytes.append(payload);
}

std::optional<Frame> take_frame(std::string& bytes) {
    const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(bytes[k]); };
    if (bytes.size() < 2) return {};
    const unsigned told = byte(1) & 0x7FU;
    const std::size_t wide = told == 126 ? 2 : told == 127 ? 8 : 0;
    const bool masked = (byte(1) & 0x80U) != 0;
    const std::size_t head = 2 + wide + (masked ? 4U : 0U);
    if (bytes.size() < head) return {};
    std::uint64_t size = wide == 0 ? told : 0;
    for (std::size_t k = 0; k < wide; ++k) size = size << 8U | byte(2 + k);
    if (bytes.size() - head < size) return {};
    Frame frame;
    frame.opcode = static_cast<Opcode>(byte(0) & 0x0FU);
    frame.last = (byte(0) & 0x80U) != 0;
    frame.payload = bytes.substr(head, size);
    for (std::size_t k = 0; masked && k < size; ++k) {
        frame.payload[k] = static_cast<char>(frame.payload[k] ^ bytes[head - 4 + k % 4]);
    }
    bytes.erase(0, head + size);
    return frame;
}

}  // namespace dibhr::inverse3::simulated
