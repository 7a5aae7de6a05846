// The USB thread: which Falcon it opens, what it waits for, how it handles a lost Falcon and opens
// it again.
#include "device/falcon/driver.hpp"

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/falcon/usb.hpp"
#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using namespace dibhr::falcon;
using dibhr::Vec3;
using std::chrono::milliseconds;

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The driver alone, without a haptic thread.
struct Alone {
    ThreadBuffers buffers{};
    Driver driver;

    explicit Alone(ConnectionOptions options = {}, FirmwareImage firmware = {})
        : driver(std::move(options), std::move(firmware), buffers) {}

    [[nodiscard]] bool comes_to(Stage stage) {
        return eventually([&] { return driver.status().stage == stage; });
    }
};

Unit& plug_homed(UsbBench& bus, const std::string& serial) {
    Unit& unit = bus.make(serial);
    start_firmware(unit);
    home(unit);
    bus.plug(unit);
    return unit;
}

}  // namespace

TEST_CASE("of several Falcons the chosen serial is taken, and the first when none is chosen",
          "[driver]") {
    const std::vector<AttachedFalcon> attached{{1, 4, "A1"}, {1, 2, "B2"}};
    CHECK(choose(attached, "B2") == attached[1]);
    CHECK(choose(attached, "") == attached[0]);
    CHECK_FALSE(choose(attached, "C3").has_value());
    CHECK_FALSE(choose({}, "").has_value());
}

TEST_CASE("when the chosen Falcon is not there, those that are there are named", "[driver]") {
    const std::vector<AttachedFalcon> attached{{1, 4, "A1"}, {1, 2, "B2"}};
    const std::string sentence = why_none(attached, "C3");
    CHECK(holds(sentence, "C3 is not attached"));
    CHECK(holds(sentence, "A1, B2"));
    CHECK(holds(why_none({}, ""), "no Falcon is attached"));
    CHECK(holds(why_none({}, "C3"), "C3 is not attached"));
}

TEST_CASE("nothing attached is said, and the next Falcon plugged in is found", "[driver]") {
    UsbBench bus;
    Alone alone;
    CHECK(eventually([&] { return holds(alone.driver.status().sentence, "no Falcon"); }));
    CHECK(alone.driver.status().stage == Stage::looking);
    CHECK_FALSE(alone.driver.status().trouble);
    plug_homed(bus, "SIM00001");
    CHECK(alone.comes_to(Stage::ready));
}

TEST_CASE("the wanted one of two Falcons is used and the other one is left alone", "[driver]") {
    UsbBench bus;
    Unit& first = plug_homed(bus, "SIM00001");
    Unit& second = plug_homed(bus, "SIM00002");
    const std::string wanted = GENERATE("", "SIM00001", "SIM00002");
    Alone alone({.serial = wanted});
    REQUIRE(alone.comes_to(Stage::ready));
    CHECK(alone.driver.status().serial == (wanted.empty() ? "SIM00001" : wanted));
    CHECK(log_of(wanted == "SIM00002" ? second : first).commands > 0);
    CHECK(log_of(wanted == "SIM00002" ? first : second).commands == 0);
}

TEST_CASE("a serial that is not attached names those that are, until it is plugged in",
          "[driver]") {
    UsbBench bus;
    plug_homed(bus, "SIM00001");
    Alone alone({.serial = "SIM00007"});
    CHECK(eventually([&] { return holds(alone.driver.status().sentence, "SIM00001"); }));
    CHECK(alone.driver.status().stage == Stage::looking);
    CHECK(alone.driver.status().trouble);
    plug_homed(bus, "SIM00007");
    CHECK(alone.comes_to(Stage::ready));
    CHECK(alone.driver.status().serial == "SIM00007");
}

TEST_CASE("a Falcon without permission is named with the way to get it, and taken once it is given",
          "[driver]") {
    UsbBench bus;
    Unit& unit = plug_homed(bus, "SIM00001");
    unit.set_access({.open_errno = EACCES});
    Alone alone;
    REQUIRE(alone.comes_to(Stage::cannot_open));
    const Status status = alone.driver.status();
    CAPTURE(status.sentence);
    CHECK(holds(status.sentence, "SIM00001"));
    CHECK(holds(status.sentence, "permission"));
    CHECK((holds(status.sentence, "sudo cp") || holds(status.sentence, "plugdev")));
    CHECK(status.trouble);
    unit.set_access({});
    CHECK(alone.comes_to(Stage::ready));
    CHECK_FALSE(alone.driver.status().trouble);
}

TEST_CASE("a Falcon that another program holds is said to be held; a kernel driver lets go",
          "[driver]") {
    UsbBench bus;
    Unit& unit = plug_homed(bus, "SIM00001");
    SECTION("another program") {
        unit.set_access({.claimed_elsewhere = true});
        Alone alone;
        REQUIRE(alone.comes_to(Stage::cannot_open));
        CHECK(holds(alone.driver.status().sentence, "held by another program"));
        unit.set_access({});
        CHECK(alone.comes_to(Stage::ready));
    }
    SECTION("the kernel's driver") {
        unit.set_access({.kernel_driver = "ftdi_sio"});
        Alone alone;
        CHECK(alone.comes_to(Stage::ready));
    }
}

TEST_CASE("a Falcon without firmware says which file is wanted, and takes it at once", "[driver]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    Alone alone;
    REQUIRE(alone.comes_to(Stage::no_firmware));
    CHECK(holds(alone.driver.status().sentence, "firmware"));
    CHECK_FALSE(holds(alone.driver.status().sentence, "\n"));
    CHECK(unit.with([](FalconModel& model) { return model.board().bytes_loaded(); }) == 0);
    alone.driver.use_firmware(any_firmware());
    CHECK(alone.comes_to(Stage::homing));
    CHECK_THAT(alone.driver.status().loaded, Catch::Matchers::WithinAbs(1.0, 1e-12));
    CHECK(alone.driver.status().load_try == 1);
}

TEST_CASE("with firmware at hand and no Falcon the thread waits as long between two looks",
          "[driver]") {
    UsbBench bus;
    Alone alone;
    REQUIRE(eventually([&] { return holds(alone.driver.status().sentence, "no Falcon"); }));
    alone.driver.use_firmware(any_firmware());
    const std::uint64_t before = dibhr::test::waits_so_far_of("dibhr falcon");
    dibhr::test::let_pass(milliseconds(2250));
    CHECK(dibhr::test::waits_so_far_of("dibhr falcon") - before >= 4);  // of 0.5 s each
    bus.plug();
    CHECK(alone.comes_to(Stage::homing));
}

TEST_CASE("an image that is no firmware is never sent, and the reason is told", "[driver]") {
    struct Bad {
        std::size_t number;
        const char* reason;
    };
    const auto bad = GENERATE(Bad{0, "it ends inside block 1"}, Bad{1, "AA 08"}, Bad{2, "block"},
                              Bad{3, "it is text"});
    UsbBench bus;
    Unit& unit = bus.plug();
    Alone alone({}, bad_firmware().at(bad.number));
    REQUIRE(eventually([&] { return alone.driver.status().trouble; }));
    const Status status = alone.driver.status();
    CAPTURE(status.sentence);
    CHECK(status.stage == Stage::looking);
    CHECK(holds(status.sentence, bad.reason));
    CHECK(holds(status.sentence, "no firmware was sent to the Falcon SIM00001"));
    CHECK_FALSE(holds(status.sentence, "\n"));
    CHECK(traffic_of(unit).bytes_out > 0);  // it was asked
    CHECK(traffic_of(unit).slow_bytes == 0);
    CHECK_FALSE(unit.with([](FalconModel& model) { return model.chip().dtr(); }));
    alone.driver.use_firmware(any_firmware());
    CHECK(alone.comes_to(Stage::homing));
    CHECK(traffic_of(unit).slow_bytes > any_firmware().bytes.size());
}

TEST_CASE("a Falcon without its power adapter is found out, and loaded once it has power",
          "[driver]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    unit.with([](FalconModel& model) { model.board().set_powered(false); });
    Alone alone({}, any_firmware());
    REQUIRE(eventually([&] { return alone.driver.status().trouble; }));
    CHECK(holds(alone.driver.status().sentence, "adapter"));
    unit.with([](FalconModel& model) { model.board().set_powered(true); });
    CHECK(alone.comes_to(Stage::homing));
    CHECK_FALSE(alone.driver.status().trouble);
}

TEST_CASE("pulled out in mid-touch it is missed with a sentence, and taken back at its new address",
          "[driver]") {
    UsbBench bus;
    Unit& unit = plug_homed(bus, "SIM00001");
    TickingFalcon loop(ConnectionOptions{}, any_firmware());
    loop.force_newton = {0.0, 0.0, 1.0};
    REQUIRE(loop.tick_until([&] { return !is_limp(unit); }));
    const bool udev_knows = GENERATE(false, true);
    CAPTURE(udev_knows);
    UsbBench::pull_cable(unit);
    if (udev_knows) bus.unplug(unit);
    REQUIRE(loop.tick_until([&] { return !loop.reading.ready; }));
    REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::looking; }));
    const Status status = loop.device.status();
    CAPTURE(status.sentence);
    CHECK(holds(status.sentence, "SIM00001 was unplugged"));
    CHECK(status.trouble);
    loop.tick_for(milliseconds(700));  // it has looked again meanwhile
    const std::string later = loop.device.status().sentence;
    CAPTURE(later);
    CHECK(holds(later, "SIM00001 was unplugged"));
    CHECK_FALSE(loop.device.can_touch());

    if (!udev_knows) bus.unplug(unit);
    CHECK(loop.tick_until([&] { return loop.device.status().serial.empty(); }));
    const bool power_too = GENERATE(false, true);
    if (power_too) unit.with([](FalconModel& model) { model.power_cycle(); });
    const auto forces = log_of(unit).with_force;
    bus.plug(unit);
    if (power_too) {
        REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::homing; }));
        loop.tick_for(milliseconds(50));
        CHECK(log_of(unit).with_force <= forces);
        home(unit);
    }
    CHECK(loop.tick_until_ready());
    CHECK(loop.tick_until([&] { return !is_limp(unit); }));
    CHECK(log_of(unit).force_before_homing == 0);
}

TEST_CASE("the driver leaves within a quarter of a second, whatever it is doing", "[driver]") {
    UsbBench bus;
    auto alone = std::make_unique<Alone>(ConnectionOptions{}, any_firmware());
    SECTION("looking") {
        CHECK(alone->comes_to(Stage::looking));
    }
    SECTION("loading") {
        bus.plug().set_faults({.ignored_hellos = kForEver});
        CHECK(alone->comes_to(Stage::loading));
    }
    SECTION("ready") {
        plug_homed(bus, "SIM00001");
        CHECK(alone->comes_to(Stage::ready));
    }
    const auto begin = std::chrono::steady_clock::now();
    alone.reset();
    CHECK(std::chrono::steady_clock::now() - begin < milliseconds(250));
}
