// From a bare unit to one that answers, through the real libusb, and every way it can fail.
#include "device/falcon/bring_up.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "tests/device/falcon/synthetic_firmware.hpp"
#include "tests/device/falcon/usb_bench.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using dibhr::falcon::answers;
using dibhr::falcon::FtdiPort;
using dibhr::falcon::UploadError;
using dibhr::falcon::UploadOptions;
using dibhr::test::let_pass;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// One unit and an open port to it.
struct Bench {
    UsbBench bus{};
    Unit& unit{bus.plug()};
    dibhr::falcon::UsbContext usb{};
    FtdiPort port{usb, attached_falcons(usb).at(0)};
    std::stop_source stop{};
    std::vector<double> told{};
    int tries{0};

    bool load(const std::vector<std::uint8_t>& image = dibhr::test::synthetic_firmware(600)) {
        UploadOptions options;
        options.on_progress = [this](double part, int number) {
            told.push_back(part);
            tries = number;
        };
        return upload(port, image, options, stop.get_token());
    }
    std::string failure() {
        try {
            (void)load();
        } catch (const UploadError& error) {
            return error.what();
        }
        return "";
    }
    BoardStage stage() {
        return unit.with([](FalconModel& model) { return model.board().stage(); });
    }
};

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a bare unit does not answer; loaded, it does, and keeps doing so", "[upload]") {
    Bench bench;
    CHECK_FALSE(answers(bench.port, bench.stop.get_token()));
    CHECK(bench.load());
    CHECK(bench.tries == 1);
    CHECK(bench.stage() == BoardStage::running);
    CHECK(std::is_sorted(bench.told.begin(), bench.told.end()));
    CHECK_THAT(bench.told.back(), Catch::Matchers::WithinAbs(1.0, 1e-12));
    CHECK(answers(bench.port, bench.stop.get_token()));
}

TEST_CASE("asking a unit that runs leaves its program and its homing alone", "[upload]") {
    Bench bench;
    bench.unit.with([](FalconModel& model) { model.board().start_firmware(); });
    CHECK(answers(bench.port, bench.stop.get_token()));
    CHECK(bench.stage() == BoardStage::running);
    CHECK(bench.unit.with([](FalconModel& model) { return model.board().log().with_force; }) == 0);
}

TEST_CASE("an image of any length arrives whole", "[upload]") {
    Bench bench;
    const auto words = GENERATE(4U, 31U, 62U, 63U, 3600U);
    const auto image = dibhr::test::synthetic_firmware(words);
    CHECK(bench.load(image));
    CHECK(bench.unit.with([](FalconModel& model) { return model.board().bytes_loaded(); }) ==
          image.size());
}

TEST_CASE("stray bytes before the answers do no harm", "[upload]") {
    Bench bench;
    bench.unit.set_faults({.leading_zero = kForEver, .leading_13 = kForEver, .ignored_hellos = 3});
    CHECK(bench.load());
    CHECK(bench.tries == 1);
}

TEST_CASE("what fails now and then is tried again from the first step", "[upload]") {
    Bench bench;
    bench.unit.set_faults(GENERATE(Faults{.ignored_autobaud = 2},
                                   Faults{.corrupt_echo = 2, .echo_fault_at = 777},
                                   Faults{.stop_echo = 2, .echo_fault_at = 777}));
    CHECK(bench.load());
    CHECK(bench.tries == 3);
}

TEST_CASE("a fault that stays is named with its step after ten tries", "[upload]") {
    struct Staying {
        Faults faults;
        std::string step;
    };
    const auto staying = GENERATE(
        Staying{{.ignored_autobaud = kForEver}, "autobaud"},
        Staying{{.corrupt_echo = kForEver, .echo_fault_at = 99}, "echo differs at byte 99"},
        Staying{{.stop_echo = kForEver, .echo_fault_at = 99}, "echo stopped at byte 99"});
    Bench bench;
    bench.unit.set_faults(staying.faults);
    const std::string sentence = bench.failure();
    CAPTURE(sentence);
    CHECK(holds(sentence, staying.step));
    CHECK(holds(sentence, "SIM00001"));
    CHECK(holds(sentence, "10 tries"));
    CHECK_FALSE(holds(sentence, "\n"));
    CHECK(bench.tries == 10);
}

TEST_CASE("a unit without power is told after sixty-four hellos of 0.1 s", "[upload]") {
    Bench bench;
    bench.unit.with([](FalconModel& model) { model.board().set_powered(false); });
    const auto begin = Clock::now();
    const std::string sentence = bench.failure();
    CAPTURE(sentence);
    CHECK(holds(sentence, "no hello"));
    CHECK(holds(sentence, "adapter"));
    CHECK(Clock::now() - begin >= milliseconds(6400));
    CHECK(Clock::now() - begin < milliseconds(6600));
}

TEST_CASE("an upload stops at once when the program wants to leave", "[upload]") {
    Bench bench;
    bench.unit.set_faults(GENERATE(Faults{.ignored_hellos = kForEver},
                                   Faults{.stop_echo = kForEver, .echo_fault_at = 99}));
    Clock::time_point asked;
    std::thread person([&] {
        let_pass(milliseconds(150));
        asked = Clock::now();
        bench.stop.request_stop();
    });
    CHECK_FALSE(bench.load());
    const auto left = Clock::now();
    person.join();
    CHECK(left - asked <= milliseconds(51));  // one look at what comes
}
