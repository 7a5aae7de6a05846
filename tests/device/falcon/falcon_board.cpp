// The board's answers, and what its motors and encoders do meanwhile.
#include "tests/device/falcon/falcon_board.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace dibhr::test::falcon {

namespace {

constexpr std::array<std::uint8_t, 3> kHello{0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kHelloAnswer{0x0A, 0x44, 0x2C, 0x0D};
constexpr std::uint8_t kStrayByte = 0x13;
constexpr std::size_t kPacketBytes = 16;
constexpr unsigned kHomingBit = 1;
constexpr unsigned kLampBits = 14;

// Where an axis has its reference passed: the grip all the way out, then in
// (z > 0.170 is fully out, about 0.075 fully in); somewhat inside of both.
constexpr Vec3 kPulledOut_m{0.0, 0.0, 0.160};
constexpr Vec3 kPushedIn_m{0.0, 0.0, 0.095};

constexpr Moment kLongestPause = std::chrono::seconds(1);  // the hand does not make up for more

bool near(unsigned baud, unsigned wanted) {
    return std::abs(static_cast<int>(baud) - static_cast<int>(wanted)) <=
           static_cast<int>(wanted / 32);  // a UART bears 3 %
}

std::uint8_t letter(unsigned nibble) {
    return static_cast<std::uint8_t>('A' + nibble);
}

}  // namespace

void FalconBoard::dtr_changed(bool high) {
    if (stage_ == BoardStage::unpowered) return;
    if (high) {
        reset();
    } else if (stage_ == BoardStage::supervisor && answered_hello_) {
        stage_ = BoardStage::boot_rom;
        boot_ = BootRom();
    }
}

void FalconBoard::reset() {
    stage_ = BoardStage::supervisor;
    line_.clear();
    answered_hello_ = false;
    echo_is_faulty_ = false;
    motors_ = {};
    hand_.drive(motors_);
    lamp_ = 0;
    homing_ = false;
    const auto counts = hand_.counts();
    for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i] = {counts[i], false, false};
}

void FalconBoard::set_powered(bool powered) {
    reset();
    stage_ = powered ? BoardStage::supervisor : BoardStage::unpowered;
}

void FalconBoard::start_firmware() {
    reset();
    stage_ = BoardStage::running;
}

void FalconBoard::home() {
    for (Axis& axis : axes_) axis = {0, true, true};
}

FalconBoard::Bytes FalconBoard::receive(std::uint8_t byte, unsigned baud, Faults& faults,
                                        Moment now) {
    switch (stage_) {
        case BoardStage::supervisor:
            return hello(byte, baud, faults);
        case BoardStage::boot_rom:
            return boot(byte, baud, faults);
        case BoardStage::running:
            return command(byte, baud, faults, now);
        case BoardStage::unpowered:
        case BoardStage::dead:
            return {};
    }
    return {};
}

FalconBoard::Bytes FalconBoard::hello(std::uint8_t byte, unsigned baud, Faults& faults) {
    if (!near(baud, 9600)) return {};
    line_.push_back(byte);
    if (line_.size() > kHello.size()) line_.erase(line_.begin());
    if (!std::ranges::equal(line_, kHello)) return {};
    line_.clear();
    if (strikes(faults.ignored_hellos)) return {};
    answered_hello_ = true;
    Bytes answer(kHelloAnswer.begin(), kHelloAnswer.end());
    if (strikes(faults.leading_zero)) answer.insert(answer.begin(), 0);
    return answer;
}

FalconBoard::Bytes FalconBoard::boot(std::uint8_t byte, unsigned baud, Faults& faults) {
    const bool autobaud = boot_.state() == BootRom::State::listening;
    const std::size_t at = boot_.bytes_loaded();
    if (autobaud && strikes(faults.ignored_autobaud)) return {};
    const auto echo = boot_.receive(byte, baud);
    if (boot_.state() == BootRom::State::aborted) stage_ = BoardStage::dead;
    if (boot_.state() == BootRom::State::started) {
        stage_ = BoardStage::running;
        line_.clear();
    }
    if (!echo) return {};
    if (autobaud) {
        if (strikes(faults.leading_13)) return {kStrayByte, *echo};
        return {*echo};
    }
    if (at == static_cast<std::size_t>(faults.echo_fault_at) && !echo_is_faulty_) {
        echo_is_faulty_ = true;
        if (strikes(faults.stop_echo)) {
            stage_ = BoardStage::dead;
            return {};
        }
        if (strikes(faults.corrupt_echo)) return {static_cast<std::uint8_t>(*echo ^ 0x10U)};
    }
    return {*echo};
}

FalconBoard::Bytes FalconBoard::command(std::uint8_t byte, unsigned baud, Faults& faults,
                                        Moment now) {
    if (!near(baud, 1'500'000)) return {};
    if (line_.empty() && byte != '<') {
        ++log_.broken;
        return {};
    }
    line_.push_back(byte);
    if (line_.size() < kPacketBytes) return {};
    const bool whole = line_.back() == '>';
    if (whole) {
        perform(now);
    } else {
        log_.broken += line_.size();
    }
    line_.clear();
    if (!whole || strikes(faults.dropped_replies)) return {};
    return reply();
}

void FalconBoard::perform(Moment now) {
    for (std::size_t i = 0; i < motors_.size(); ++i) {
        unsigned value = 0;
        for (unsigned k = 0; k < 4; ++k) {
            value |= ((line_[1 + 4 * i + k] - unsigned{'A'}) & 15U) << (4 * k);
        }
        motors_[i] = static_cast<std::int16_t>(static_cast<std::uint16_t>(value));
        log_.largest = std::max(log_.largest, std::abs(int{motors_[i]}));
    }
    const unsigned flags = line_[13] - unsigned{'A'};
    homing_ = (flags & kHomingBit) != 0;
    lamp_ = flags & kLampBits;
    last_command_ = now;
    hand_.drive(motors_);
    ++log_.commands;
    ++log_.zeros_in_a_row;
    if (!limp()) {
        ++log_.with_force;
        log_.zeros_in_a_row = 0;
        if (!homed()) ++log_.force_before_homing;
    }
    if (watch_) watch_({now, motors_, lamp_, homing_});
}

FalconBoard::Bytes FalconBoard::reply() const {
    Bytes bytes{'<'};
    for (const std::int16_t encoder : encoders()) {
        const auto value = static_cast<std::uint16_t>(encoder);
        for (unsigned k = 0; k < 4; ++k) bytes.push_back(letter((value >> (4 * k)) & 15U));
    }
    const unsigned axes = homing_ ? homed_axes() : 0U;  // "documented only with homing on"
    bytes.push_back(letter((buttons_ & 15U) | (axes << 4U)));
    bytes.push_back('A');
    bytes.push_back('>');
    return bytes;
}

std::array<std::int16_t, 3> FalconBoard::encoders() const {
    const auto counts = hand_.counts();
    std::array<std::int16_t, 3> shown{};
    for (std::size_t i = 0; i < shown.size(); ++i) {
        shown[i] = static_cast<std::int16_t>(counts[i] - axes_[i].zero);
    }
    return shown;
}

bool FalconBoard::homed() const noexcept {
    return std::ranges::all_of(axes_, [](const Axis& axis) { return axis.homed; });
}

unsigned FalconBoard::homed_axes() const noexcept {
    unsigned bits = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i) bits |= axes_[i].homed ? 1U << i : 0U;
    return bits;
}

void FalconBoard::advance(Moment now) {
    const Moment passed = std::min(now - now_, kLongestPause);
    now_ = std::max(now, now_);
    if (command_holds_ != Moment{0} && now - last_command_ > command_holds_ && !limp()) {
        motors_ = {};
        hand_.drive(motors_);
    }
    hand_.advance(std::chrono::duration<double>(passed).count());
    if (stage_ == BoardStage::running && homing_ && !homed()) watch_references();
}

void FalconBoard::watch_references() {
    const Vec3 out = hand_.linkage().counts_at(kPulledOut_m).value_or(Vec3(0.0));
    const Vec3 in = hand_.linkage().counts_at(kPushedIn_m).value_or(Vec3(0.0));
    const auto counts = hand_.counts();
    for (int i = 0; i < 3; ++i) {
        Axis& axis = axes_[static_cast<std::size_t>(i)];
        const int count = counts[static_cast<std::size_t>(i)];
        if (count > out[i]) axis.seen_out = true;
        if (axis.seen_out && !axis.homed && count < in[i]) axis = {0, true, true};
    }
}

}  // namespace dibhr::test::falcon
