// The simulated user's answers and motions, question by question.
#include "tests/device/falcon/check_person.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>

#include "tests/support/catch.hpp"

namespace dibhr::test::falcon {

namespace {

constexpr double kStandardGravity = 9.80665;

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

void CheckPerson::ask(const std::string& question) {
    heard += question + "\n";
    questions.push_back(question);
    line_ = instead(question);
    if (!line_) line_ = do_it(question);
}

std::optional<std::string> CheckPerson::next_line() {
    if (has_left) return std::nullopt;
    return std::exchange(line_, std::nullopt);
}

CheckConsole::Request CheckPerson::request() {
    unit_.with([this](FalconModel& model) {
        int commanded = 0;
        for (const int motor : model.board().motors()) {
            commanded = std::max(commanded, std::abs(motor));
        }
        if (commanded < most_counts_) return;
        most_counts_ = commanded;
        pressed_newton = -model.board().hand().motor_force_newton().y;
    });
    return wish_under_force();
}

void CheckPerson::hold_grip(Vec3 at_m) {
    unit_.with([&](FalconModel& model) { model.board().hand().place(at_m); });
}

std::optional<std::string> CheckPerson::do_it(const std::string& question) {
    if (holds(question, "Pull the grip all the way out")) {
        home(unit_);
        return std::nullopt;
    }
    if (holds(question, "straight out to its stop")) hold_grip({0.0, 0.0, 0.165});
    if (holds(question, "straight in to its stop")) hold_grip({0.0, 0.0, 0.080});
    if (holds(question, "between the stops")) return "85";
    if (holds(question, "ruler's left")) hold_grip({-0.03, 0.0, 0.115});
    if (holds(question, "ruler's right")) hold_grip({0.03, 0.0, 0.115});
    if (holds(question, "along the ruler")) return "60";
    // Far out its full force moves the hand by less than 30 mm.
    if (holds(question, "press down")) hold_grip({0.0, 0.0, 0.150});
    if (holds(question, "Type yes")) return "yes";
    if (holds(question, "What did the scale show")) {
        return std::to_string(pressed_newton / kStandardGravity * 1000.0);
    }
    if (holds(question, "Press and hold the button")) {
        const std::uint8_t bits = holds(question, "plus")      ? 1
                                  : holds(question, "forward") ? 2
                                  : holds(question, "centre")  ? 4
                                                               : 8;
        unit_.with([&](FalconModel& model) { model.board().press(bits); });
        return std::nullopt;
    }
    if (holds(question, "Release the button")) {
        unit_.with([](FalconModel& model) { model.board().press(0); });
        return std::nullopt;
    }
    if (holds(question, "Unplug the USB cable")) {
        bus_.unplug(unit_);
        return std::nullopt;
    }
    if (holds(question, "Plug the USB cable in")) {
        bus_.plug(unit_);
        return std::nullopt;
    }
    if (holds(question, "Unplug the power adapter from")) {
        unit_.with([](FalconModel& model) { model.board().set_powered(false); });
        return std::nullopt;
    }
    if (holds(question, "Plug the power adapter in") || holds(question, "wait ten seconds")) {
        unit_.with([](FalconModel& model) { model.board().set_powered(true); });
    }
    return holds(question, "F and Enter") ? "f" : "";
}

dibhr::falcon::CheckTimes short_times() {
    using std::chrono::milliseconds;
    dibhr::falcon::CheckTimes times;
    times.rate = times.homing_bit = milliseconds(30);
    times.sample = milliseconds(5);
    times.button_calm = milliseconds(5);
    times.ramp = milliseconds(20);
    times.hold = times.short_hold = milliseconds(20);
    times.silences = {milliseconds(1), milliseconds(20)};
    return times;
}

std::string json_value(const std::string& json, const std::string& path) {
    sqlite3* opened = nullptr;
    REQUIRE(sqlite3_open(":memory:", &opened) == SQLITE_OK);
    const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(opened, sqlite3_close);
    sqlite3_stmt* prepared = nullptr;
    REQUIRE(sqlite3_prepare_v2(opened, "SELECT json_valid(?1), json_extract(?1, ?2)", -1, &prepared,
                               nullptr) == SQLITE_OK);
    const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement(prepared,
                                                                          sqlite3_finalize);
    sqlite3_bind_text(prepared, 1, json.c_str(), -1, SQLITE_STATIC);
    sqlite3_bind_text(prepared, 2, path.c_str(), -1, SQLITE_STATIC);
    INFO(json);
    REQUIRE(sqlite3_step(prepared) == SQLITE_ROW);
    REQUIRE(sqlite3_column_int(prepared, 0) == 1);
    const auto* const text = sqlite3_column_text(prepared, 1);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace dibhr::test::falcon
