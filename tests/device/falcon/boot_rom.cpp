// The boot stream: key, eight reserved words, entry point, blocks, and a zero length at its end.
#include "tests/device/falcon/boot_rom.hpp"

namespace dibhr::test::falcon {

namespace {

constexpr std::uint16_t kKey = 0x08AA;
constexpr unsigned kReservedWords = 8;
constexpr unsigned kMaxAutobaud = 200'000;  // both upload rates lock, the run-time rate does not

}  // namespace

std::optional<std::uint8_t> BootRom::receive(std::uint8_t byte, unsigned baud) {
    if (state_ == State::listening) {
        if ((byte != 'A' && byte != 'a') || baud > kMaxAutobaud) return std::nullopt;
        baud_ = baud;
        state_ = State::loading;
        return byte;
    }
    if (state_ == State::loading && baud != baud_) state_ = State::aborted;
    if (state_ != State::loading) return std::nullopt;
    if (bytes_++ % 2 == 0) {
        low_byte_ = byte;
    } else {
        take_word(static_cast<std::uint16_t>(low_byte_ | byte << 8U));
    }
    return byte;
}

void BootRom::take_word(std::uint16_t word) {
    --words_left_;
    switch (part_) {
        case Part::key:
            if (word != kKey) state_ = State::aborted;
            part_ = Part::reserved;
            words_left_ = kReservedWords;
            return;
        case Part::reserved:
            if (words_left_ > 0) return;
            part_ = Part::entry;
            words_left_ = 2;
            return;
        case Part::length:
            if (word == 0) state_ = State::started;
            block_words_ = word;
            part_ = Part::address;
            words_left_ = 2;
            return;
        case Part::address:
            if (words_left_ > 0) return;
            part_ = Part::words;
            words_left_ = block_words_;
            return;
        case Part::entry:
        case Part::words:
            if (words_left_ > 0) return;
            part_ = Part::length;
            words_left_ = 1;
            return;
    }
}

}  // namespace dibhr::test::falcon
