// What is behind the serial line: supervisor, motor controller, motors, encoders, buttons, lamp
// (device/falcon/README.md: Upload, Run-time packets, Homing and lamp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "tests/device/falcon/boot_rom.hpp"
#include "tests/device/falcon/faults.hpp"
#include "tests/device/falcon/hand_model.hpp"
#include "tests/device/falcon/moment.hpp"

namespace dibhr::test::falcon {

enum class BoardStage {
    unpowered,
    supervisor,  ///< answers the hello
    boot_rom,    ///< takes the firmware
    running,     ///< the firmware answers commands
    dead         ///< until it is put back into its boot ROM
};

/// Counts of the commands that the firmware received.
struct CommandLog {
    std::uint64_t commands{0};
    std::uint64_t with_force{0};           ///< of them, those with a motor not at zero
    std::uint64_t force_before_homing{0};  ///< of those, before all three axes were homed
    std::uint64_t zeros_in_a_row{0};       ///< newest commands without force
    std::uint64_t broken{0};               ///< bytes that belonged to no command
    int largest{0};                        ///< largest |motor| so far
};

/// A whole command, as it arrives.
struct CommandPacket {
    Moment at{0};
    std::array<std::int16_t, 3> motors{};
    unsigned lamp{0};
    bool homing{false};
};

class FalconBoard {
  public:
    using Bytes = std::vector<std::uint8_t>;
    using Watch = std::function<void(const CommandPacket&)>;

    /// DTR rising puts the motor controller back under its supervisor, DTR falling after a hello
    /// into its boot ROM. Nobody has published what DTR does: an assumption.
    void dtr_changed(bool high);
    /// A byte at `baud`; what the board answers, at the same rate.
    [[nodiscard]] Bytes receive(std::uint8_t byte, unsigned baud, Faults& faults, Moment now);
    /// Advances the hand, the motors and the axes' references to `now`.
    void advance(Moment now);

    void set_powered(bool powered);
    /// The state in which another program leaves the board.
    void start_firmware();
    /// All axes, as after pulling the grip out and pushing it in.
    void home();
    /// How long the motors hold the last command; zero: for ever. "Only for a
    /// very short time" is all that sources say. The default is an assumption.
    void hold_commands(Moment time) noexcept { command_holds_ = time; }
    void press(std::uint8_t buttons) noexcept { buttons_ = buttons; }
    /// Called with every command from now on.
    void watch(Watch watch) { watch_ = std::move(watch); }

    [[nodiscard]] HandModel& hand() noexcept { return hand_; }
    [[nodiscard]] BoardStage stage() const noexcept { return stage_; }
    [[nodiscard]] std::size_t bytes_loaded() const noexcept { return boot_.bytes_loaded(); }
    [[nodiscard]] const std::array<std::int16_t, 3>& motors() const noexcept { return motors_; }
    [[nodiscard]] bool limp() const noexcept { return motors_ == std::array<std::int16_t, 3>{}; }
    [[nodiscard]] unsigned lamp() const noexcept { return lamp_; }  ///< 2 green, 4 blue, 8 red
    [[nodiscard]] bool homing() const noexcept { return homing_; }
    [[nodiscard]] bool homed() const noexcept;
    [[nodiscard]] unsigned homed_axes() const noexcept;  ///< bits 0..2
    /// The counters as a reply carries them.
    [[nodiscard]] std::array<std::int16_t, 3> encoders() const;
    [[nodiscard]] const CommandLog& log() const noexcept { return log_; }

  private:
    struct Axis {
        int zero{0};  ///< what the counter is short of the mechanism's own count
        bool seen_out{false};
        bool homed{false};
    };

    Bytes hello(std::uint8_t byte, unsigned baud, Faults& faults);
    Bytes boot(std::uint8_t byte, unsigned baud, Faults& faults);
    Bytes command(std::uint8_t byte, unsigned baud, Faults& faults, Moment now);
    void perform(Moment now);
    [[nodiscard]] Bytes reply() const;
    void watch_references();
    void reset();

    HandModel hand_{};
    BootRom boot_{};
    BoardStage stage_{BoardStage::supervisor};
    Bytes line_{};  // of the hello, or of a command
    bool answered_hello_{false};
    bool echo_is_faulty_{false};  // whether this upload's echo was spoilt already
    std::array<Axis, 3> axes_{};
    std::array<std::int16_t, 3> motors_{};
    unsigned lamp_{0};
    bool homing_{false};
    std::uint8_t buttons_{0};
    Moment now_{0};
    Moment last_command_{0};
    Moment command_holds_{std::chrono::milliseconds(100)};
    CommandLog log_{};
    Watch watch_{};
};

}  // namespace dibhr::test::falcon
