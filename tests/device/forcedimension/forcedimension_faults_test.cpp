// What a Force Dimension arm and its maker's library can do wrong: the stage, the sentence with the
// next step, the end of the force in time, and its return.
#include <glm/geometric.hpp>

#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/forcedimension/survey.hpp"
#include "tests/device/forcedimension/arm_bench.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/device/usb_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::forcedimension;
using test::let_pass;

constexpr milliseconds kInTime{25};

struct Fault {
    const char* what;
    std::function<void(Page&)> begins;
    std::function<void(Page&)> ends;
    Stage stage;
    const char* says;
    const char* next_step;
};

void switch_off(Page& page, int cause) {
    page.units[0].force_on = false;
    page.units[0].cause = cause;
}

void switch_on(Page& page) {
    page.units[0].cause = 0;
    page.units[0].force_on = true;
}

/// Those that end by themselves, without an offer that the user has to agree to.
const std::vector<Fault>& passing_faults() {
    static const std::vector<Fault> all{
        {"the force button", [](Page& page) { switch_off(page, 1); }, switch_on, Stage::force_off,
         "force button was pressed", "press it again"},
        {"the dead man's switch", [](Page& page) { switch_off(page, 6); }, switch_on,
         Stage::force_off, "nobody holds its grip", "hold the grip"},
        {"the watchdog", [](Page& page) { switch_off(page, 3); }, [](Page&) {}, Stage::force_off,
         "sent nothing for too long", "comes back by itself"},
        {"no power", [](Page& page) { page.units[0].power = false; },
         [](Page& page) { page.units[0].power = true; }, Stage::no_power, "no power",
         "switch it on"},
        {"an error of the controller", [](Page& page) { page.units[0].error = true; },
         [](Page& page) { page.units[0].error = false; }, Stage::fault, "reports a fault",
         "switch it off and on"},
        {"its position is lost", [](Page& page) { page.units[0].initialised = false; },
         [](Page& page) { page.units[0].initialised = true; }, Stage::not_initialised,
         "does not know its position", "initialise it"},
        {"unplugged", [](Page& page) { page.units[0].plugged = false; },
         [](Page& page) { page.units[0].plugged = true; }, Stage::looking, "does not answer",
         "check its USB cable"},
        {"positions that are no numbers", [](Page& page) { page.not_a_number = true; },
         [](Page& page) { page.not_a_number = false; }, Stage::looking, "does not answer",
         "check its USB cable"},
        {"slow calls", [](Page& page) { page.slow_us = 6000; },
         [](Page& page) { page.slow_us = 0; }, Stage::slow, "answers too slowly",
         "close other programs"},
    };
    return all;
}

}  // namespace

TEST_CASE("every fault ends the force in time, is named with its next step, and passes by a ramp",
          "[forcedimension]") {
    const auto number = GENERATE(range(std::size_t{0}, std::size_t{9}));
    const Fault& fault = passing_faults().at(number);
    CAPTURE(fault.what);
    Page& page = page_with_omega();
    ArmBench bench(page);
    REQUIRE(bench.press());
    fault.begins(page);
    // A mean over a quarter of a second says that calls are slow.
    if (fault.stage == Stage::slow) REQUIRE(bench.reaches(Stage::slow));
    CHECK(bench.pushes_for() <= kInTime);
    REQUIRE(bench.reaches(fault.stage));
    CHECK(bench.says(fault.says));
    CHECK(bench.says(fault.next_step));
    bench.tick_for(milliseconds(100));
    CHECK(bench.newton() == 0.0);
    fault.ends(page);
    REQUIRE(bench.tick_until([&] { return bench.newton() > 0.0; }));
    CHECK(bench.newton() < 0.1);
    CHECK(bench.steepest_rise() < 0.1);
    CHECK(bench.status().stage == Stage::ready);
    CHECK(page.wrong_calls == 0);
}

TEST_CASE("an arm that was lost, or cannot be used, was stopped by the last call but its close",
          "[forcedimension]") {
    Page& page = page_with_omega();
    ArmBench bench(page);
    REQUIRE(bench.press());
    const bool unplugged = GENERATE(true, false);
    if (unplugged) {
        page.units[0].plugged = false;
        REQUIRE(bench.tick_until([&] { return !page.units[0].open; }, kInTime));
        CHECK(bench.call(0) == "drdClose");
        CHECK(bench.call(1) == "dhdStop");
    } else {
        page.units[0].error = true;
        REQUIRE(bench.reaches(Stage::fault));
        CHECK_FALSE(page.units[0].force_on);
        const std::size_t calls = page.calls;
        bench.tick_for(milliseconds(500));
        for (std::size_t back = 0; back < page.calls - calls; ++back)
            CHECK(bench.call(back) != "dhdSetForceAndTorqueAndGripperForce");
    }
}

TEST_CASE("a force that was too fast for the arm comes back only when the user agrees",
          "[forcedimension]") {
    Page& page = page_with_omega();
    ArmBench bench(page);
    REQUIRE(bench.press());
    switch_off(page, 2);
    REQUIRE(bench.reaches(Stage::force_off));
    CHECK(bench.says("moved too fast"));
    const auto offer = bench.status().offer;
    REQUIRE(offer);
    CHECK(offer->label == "Switch the force on");
    CHECK(offer->warning.find("Hold the grip") != std::string::npos);
    bench.tick_for(milliseconds(3000));
    CHECK(bench.newton() == 0.0);
    bench.loop.device.agree_to(offer->number + 1);
    bench.tick_for(milliseconds(500));
    CHECK(bench.newton() == 0.0);
    bench.loop.device.agree_to(offer->number);
    REQUIRE(bench.tick_until([&] { return bench.newton() > 0.0; }));
    CHECK(bench.steepest_rise() < 0.1);
    // The agreement is used up.
    switch_off(page, 2);
    REQUIRE(bench.reaches(Stage::force_off));
    bench.tick_for(milliseconds(1000));
    CHECK(bench.newton() == 0.0);
}

TEST_CASE("an arm initialises itself only when the user agrees to it, this time",
          "[forcedimension]") {
    Page& page = page_with_omega();
    Unit& unit = page.units[0];
    unit.initialised = false;
    ArmBench bench(page);
    REQUIRE(bench.reaches(Stage::not_initialised));
    const auto offer = bench.status().offer;
    REQUIRE(offer);
    CHECK(offer->warning.find("move by itself") != std::string::npos);
    CHECK(offer->warning.find("keep hands") != std::string::npos);
    bench.tick_for(milliseconds(2000));
    CHECK(unit.initialisations == 0);
    CHECK_FALSE(unit.force_on);
    SECTION("agreed: the arm moves, and touches when it stands still") {
        bench.loop.device.agree_to(offer->number);
        REQUIRE(bench.reaches(Stage::initialising));
        CHECK(bench.says("keep hands away"));
        REQUIRE(bench.tick_until([&] { return unit.moves_itself.load(); }));
        REQUIRE(bench.press());
        CHECK(unit.initialisations == 1);
    }
    SECTION("agreed before the arm was replaced: it does not move") {
        unit.plugged = false;
        REQUIRE(bench.reaches(Stage::looking));
        bench.loop.device.agree_to(offer->number);
        unit.serial = 77;
        unit.plugged = true;
        REQUIRE(bench.reaches(Stage::not_initialised));
        bench.tick_for(milliseconds(1000));
        CHECK(unit.initialisations == 0);
        CHECK(bench.status().offer->number != offer->number);
    }
    SECTION("agreed, and it loses its position again: it does not move again") {
        bench.loop.device.agree_to(offer->number);
        REQUIRE(bench.press());
        unit.initialised = false;
        REQUIRE(bench.reaches(Stage::not_initialised));
        bench.tick_for(milliseconds(1000));
        bench.loop.device.agree_to(offer->number);
        bench.tick_for(milliseconds(1000));
        CHECK(unit.initialisations == 1);
    }
    SECTION("agreed, and the user stops it: it brakes") {
        page.initialisation_ms = 20'000;
        bench.loop.device.agree_to(offer->number);
        REQUIRE(bench.reaches(Stage::initialising));
        bench.tick_for(milliseconds(100));
        REQUIRE(bench.status().offer);
        CHECK(bench.status().offer->label == "Stop the arm");
        bench.loop.device.agree_to(bench.status().offer->number);
        REQUIRE(bench.reaches(Stage::not_initialised));
        CHECK_FALSE(unit.moves_itself);
        CHECK_FALSE(unit.force_on);
        CHECK(bench.says("does not know its position"));
        CHECK_FALSE(bench.status().trouble);  // the user wanted it so
        CHECK(bench.status().offer);
    }
    SECTION("agreed, and it fails: the user is asked again") {
        page.initialisation_fails = true;
        bench.loop.device.agree_to(offer->number);
        REQUIRE(bench.tick_until([&] { return bench.says("could not be initialised"); }));
        bench.tick_for(milliseconds(1000));
        CHECK(unit.initialisations == 1);
        CHECK(bench.status().offer->number != offer->number);
    }
    CHECK(page.wrong_calls == 0);
}

TEST_CASE("the end of the program stops an arm that initialises itself", "[forcedimension]") {
    Page& page = page_with_omega();
    page.units[0].initialised = false;
    page.initialisation_ms = 60'000;
    auto bench = std::make_unique<ArmBench>(page);
    REQUIRE(bench->reaches(Stage::not_initialised));
    bench->loop.device.agree_to(bench->status().offer->number);
    REQUIRE(bench->reaches(Stage::initialising));
    const auto begun = std::chrono::steady_clock::now();
    bench.reset();
    CHECK(std::chrono::steady_clock::now() - begun < milliseconds(500));
    CHECK_FALSE(page.units[0].moves_itself);
    CHECK_FALSE(page.units[0].open);
}

TEST_CASE("a call that does not return does not hold the program's end, and the arm is stopped",
          "[forcedimension]") {
    Page& page = page_with_omega();
    auto bench = std::make_unique<ArmBench>(page);
    REQUIRE(bench->press());
    page.hangs = true;
    CHECK(bench->pushes_for() <= kInTime);  // the firmware's watchdog
    bench->tick_for(milliseconds(100));
    CHECK_FALSE(bench->loop.reading.ready);
    const auto begun = std::chrono::steady_clock::now();
    bench.reset();
    CHECK(std::chrono::steady_clock::now() - begun < milliseconds(1000));
    page.hangs = false;
    // The thread that was left behind ends in the same order.
    while (page.units[0].open) let_pass(milliseconds(1));
    CHECK_FALSE(page.units[0].force_on);
}

TEST_CASE("results above zero are remarks, and no reason to take the force off",
          "[forcedimension]") {
    Page& page = page_with_omega();
    page.remarks = true;
    ArmBench bench(page);
    REQUIRE(bench.press());
    bench.tick_for(milliseconds(500));
    CHECK(bench.newton() > 1.9);
    CHECK(bench.status().failed_calls == 0);
}

TEST_CASE("slower calls make a softer spring, and then none", "[forcedimension]") {
    Page& page = page_with_omega();
    ArmBench bench(page);
    REQUIRE(bench.press());
    const double quick = bench.loop.reading.limits->max_stiffness_newton_per_mm;
    page.slow_us = 3500;
    REQUIRE(bench.tick_until([&] { return bench.status().softened; }));
    bench.tick_for(milliseconds(300));
    CHECK(bench.loop.reading.limits->max_stiffness_newton_per_mm < quick);
    CHECK(bench.status().stage == Stage::ready);
    page.slow_us = 200;
    REQUIRE(bench.tick_until([&] { return !bench.status().softened; }));
}

TEST_CASE("without a watchdog in its firmware, the user is told what to do after a crash",
          "[forcedimension]") {
    Page& page = page_with_omega();
    page.units[0].has_watchdog = false;
    ArmBench bench(page);
    REQUIRE(bench.press());
    CHECK(bench.status().watchdog_ms == 0.0);
    CHECK(bench.status().unguarded ==
          "the omega.3 1234 has no watchdog: if dibhr is killed, switch the arm off");
}

TEST_CASE("a haptic thread that stands still gets zero before the firmware's watchdog has to act",
          "[forcedimension]") {
    Page& page = page_with_omega();
    ArmBench bench(page);
    REQUIRE(bench.press());
    let_pass(kInTime);
    CHECK(bench.newton() == 0.0);
    CHECK(page.units[0].cause == 0);
    CHECK(page.units[0].force_on);
}

TEST_CASE("an arm of another program is named, and used when that one has ended",
          "[forcedimension]") {
    Page& page = page_with_omega();
    page.units[0].in_use = true;
    ArmBench bench(page);
    REQUIRE(bench.reaches(Stage::cannot_open));
    CHECK(bench.says("in use by another program"));
    CHECK(bench.says("end that one"));
    page.units[0].in_use = false;
    CHECK(bench.press());
}

TEST_CASE("an arm that may not be opened looks to the library like none, and is told of",
          "[forcedimension]") {
    const test::TemporaryFolder folder;
    test::add_usb_device(folder / "1-2", "1451", "0402");
    Page& page = fresh_page();
    ConnectionOptions options = options_for();
    options.usb_devices = folder.path();
    ArmBench bench(page, options);
    REQUIRE(bench.reaches(Stage::no_permission));
    CHECK(bench.says("you may not open it"));
    CHECK(bench.says("70-dibhr-forcedimension.rules"));
    CHECK(survey_arms(options).sentence == bench.status().sentence);
    // Without a library nothing is known of it but that it is there.
    options.library = folder.path().string();
    ForceDimensionDevice device(options, {});
    CHECK(device.status().sentence.find("get the SDK from forcedimension.com") !=
          std::string::npos);
}

TEST_CASE("an arm of an unknown type is used with low limits, and says so", "[forcedimension]") {
    Page& page = page_with_omega();
    page.units[0].type = 210;
    ArmBench bench(page);
    REQUIRE(bench.press());
    bool told = false;
    for (const DeviceLine& line : bench.loop.device.state().lines)
        told = told || line.text.find("does not know this type") != std::string::npos;
    CHECK(told);
    CHECK(page.units[0].max_newton == 4.0);
}

TEST_CASE("with libdhd alone the user initialises the arm by hand", "[forcedimension]") {
    Page& page = page_with_omega(kDhd);
    page.units[0].initialised = false;
    ArmBench bench(page, options_for(kDhd));
    REQUIRE(bench.reaches(Stage::not_initialised));
    const auto offer = bench.status().offer;
    REQUIRE(offer);
    CHECK(offer->warning.find("rest position") != std::string::npos);
    bench.loop.device.agree_to(offer->number);
    CHECK(bench.press());
    CHECK(page.units[0].initialisations == 0);
    CHECK(page.wrong_calls == 0);
}
