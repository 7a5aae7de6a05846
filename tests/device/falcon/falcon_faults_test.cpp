// Every fault of the bus, the chip, the board and the file ends in the right stage, a plain
// sentence, and no force.
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/survey.hpp"
#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr::test::falcon;
using dibhr::falcon::ConnectionOptions;
using dibhr::falcon::FirmwareImage;
using dibhr::falcon::Stage;
using dibhr::falcon::Status;
using std::chrono::milliseconds;
using Bytes = std::vector<std::uint8_t>;

/// One line about this Falcon, without texts of libusb.
void check_plain(const std::string& sentence, const std::string& part) {
    CAPTURE(sentence, part);
    CHECK(sentence.find(part) != std::string::npos);
    CHECK(sentence.find("SIM00001") != std::string::npos);
    CHECK(sentence.find('\n') == std::string::npos);
    CHECK(sentence.find("LIBUSB") == std::string::npos);
}

/// A homed Falcon that pushes with a newton in every tick. Its motors hold a command for ever:
/// only a command without force makes them limp.
struct Touching {
    UsbBench bus{};
    Unit& unit{bus.make("SIM00001")};
    TickingFalcon loop;

    explicit Touching(FirmwareImage firmware = {})
        : loop(ConnectionOptions{}, std::move(firmware)) {
        unit.with([](FalconModel& model) {
            model.board().start_firmware();
            model.board().home();
            model.board().hold_commands(Moment{0});
        });
        bus.plug(unit);
        loop.force_newton = {0.0, 0.0, 1.0};
        REQUIRE(loop.tick_until([&] { return loop.reading.ready && !is_limp(unit); }));
    }
    bool goes_on() {
        const auto replies = loop.device.status().replies;
        return loop.tick_until([&] {
            return loop.device.status().replies > replies + 50 && loop.reading.ready &&
                   !is_limp(unit);
        });
    }
    /// With a tick that begins after it: the last reading knows of it, too.
    bool comes_to_trouble() {
        const bool came = loop.tick_until([&] { return loop.device.status().trouble; });
        loop.tick();
        return came;
    }
};

/// A bare Falcon, its firmware at hand.
struct Loading {
    UsbBench bus{};
    Unit& unit{bus.make("SIM00001")};
    TickingFalcon loop;

    explicit Loading(const Faults& faults, FirmwareImage firmware = any_firmware())
        : loop(ConnectionOptions{}, std::move(firmware)) {
        unit.set_faults(faults);
        bus.plug(unit);
        loop.force_newton = {0.0, 0.0, 1.0};
    }
    bool comes_to(Stage stage) {
        return loop.tick_until([&] { return loop.device.status().stage == stage; });
    }
};

}  // namespace

TEST_CASE("replies that are cut, joined, garbled or lost do not end the touch", "[faults]") {
    struct Case {
        const char* name;
        Faults faults;
    };
    const auto now = GENERATE(Case{"split in the middle", {.split_to = 7}},
                              Case{"split into single bytes", {.split_to = 5}},
                              Case{"two in a packet", {.merged_replies = 20}},
                              Case{"garbage before every one", {.garbage_before = kForEver}},
                              Case{"garbage inside", {.garbage_inside = 20}},
                              Case{"lost", {.dropped_replies = 20}},
                              Case{"overrun and framing", {.lost_to_overrun = 20}},
                              Case{"all together",
                                   {.dropped_replies = 5,
                                    .lost_to_overrun = 5,
                                    .garbage_before = 20,
                                    .garbage_inside = 5,
                                    .merged_replies = 5,
                                    .split_to = 9}});
    CAPTURE(now.name);
    Touching touching;
    touching.unit.set_faults(now.faults);
    CHECK(touching.goes_on());
    const Status status = touching.loop.device.status();
    CHECK(status.stage == Stage::ready);
    CHECK_FALSE(status.trouble);
    CHECK((status.line_errors > 0) == (now.faults.lost_to_overrun > 0));
    CHECK(log_of(touching.unit).broken == 0);
}

TEST_CASE("a reply that is lost for long takes the force off until replies come again",
          "[faults]") {
    Touching touching;
    touching.unit.set_faults({.dropped_replies = 40});  // asked again every 5 to 10 ms
    CHECK(touching.loop.tick_until([&] { return !touching.loop.reading.ready; }));
    CHECK(touching.loop.tick_until([&] { return is_limp(touching.unit); }));
    CHECK(touching.goes_on());
    CHECK(touching.loop.device.status().stage == Stage::ready);
}

TEST_CASE(
    "a bus or a board that fails in mid-touch takes the force off, says so, and is taken back",
    "[faults]") {
    struct Case {
        Faults faults;
        const char* sentence;
    };
    const auto now = GENERATE(Case{{.stalled_reads = kForEver}, "stall"},
                              Case{{.frozen_in = 1}, "not answered for a second"},
                              Case{{.dropped_replies = kForEver}, "not answered for a second"});
    CAPTURE(now.sentence);
    Touching touching;
    touching.unit.set_faults(now.faults);
    REQUIRE(touching.comes_to_trouble());
    CHECK(touching.loop.device.status().stage == Stage::looking);
    check_plain(touching.loop.device.status().sentence, now.sentence);
    CHECK_FALSE(touching.loop.reading.ready);
    CHECK(is_limp(touching.unit));
    CHECK(log_of(touching.unit).zeros_in_a_row >= 5);
    const auto forces = log_of(touching.unit).with_force;
    touching.loop.tick_for(milliseconds(300));
    CHECK(log_of(touching.unit).with_force == forces);
    touching.unit.set_faults({});
    CHECK(touching.goes_on());
    CHECK_FALSE(touching.loop.device.status().trouble);
}

TEST_CASE("a bus that takes no commands leaves the motors to the firmware's own pause",
          "[faults]") {
    Touching touching;
    touching.unit.with([](FalconModel& model) { model.board().hold_commands(milliseconds(100)); });
    touching.unit.set_faults({.frozen_out = 1});
    REQUIRE(touching.comes_to_trouble());
    check_plain(touching.loop.device.status().sentence, "the USB took no command for");
    CHECK_FALSE(touching.loop.reading.ready);
    CHECK(is_limp(touching.unit));
    touching.unit.set_faults({});
    CHECK(touching.goes_on());
}

TEST_CASE("unplugged idle or in mid-touch it is missed, and homed again under its new address",
          "[faults]") {
    Touching touching(any_firmware());
    auto& loop = touching.loop;
    const bool idle = GENERATE(true, false);
    CAPTURE(idle);
    if (idle) {
        loop.force_newton = {};
        REQUIRE(loop.tick_until([&] { return is_limp(touching.unit); }));
    }
    const int address = touching.unit.place().address;
    touching.bus.unplug(touching.unit);
    REQUIRE(touching.comes_to_trouble());
    CHECK(loop.device.status().stage == Stage::looking);
    check_plain(loop.device.status().sentence, "was unplugged");
    CHECK_FALSE(loop.reading.ready);

    touching.unit.with([](FalconModel& model) { model.power_cycle(); });
    CHECK(is_limp(touching.unit));
    loop.force_newton = {0.0, 0.0, 1.0};
    touching.bus.plug(touching.unit);
    CHECK(touching.unit.place().address != address);
    REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::homing; }));
    loop.tick_for(milliseconds(100));
    CHECK(is_limp(touching.unit));
    home(touching.unit);
    CHECK(touching.goes_on());
    CHECK(log_of(touching.unit).force_before_homing == 0);
}

TEST_CASE(
    "a hand that pulls the grip out and pushes it in homes the Falcon, and only then is force",
    "[faults]") {
    Loading loading({});
    REQUIRE(loading.comes_to(Stage::homing));
    loading.unit.with([](FalconModel& model) {
        HandModel& hand = model.board().hand();
        hand.move({0.0, 0.0, 0.165}, 0.3);
        hand.move({0.0, 0.0, 0.085}, 0.5);
        hand.move({0.0, 0.0, 0.115}, 0.2);
    });
    CHECK(loading.loop.tick_until([&] { return !is_limp(loading.unit); }));
    CHECK(loading.loop.device.status().stage == Stage::ready);
    CHECK(log_of(loading.unit).force_before_homing == 0);
}

TEST_CASE("an upload that stumbles is tried again until the Falcon answers", "[faults]") {
    Loading loading(GENERATE(Faults{.leading_zero = kForEver, .leading_13 = kForEver},
                             Faults{.ignored_hellos = 5},
                             Faults{.corrupt_echo = 2, .echo_fault_at = 700},
                             Faults{.stop_echo = 1, .echo_fault_at = 700}));
    REQUIRE(loading.comes_to(Stage::homing));
    CHECK_FALSE(loading.loop.device.status().trouble);
    CHECK(log_of(loading.unit).with_force == 0);
}

TEST_CASE("an upload that cannot succeed is given up with the step that failed, and no force",
          "[faults]") {
    struct Case {
        Faults faults;
        const char* sentence;
    };
    const auto now =
        GENERATE(Case{{.ignored_hellos = kForEver}, "no hello"},
                 Case{{.ignored_autobaud = kForEver}, "autobaud"},
                 Case{{.corrupt_echo = kForEver, .echo_fault_at = 700}, "echo differs at byte 700"},
                 Case{{.stop_echo = kForEver, .echo_fault_at = 700}, "echo stopped at byte 700"},
                 Case{{.dropped_replies = kForEver}, "does not answer"});
    CAPTURE(now.sentence);
    Loading loading(now.faults);
    auto& loop = loading.loop;
    REQUIRE(loop.tick_until([&] { return loop.device.status().trouble; }));
    check_plain(loop.device.status().sentence, now.sentence);
    CHECK(loop.device.status().stage == Stage::looking);
    CHECK_FALSE(loop.reading.ready);
    CHECK(log_of(loading.unit).with_force == 0);
}

TEST_CASE("unplugged while the firmware goes in it is missed, and loaded anew when it is back",
          "[faults]") {
    FirmwareImage large = any_firmware();
    large.bytes = dibhr::test::synthetic_firmware(10'000);  // 1.4 s on the line
    Loading loading({}, large);
    loading.unit.set_realtime(true);
    auto& loop = loading.loop;
    REQUIRE(loop.tick_until([&] {
        const Status status = loop.device.status();
        return status.stage == Stage::loading && status.loaded > 0.1;
    }));
    loading.bus.unplug(loading.unit);
    REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::looking; }));
    check_plain(loop.device.status().sentence, "was unplugged");
    CHECK(loop.device.status().trouble);
    const auto loaded = [&] {
        return loading.unit.with([](FalconModel& model) { return model.board().bytes_loaded(); });
    };
    CHECK(loaded() < large.bytes.size());

    loading.unit.set_realtime(false);
    loading.bus.plug(loading.unit);
    REQUIRE(loading.comes_to(Stage::homing));
    CHECK(loaded() == large.bytes.size());
    CHECK_FALSE(loop.device.status().trouble);
    CHECK(log_of(loading.unit).with_force == 0);
}

TEST_CASE("a chip that takes no request is told, and taken once it does", "[faults]") {
    Loading loading({.frozen_control = 1});
    auto& loop = loading.loop;
    REQUIRE(loop.tick_until([&] { return loop.device.status().trouble; }));
    CHECK(loop.device.status().stage == Stage::looking);
    check_plain(loop.device.status().sentence, "for a second");
    CHECK_FALSE(loop.reading.ready);
    CHECK(traffic_of(loading.unit).bytes_out == 0);
    loading.unit.set_faults({});
    CHECK(loading.comes_to(Stage::homing));
    CHECK_FALSE(loop.device.status().trouble);
}

TEST_CASE("a Falcon that is refused, or held by others, is left alone and taken when it is free",
          "[faults]") {
    struct Case {
        UsbAccess access;
        const char* sentence;
    };
    const auto now = GENERATE(Case{{.open_errno = EACCES}, "permission"},
                              Case{{.claimed_elsewhere = true}, "another program"});
    UsbBench bus;
    Unit& unit = bus.make("SIM00001");
    unit.set_access(now.access);
    start_firmware(unit);
    home(unit);
    bus.plug(unit);
    TickingFalcon loop{ConnectionOptions{}};
    loop.force_newton = {0.0, 0.0, 1.0};
    REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::cannot_open; }));
    check_plain(loop.device.status().sentence, now.sentence);
    CHECK_FALSE(loop.reading.ready);
    CHECK(unit.with([](FalconModel& model) { return model.traffic().bytes_out; }) == 0);
    unit.set_access({});
    CHECK(loop.tick_until([&] { return !is_limp(unit); }));
    CHECK(loop.device.status().stage == Stage::ready);
}

TEST_CASE("a Falcon that the kernel's serial driver holds is taken from it, and given back",
          "[faults]") {
    UsbBench bus;
    Unit& unit = bus.make("SIM00001");
    unit.set_access({.kernel_driver = "ftdi_sio"});
    start_firmware(unit);
    home(unit);
    bus.plug(unit);
    {
        TickingFalcon loop{ConnectionOptions{}};
        loop.force_newton = {0.0, 0.0, 1.0};
        CHECK(loop.tick_until([&] { return !is_limp(unit); }));
        CHECK(unit.access().kernel_driver.empty());
    }
    CHECK(unit.access().kernel_driver == "ftdi_sio");
    CHECK(is_limp(unit));
}

TEST_CASE("a corrupt, cut or foreign firmware file is refused before a byte is sent", "[faults]") {
    const auto spoil = GENERATE(values<void (*)(Bytes&)>({
        [](Bytes& bytes) { bytes[0] = 0x55; },                     // another key
        [](Bytes& bytes) { bytes.resize(bytes.size() * 2 / 3); },  // cut
        [](Bytes& bytes) {
            bytes.insert(bytes.end(), {0, 0});
        },                                                   // more after its end
        [](Bytes& bytes) { bytes[22] = bytes[23] = 0xFF; },  // a block's length
        [](Bytes& bytes) { bytes[18] = 0xFF; },              // an entry point out of reach
        [](Bytes& bytes) {
            bytes.assign({'#', '!', '/', 'b', 'i', 'n'});
        },  // a script
        [](Bytes& bytes) { bytes.clear(); },
    }));
    UsbBench bus;
    Unit& unit = bus.plug("SIM00001");
    Bytes bytes = dibhr::test::synthetic_firmware();
    spoil(bytes);
    const dibhr::test::TemporaryFolder folder;
    const auto file = folder / "spoilt.bin";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    std::string reason;
    try {
        const auto image = dibhr::falcon::read_firmware(file);
        (void)dibhr::falcon::survey_falcons({}, image);
    } catch (const dibhr::InputError& refusal) {
        reason = refusal.what();
    }
    CAPTURE(reason);
    CHECK(reason.find(file.filename().string()) != std::string::npos);
    CHECK(reason.find('\n') == std::string::npos);
    CHECK(unit.with([](FalconModel& model) { return model.traffic().bytes_out; }) == 0);
}
