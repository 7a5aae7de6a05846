// The motor controller's boot ROM: locks onto the baud rate, echoes every byte of a TI C28x boot
// stream, and starts the program when it is whole (device/falcon/README.md, Upload).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace dibhr::test::falcon {

class BootRom {
  public:
    enum class State {
        listening,  ///< for the "A" that tells it the baud rate
        loading,
        aborted,  ///< a wrong key, or another baud rate than the locked one
        started   ///< the stream was whole
    };

    /// What it answers to a byte; nothing when it stays silent.
    std::optional<std::uint8_t> receive(std::uint8_t byte, unsigned baud);

    [[nodiscard]] State state() const noexcept { return state_; }
    [[nodiscard]] std::size_t bytes_loaded() const noexcept { return bytes_; }

  private:
    enum class Part { key, reserved, entry, length, address, words };

    void take_word(std::uint16_t word);

    State state_{State::listening};
    unsigned baud_{0};
    std::size_t bytes_{0};
    std::uint16_t low_byte_{0};
    Part part_{Part::key};
    unsigned words_left_{1};  // of the part
    std::uint16_t block_words_{0};
};

}  // namespace dibhr::test::falcon
