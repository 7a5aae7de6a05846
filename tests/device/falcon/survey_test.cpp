// What `dibhr devices` finds out about every attached Falcon.
#include "device/falcon/survey.hpp"

#include <cerrno>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using namespace dibhr::falcon;

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("Falcons are listed in the order of their serials, and left alone", "[survey]") {
    UsbBench bus;
    CHECK(attached_falcons().empty());
    Unit& second = bus.plug("SIM00002");
    second.set_access({.open_errno = EACCES});  // the system knows the serial all the same
    Unit& first = bus.plug("SIM00001");
    const auto found = attached_falcons();
    REQUIRE(found.size() == 2);
    CHECK(found[0].serial == "SIM00001");
    CHECK(found[1].serial == "SIM00002");
    CHECK(found[1].address == second.place().address);
    CHECK(first.with([](FalconModel& model) { return model.traffic().bytes_out; }) == 0);
}

TEST_CASE("every Falcon goes as far as it will, with its own next step", "[survey]") {
    UsbBench bus;
    Unit& ready = bus.plug("SIM1");
    start_firmware(ready);
    home(ready);
    start_firmware(bus.plug("SIM2"));
    Unit& forbidden = bus.plug("SIM3");
    forbidden.set_access({.open_errno = EACCES});
    bus.plug("SIM4").set_access({.claimed_elsewhere = true});
    Unit& bare = bus.plug("SIM5");

    SECTION("without a firmware file") {
        const auto found = survey_falcons(ConnectionOptions{}, FirmwareImage{});
        REQUIRE(found.size() == 5);
        CHECK(found[0].usable());
        CHECK(found[1].stage == Stage::homing);
        CHECK(holds(found[1].sentence, "pull the grip"));
        CHECK(found[2].stage == Stage::cannot_open);
        CHECK(holds(found[2].sentence, "permission"));
        CHECK(found[3].stage == Stage::cannot_open);
        CHECK(holds(found[3].sentence, "held by another program"));
        CHECK(found[4].stage == Stage::no_firmware);
        CHECK(bare.with([](FalconModel& model) { return model.board().bytes_loaded(); }) == 0);
        for (const auto& falcon : found) CHECK_FALSE(holds(falcon.sentence, "\n"));
    }
    SECTION("with one") {
        const auto found = survey_falcons(ConnectionOptions{}, any_firmware());
        REQUIRE(found.size() == 5);
        CHECK(found[4].stage == Stage::homing);
    }
    CHECK(log_of(ready).with_force == 0);
    CHECK(log_of(ready).zeros_in_a_row >= 5);
}

TEST_CASE("no Falcon is sent an image that is no firmware", "[survey]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    for (const FirmwareImage& image : bad_firmware()) {
        const auto before = traffic_of(unit).bytes_out;
        const auto found = survey_falcons(ConnectionOptions{}, image);
        REQUIRE(found.size() == 1);
        CAPTURE(found[0].sentence);
        CHECK_FALSE(found[0].usable());
        CHECK(holds(found[0].sentence, "no firmware was sent"));
        CHECK(traffic_of(unit).slow_bytes == 0);
        constexpr std::uint64_t kProbe = 10 * 16;  // ten questions of 16 bytes
        CHECK(traffic_of(unit).bytes_out == before + kProbe);
    }
    CHECK(unit.with([](FalconModel& model) { return model.board().bytes_loaded(); }) == 0);
}

TEST_CASE("why a Falcon cannot be opened is told without talking to it", "[survey]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    const AttachedFalcon falcon = attached_falcons().at(0);
    CHECK(why_it_cannot_be_opened(falcon).empty());
    unit.set_access({.open_errno = EACCES});
    CHECK(holds(why_it_cannot_be_opened(falcon), "permission"));
    unit.set_access({.claimed_elsewhere = true});
    CHECK(holds(why_it_cannot_be_opened(falcon), "held by another program"));
    bus.unplug(unit);
    CHECK(holds(why_it_cannot_be_opened(falcon), "unplugged"));
    CHECK(unit.with([](FalconModel& model) { return model.traffic().bytes_out; }) == 0);
}
