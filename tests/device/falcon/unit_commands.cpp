// The words, and what they do.
#include "tests/device/falcon/unit_commands.hpp"

#include <chrono>
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace dibhr::test::falcon {

namespace {

using Words = std::istringstream;

template <typename Value>
Value next(Words& words, const char* what) {
    Value value{};
    if (!(words >> value)) throw std::invalid_argument(std::string("expected ") + what);
    return value;
}

/// The first of two words is true.
bool next_choice(Words& words, const char* yes, const char* no) {
    const auto word = next<std::string>(words, yes);
    if (word != yes && word != no) {
        throw std::invalid_argument(std::string("expected ") + yes + " or " + no);
    }
    return word == yes;
}

Vec3 next_point_m(Words& words) {
    Vec3 point_mm{0.0};
    for (int i = 0; i < 3; ++i) point_mm[i] = next<double>(words, "X Y Z in millimetres");
    return point_mm / 1000.0;
}

const char* name_of(BoardStage stage) {
    switch (stage) {
        case BoardStage::unpowered:
            return "unpowered";
        case BoardStage::supervisor:
            return "supervisor";
        case BoardStage::boot_rom:
            return "boot_rom";
        case BoardStage::running:
            return "running";
        case BoardStage::dead:
            return "dead";
    }
    return "?";
}

std::string state_of(FalconModel& model) {
    FalconBoard& board = model.board();
    std::ostringstream text;
    text.precision(9);
    const auto triple = [&text](const char* name, Vec3 value) {
        text << ' ' << name << ' ' << value.x << ' ' << value.y << ' ' << value.z;
    };
    const auto& motors = board.motors();
    text << "stage " << name_of(board.stage()) << " homed " << board.homed_axes() << " homing "
         << board.homing() << " lamp " << board.lamp() << " loaded " << board.bytes_loaded();
    triple("motors", Vec3(motors[0], motors[1], motors[2]));
    triple("grip_mm", board.hand().grip_m() * 1000.0);
    triple("hand_mm", board.hand().hand_m() * 1000.0);
    triple("motor_newton", board.hand().motor_force_newton());
    const CommandLog& log = board.log();
    text << " arrived " << board.hand().arrived() << " commands " << log.commands << " with_force "
         << log.with_force << " force_before_homing " << log.force_before_homing
         << " zeros_in_a_row " << log.zeros_in_a_row << " largest " << log.largest << " bytes_out "
         << model.traffic().bytes_out;
    return text.str();
}

/// Of the unit itself.
std::string model_command(FalconModel& model, const std::string& word, Words& words) {
    FalconBoard& board = model.board();
    if (word == "hand") {
        const Vec3 to = next_point_m(words);
        double seconds = 0.0;
        words >> seconds;
        board.hand().move(to, seconds);
    } else if (word == "place") {
        board.hand().place(next_point_m(words));
    } else if (word == "press") {
        board.press(static_cast<std::uint8_t>(next<unsigned>(words, "BITS") & 15U));
    } else if (word == "home") {
        board.home();
    } else if (word == "firmware") {
        board.start_firmware();
    } else if (word == "power") {
        board.set_powered(next_choice(words, "on", "off"));
    } else if (word == "hold") {
        board.hold_commands(std::chrono::milliseconds(next<int>(words, "milliseconds")));
    } else if (word == "realtime") {
        model.realtime = next_choice(words, "on", "off");
    } else if (word == "fault") {
        const auto name = next<std::string>(words, "NAME");
        if (!set_fault(model.faults, name, next<int>(words, "NUMBER"))) {
            throw std::invalid_argument("no fault is called " + name);
        }
    } else if (word == "state") {
        return state_of(model);
    } else {
        throw std::invalid_argument("no command is called " + word);
    }
    return "ok";
}

/// Of what is around the unit; false when the word is none of these.
bool access_command(UsbfsUnit& unit, const std::string& word, Words& words) {
    UsbAccess access = unit.access();
    if (word == "refuse") {
        access.open_errno = next<int>(words, "ERRNO");
    } else if (word == "driver") {
        const auto name = next<std::string>(words, "NAME");
        access.kernel_driver = name == "none" ? "" : name;
    } else if (word == "claimed") {
        access.claimed_elsewhere = next_choice(words, "yes", "no");
    } else {
        return false;
    }
    unit.set_access(access);
    return true;
}

}  // namespace

std::string perform(UsbfsUnit& unit, const std::string& line) {
    Words words(line);
    std::string word;
    words >> word;
    try {
        if (access_command(unit, word, words)) return "ok";
        return unit.wire().with(
            [&](FalconModel& model) { return model_command(model, word, words); });
    } catch (const std::invalid_argument& problem) {
        return std::string("error: ") + problem.what();
    }
}

}  // namespace dibhr::test::falcon
