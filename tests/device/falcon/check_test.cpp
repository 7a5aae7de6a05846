// The check of a simulated Falcon: its findings, and how it ends.
#include "device/falcon/check/check.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "tests/device/falcon/check_bench.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using Catch::Matchers::WithinAbs;

constexpr int kSteps = 9;
constexpr double kScale = 10000.0;   // of the simulated motors
constexpr double kAngle_deg = 35.0;  // of the simulated thighs

}  // namespace

TEST_CASE(
    "a person who does all that is asked settles every open question, and all raw numbers are "
    "in the record",
    "[check]") {
    Checked check;
    check.options.times.hold = std::chrono::milliseconds(1000);
    const CheckResult result = check.run();
    CHECK(result.fault.empty());
    CHECK(result.record == check.options.record);
    for (int step = 0; step < kSteps; ++step) {
        CAPTURE(step, check.value("$.steps[" + std::to_string(step) + "].remark"));
        CHECK(check.end_of(step) == "done");
    }
    CHECK_FALSE(holds(check.person.heard, "still open"));
    CHECK_THAT(std::stod(check.setting("counts-per-newton-metre")), WithinAbs(kScale, 100.0));
    CHECK_THAT(std::stod(check.setting("angle-at-zero")), WithinAbs(kAngle_deg, 0.5));
    CHECK(check.setting("event-character") == "true");
    CHECK(holds(check.person.heard, "[falcon]\n  event-character = true\n"));

    const CommandLog log = log_of(check.unit);
    CHECK(log.force_before_homing == 0);
    CHECK(log.with_force > 0);
    CHECK(log.largest == 4095);
    CHECK(log.zeros_in_a_row >= 5);

    CHECK(check.value("$.serial") == "SIM00001");
    CHECK(check.value("$.steps[0].measured.device.idProduct") == "0xcb48");
    CHECK(check.value("$.steps[0].measured.device.raw").size() == 18 * 3 - 1);
    CHECK(check.value(
              "$.steps[0].measured.configuration.interfaces[0].endpoints[1].wMaxPacketSize") ==
          "64");
    CHECK(check.value("$.steps[1].measured.probe.answers") == "0");
    CHECK(check.value("$.steps[1].measured.upload_1.baud") == "142857");
    CHECK(check.value("$.steps[1].measured.upload_2.baud") == "140351");
    CHECK(check.value("$.steps[1].measured.upload_2.steps[0].heard") == "0A 44 2C 0D");
    CHECK(check.number("$.steps[2].measured.latency_1_ms.round_trip_ms_p99") > 0.0);
    CHECK(check.value(
              "$.steps[2].measured.latency_16_ms_event_character.latency_timer_ms_read_back") ==
          "16");
    CHECK(check.value("$.steps[3].measured.cleared.homed_always") == "0");
    CHECK(check.value("$.steps[3].measured.set_again.homed_last") == "7");
    CHECK(check.number("$.steps[4].measured.left_to_right_mm_by_ruler") == 60.0);
    CHECK_THAT(check.number("$.steps[4].measured.by_libnifalcon.out_mm[2]"), WithinAbs(165.0, 0.1));
    CHECK(check.value("$.steps[4].measured.by_martin_hillier_50.in_mm[2]") != "");
    CHECK(check.number("$.steps[6].measured.\"1000_counts\".scale_g") > 0.0);
    CHECK(check.value("$.steps[7].measured.centre.bits") == "4");
    CHECK(check.value("$.steps[8].measured.usb_unplugged.error") == "LIBUSB_ERROR_NO_DEVICE");
    CHECK(check.value("$.steps[8].measured.usb_unplugged.firmware_kept") == "1");
    CHECK(check.value("$.steps[8].measured.power_lost.error") == "LIBUSB_ERROR_TIMEOUT");
    CHECK(check.value("$.steps[8].measured.power_lost.firmware_kept") == "0");
}

TEST_CASE("with nobody there, what needs nobody is measured and recorded", "[check]") {
    Checked check;
    check.person.has_left = true;
    CHECK(check.run().fault.empty());
    for (int step = 0; step < kSteps; ++step) {
        CAPTURE(step);
        CHECK(check.end_of(step) == (step < 3 ? "done" : "skipped"));
    }
    CHECK(check.number("$.steps[2].measured.latency_1_ms.replies") > 0.0);
    CHECK(log_of(check.unit).with_force == 0);
}

TEST_CASE("quitting at any question leaves no force, five empty packets, and the record",
          "[check]") {
    const std::string title =
        GENERATE(as<std::string>(), "What the Falcon says it is", "Firmware", "Reply rate",
                 "Homing", "End stops and lengths", "The force after the last packet",
                 "Force on a kitchen scale", "Buttons", "Cables");
    CAPTURE(title);
    std::size_t at = 0;
    std::size_t end = 1;
    for (; at < end; ++at) {
        Checked check;
        check.only(title);
        const bool by_ctrl_c = at % 2 == 1;
        const auto usual = check.person.instead;
        std::size_t asked = 0;  // in this step
        check.person.instead = [&](const std::string& question) -> std::optional<std::string> {
            const auto as_usual = usual(question);
            if (as_usual == "s" || asked++ != at) return as_usual;
            end = at + 2;  // perhaps one more
            check.person.ctrl_c = by_ctrl_c;
            return by_ctrl_c ? "" : "q";
        };
        CHECK(check.run().fault.empty());
        CAPTURE(at, check.person.questions.back());
        CHECK(is_limp(check.unit));
        const CommandLog log = log_of(check.unit);
        CHECK(log.force_before_homing == 0);
        const bool cable_is_out = holds(check.person.questions.back(), "Plug the USB cable in");
        CHECK((log.commands == 0 || log.zeros_in_a_row >= 5 || cable_is_out));
        int quit = 0;
        for (int step = 0; step < kSteps; ++step) quit += check.end_of(step) == "quit" ? 1 : 0;
        CHECK(quit == (end > at + 1 ? 1 : 0));
    }
    CHECK(at >= 2);
}

TEST_CASE("a Falcon that goes at any question ends the check with one line and the record",
          "[check]") {
    for (const std::size_t last : {0U, 2U, 4U, 12U}) {
        Checked check;
        CAPTURE(last);
        check.person.instead = [&](const std::string&) -> std::optional<std::string> {
            if (check.person.questions.size() == last + 1) check.bus.unplug(check.unit);
            return std::nullopt;
        };
        const std::string fault = check.run().fault;
        CAPTURE(fault);
        CHECK(holds(fault, "SIM00001 was unplugged"));
        CHECK_FALSE(holds(fault, "\n"));
        int failed = 0;
        for (int step = 0; step < kSteps; ++step) {
            if (check.end_of(step) != "failed") continue;
            ++failed;
            CHECK(check.value("$.steps[" + std::to_string(step) + "].remark") == fault);
        }
        CHECK(failed == 1);
    }
}

TEST_CASE("homing goes on while a person pulls the grip out and pushes it in", "[check]") {
    Checked check;
    check.only("Homing");
    start_firmware(check.unit);  // not homed any more
    const auto usual = check.person.instead;
    bool asked = false;
    check.person.instead = [&](const std::string& question) -> std::optional<std::string> {
        if (!holds(question, "Pull the grip all the way out")) return usual(question);
        asked = true;
        check.unit.with([](FalconModel& model) {
            dibhr::test::falcon::HandModel& hand = model.board().hand();
            for (const double z_m : {0.172, 0.080, 0.115}) {
                hand.move({0.0, 0.0, z_m}, 0.05);
                hand.move({0.0, 0.0, z_m}, 0.15);
            }
        });
        return "";  // Enter does no harm
    };
    CHECK(check.run().fault.empty());
    CHECK(asked);
    CHECK(check.end_of(3) == "done");
    CHECK(holds(check.person.heard, "top ------ "));
    CHECK(check.value("$.steps[3].measured.references[2].counts_after[0]") != "");
    CHECK(holds(check.found("homing-bit"), "told only while the bit is set"));
}

TEST_CASE("an upload's stray bytes and tries are in the record", "[check]") {
    Checked check;
    check.only("Firmware");
    check.unit.with([](FalconModel& model) { model.board().set_powered(true); });  // bare again
    check.unit.set_faults(
        {.leading_zero = kForEver, .leading_13 = kForEver, .ignored_autobaud = 1});
    CHECK(check.run().fault.empty());
    CHECK(check.value("$.steps[1].measured.upload_1.tries") == "2");
    CHECK(holds(check.found("upload-speed"), "142 857: at try 2"));
    CHECK(holds(check.found("stray-bytes"), "00 before the hello's answer"));
    CHECK(holds(check.found("stray-bytes"), "13 before the autobaud's answer"));
}

TEST_CASE("an upload that fails is tried again after a power cycle", "[check]") {
    Checked check;
    check.only("Firmware");
    check.unit.with([](FalconModel& model) { model.board().set_powered(true); });  // bare again
    check.unit.set_faults({.corrupt_echo = kForEver, .echo_fault_at = 99});
    const auto usual = check.person.instead;
    int asked = 0;
    check.person.instead = [&](const std::string& question) -> std::optional<std::string> {
        if (!holds(question, "wait ten seconds")) return usual(question);
        ++asked;
        check.unit.set_faults({});
        return std::nullopt;
    };
    CHECK(check.run().fault.empty());
    CHECK(asked == 1);
    CHECK(check.value("$.steps[1].measured.upload_1.tries") == "10");
    CHECK(holds(check.value("$.steps[1].measured.upload_1.failure"), "echo differs at byte 99"));
    CHECK(check.value("$.steps[1].measured.upload_2.after_power_cycle") == "1");
    CHECK(check.value("$.steps[1].measured.upload_2.done") == "1");
}

TEST_CASE("a Falcon without firmware and without a file ends the check with where one comes from",
          "[check]") {
    Checked check;
    check.options.firmware = {};
    const std::string fault = check.run().fault;
    CHECK(holds(fault, "nvent_firmware.bin"));
    CHECK(holds(fault, "--check --firmware FILE"));
    CHECK(check.end_of(0) == "done");
    CHECK(check.end_of(1) == "failed");
    CHECK(check.end_of(2) == "not begun");
}

TEST_CASE("a person who loads nothing into a bare Falcon is not told that it failed", "[check]") {
    Checked check;
    check.person.instead = [](const std::string& question) -> std::optional<std::string> {
        if (holds(question, "load nothing")) return "s";
        return std::nullopt;
    };
    CHECK(check.run().fault.empty());
    CHECK(check.end_of(1) == "skipped");
    CHECK(check.end_of(2) == "not begun");
}

TEST_CASE("what cannot begin is told before anything is touched", "[check]") {
    Checked check;
    SECTION("a record that cannot be written") {
        check.options.record = check.folder / "none" / "record.json";
        CHECK_THROWS_AS(check.run(), dibhr::InputError);
        CHECK(check.unit.with([](FalconModel& model) { return model.traffic().bytes_out; }) == 0);
    }
    SECTION("a serial that is not attached") {
        check.options.serial = "SIM00002";
        CHECK_THROWS_AS(check.run(), dibhr::DeviceError);
    }
    SECTION("no Falcon at all") {
        check.bus.unplug(check.unit);
        CHECK_THROWS_AS(check.run(), dibhr::DeviceError);
    }
    CHECK(check.person.questions.empty());
}
