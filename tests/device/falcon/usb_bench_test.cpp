// The simulated bus behaves to plain libusb as a kernel's does: but for [mock], the same tests run
// on a real one (kernel-check).
#include "tests/device/falcon/usb_bench.hpp"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "tests/device/falcon/usb_client.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using dibhr::test::let_pass;

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kLatencyTimer = 9;
constexpr std::uint8_t kBaud = 3;

const Bytes kZeroCommand{'<', 'A', 'A', 'A', 'A', 'A', 'A', 'A',
                         'A', 'A', 'A', 'A', 'A', 'A', 'A', '>'};

/// Reads until there are 16 bytes besides the status bytes.
Bytes read_reply(UsbClient& client) {
    Bytes data;
    for (int i = 0; i < 50 && data.size() < 16; ++i) {
        Bytes packet(64);
        REQUIRE(client.read(packet) == LIBUSB_SUCCESS);
        REQUIRE(packet.size() >= 2);
        data.insert(data.end(), packet.begin() + 2, packet.end());
    }
    return data;
}

void start_firmware(Unit& unit, UsbClient& client) {
    unit.with([](FalconModel& model) { model.board().start_firmware(); });
    REQUIRE(client.set(kBaud, 0x0002) == 0);
    REQUIRE(client.set(kLatencyTimer, 1) == 0);
}

struct Plugs {
    int arrived{0};
    int left{0};
};

int LIBUSB_CALL count_plug(libusb_context*, libusb_device*, libusb_hotplug_event event,
                           void* plugs) {
    auto& counted = *static_cast<Plugs*>(plugs);
    ++(event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED ? counted.arrived : counted.left);
    return 0;
}

void listen(UsbClient& client, Plugs& plugs) {
    REQUIRE(libusb_hotplug_register_callback(
                client.context(),
                LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT,
                LIBUSB_HOTPLUG_ENUMERATE, 0x0403, 0xCB48, LIBUSB_HOTPLUG_MATCH_ANY, count_plug,
                &plugs, nullptr) == LIBUSB_SUCCESS);
}

}  // namespace

TEST_CASE("an empty bus has no Falcon, and a plugged one says what it is", "[usb_bench]") {
    UsbBench bench;
    UsbClient client;
    CHECK(client.addresses().empty());
    Unit& unit = bench.plug("SIM00042");
    CHECK(client.pump_until([&] { return client.addresses().size() == 1; }));
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    CHECK(client.string(2) == "FALCON HAPTIC");
    CHECK(client.string(3) == "SIM00042");
}

TEST_CASE("two units are told apart by serial number and do not hear each other", "[usb_bench]") {
    UsbBench bench;
    Unit& first = bench.plug("SIM00001");
    Unit& second = bench.plug("SIM00002");
    UsbClient to_first;
    UsbClient to_second;
    CHECK(to_first.addresses().size() == 2);
    REQUIRE(to_first.open_and_claim(first.place()) == LIBUSB_SUCCESS);
    REQUIRE(to_second.open_and_claim(second.place()) == LIBUSB_SUCCESS);
    CHECK(to_first.string(3) == "SIM00001");
    CHECK(to_second.string(3) == "SIM00002");
    start_firmware(second, to_second);
    int moved = 0;
    REQUIRE(to_second.write(kZeroCommand, moved) == LIBUSB_SUCCESS);
    CHECK(read_reply(to_second) == kZeroCommand);  // counters at zero answer with the same letters
    CHECK(first.with([](FalconModel& model) { return model.traffic().bytes_out; }) == 0);
}

TEST_CASE("a node without permission is refused as a kernel refuses it", "[usb_bench][mock]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    unit.set_access({.open_errno = EACCES});
    UsbClient client;
    CHECK(client.open(unit.place()) == LIBUSB_ERROR_ACCESS);
    unit.set_access({});
    CHECK(client.open(unit.place()) == LIBUSB_SUCCESS);
}

TEST_CASE("a kernel driver keeps the interface until it is detached, and gets it back",
          "[usb_bench][mock]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    unit.set_access({.kernel_driver = "ftdi_sio"});
    UsbClient client;
    REQUIRE(client.open(unit.place()) == LIBUSB_SUCCESS);
    CHECK(client.claim() == LIBUSB_ERROR_BUSY);
    CHECK(libusb_kernel_driver_active(client.handle(), 0) == 1);
    client.close();
    REQUIRE(client.open(unit.place(), true) == LIBUSB_SUCCESS);
    CHECK(client.claim() == LIBUSB_SUCCESS);
    client.close();
    CHECK(unit.access().kernel_driver == "ftdi_sio");
    REQUIRE(client.open(unit.place()) == LIBUSB_SUCCESS);
    CHECK(libusb_kernel_driver_active(client.handle(), 0) == 1);
}

TEST_CASE("what another program has claimed stays busy, detaching or not", "[usb_bench][mock]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    UsbClient client;
    unit.set_access({.claimed_elsewhere = true});
    REQUIRE(client.open(unit.place(), GENERATE(false, true)) == LIBUSB_SUCCESS);
    CHECK(client.claim() == LIBUSB_ERROR_BUSY);
}

TEST_CASE("what another handle has claimed stays busy until it is closed", "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    UsbClient client;
    UsbClient other;
    REQUIRE(other.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    REQUIRE(client.open(unit.place(), true) == LIBUSB_SUCCESS);
    CHECK(client.string(3) == unit.serial());  // asking needs no claim
    CHECK(client.claim() == LIBUSB_ERROR_BUSY);
    other.close();
    CHECK(client.claim() == LIBUSB_SUCCESS);
}

TEST_CASE("requests of the chip are answered, and nonsense is stalled", "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    UsbClient client;
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    std::uint8_t latency_ms = 0;
    CHECK(libusb_control_transfer(client.handle(), 0xC0, 10, 0, 0, &latency_ms, 1, 1000) == 1);
    CHECK(latency_ms == 16);
    CHECK(client.set(kLatencyTimer, 0) == LIBUSB_ERROR_PIPE);
    CHECK(client.set(77, 0) == LIBUSB_ERROR_PIPE);
    CHECK(client.set(kBaud, 0x4138) == 0);
    CHECK(unit.with([](FalconModel& model) { return model.chip().baud(); }) == 9600);
}

TEST_CASE("the rates of the README are what its divisors give", "[usb_bench]") {
    CHECK(baud_of(0x4138, 0) == 9600);
    CHECK(baud_of(0x0015, 0) == 142857);
    CHECK(baud_of(0x0015, 1) == 140351);
    CHECK(baud_of(0x0002, 0) == 1500000);
}

TEST_CASE("a stalled endpoint stays halted until it is cleared", "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    unit.set_faults({.stalled_reads = 1});
    UsbClient client;
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    Bytes packet(64);
    CHECK(client.read(packet) == LIBUSB_ERROR_PIPE);
    CHECK(client.read(packet) == LIBUSB_ERROR_PIPE);
    CHECK(libusb_clear_halt(client.handle(), 0x81) == LIBUSB_SUCCESS);
    packet.resize(64);
    CHECK(client.read(packet) == LIBUSB_SUCCESS);
}

TEST_CASE("a waiting read wakes nobody, can be cancelled, and times out", "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    unit.set_faults({.frozen_in = 1});
    UsbClient client;
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    SECTION("it waits, and is cancelled") {
        PendingRead read(client);
        REQUIRE(read.submit() == LIBUSB_SUCCESS);
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
        int turns = 0;
        for (; std::chrono::steady_clock::now() < end; ++turns) {
            timeval half{0, 500'000};
            libusb_handle_events_timeout_completed(client.context(), &half, nullptr);
        }
        CHECK(turns <= 3);
        CHECK_FALSE(read.ended());
        CHECK(read.cancel() == LIBUSB_SUCCESS);
        CHECK(client.pump_until([&] { return read.ended(); }));
        CHECK(read.status() == LIBUSB_TRANSFER_CANCELLED);
    }
    SECTION("its time is over") {
        PendingRead read(client, 40);
        REQUIRE(read.submit() == LIBUSB_SUCCESS);
        CHECK(client.pump_until([&] { return read.ended(); }));
        CHECK(read.status() == LIBUSB_TRANSFER_TIMED_OUT);
    }
}

TEST_CASE("a chip with nothing to say sends its two status bytes at the latency timer",
          "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    UsbClient client;
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    REQUIRE(client.set(kLatencyTimer, 5) == 0);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) {
        Bytes packet(64);
        REQUIRE(client.read(packet) == LIBUSB_SUCCESS);
        CHECK(packet == Bytes{0x01, 0x60});
    }
    CHECK(std::chrono::steady_clock::now() - begin >= std::chrono::milliseconds(45));
}

TEST_CASE("a buffer smaller than the packet overflows", "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    UsbClient client;
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    start_firmware(unit, client);
    int moved = 0;
    REQUIRE(client.write(kZeroCommand, moved) == LIBUSB_SUCCESS);
    Bytes small(8);
    CHECK(client.read(small) == LIBUSB_ERROR_OVERFLOW);
}

TEST_CASE("a read that waits ends when the cable is pulled, before udev has heard of it",
          "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    unit.set_faults({.frozen_in = 1});
    UsbClient client;
    Plugs plugs;
    listen(client, plugs);
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    PendingRead read(client);
    REQUIRE(read.submit() == LIBUSB_SUCCESS);
    std::thread hand([&] {
        let_pass(std::chrono::milliseconds(20));
        UsbBench::pull_cable(unit);
    });
    CHECK(client.pump_until([&] { return read.ended(); }));
    hand.join();
    CHECK(read.status() == LIBUSB_TRANSFER_NO_DEVICE);
    Bytes packet(64);
    CHECK(client.read(packet) == LIBUSB_ERROR_NO_DEVICE);
    CHECK(client.set(kLatencyTimer, 1) == LIBUSB_ERROR_NO_DEVICE);
    bench.unplug(unit);
    CHECK(client.pump_until([&] { return plugs.left == 1; }));
    CHECK(client.addresses().empty());
}

TEST_CASE("a bulk call goes behind what waits on its endpoint, and says when it took too long",
          "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    UsbClient client;
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    start_firmware(unit, client);
    unit.set_faults({.frozen_out = 1});
    Bytes first = kZeroCommand;
    first[1] = 'B';  // one count on the first motor
    PendingTransfer write(client, 0x02, first);
    REQUIRE(write.submit() == LIBUSB_SUCCESS);
    Bytes second = kZeroCommand;
    const auto bulk = [&](unsigned limit_ms) {
        usbdevfs_bulktransfer transfer{0x02, static_cast<unsigned>(second.size()), limit_ms,
                                       second.data()};
        const int result = ioctl(client.descriptor(), USBDEVFS_BULK, &transfer);
        return result < 0 ? -errno : result;
    };
    const auto begin = std::chrono::steady_clock::now();
    CHECK(bulk(30) == -ETIMEDOUT);
    CHECK(std::chrono::steady_clock::now() - begin >= std::chrono::milliseconds(30));
    std::thread hand([&] {
        let_pass(std::chrono::milliseconds(20));
        unit.set_faults({});
    });
    CHECK(bulk(5000) == static_cast<int>(second.size()));
    hand.join();
    CHECK(client.pump_until([&] { return write.ended(); }));
    const CommandLog log = unit.with([](FalconModel& model) { return model.board().log(); });
    CHECK(log.commands == 2);
    CHECK(log.with_force == 1);
    CHECK(log.zeros_in_a_row == 1);
}

TEST_CASE("a claim belongs to the open file: a copied descriptor keeps it when its program closes",
          "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    UsbClient other;
    int copy = -1;
    {
        UsbClient client;
        REQUIRE(client.open(unit.place()) == LIBUSB_SUCCESS);
        copy = dup(client.descriptor());
        unsigned interface = 0;
        REQUIRE(ioctl(copy, USBDEVFS_CLAIMINTERFACE, &interface) == 0);
    }
    REQUIRE(other.open(unit.place()) == LIBUSB_SUCCESS);
    CHECK(other.claim() == LIBUSB_ERROR_BUSY);
    close(copy);
    CHECK(other.claim() == LIBUSB_SUCCESS);
}

TEST_CASE("plugging, pulling and plugging again under a new address are all heard", "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.make("SIM00001");
    UsbClient client;
    Plugs plugs;
    listen(client, plugs);
    bench.plug(unit);
    CHECK(client.pump_until([&] { return plugs.arrived == 1; }));
    const int first = unit.place().address;
    bench.unplug(unit);
    CHECK(client.pump_until([&] { return plugs.left == 1; }));
    bench.plug(unit);
    CHECK(client.pump_until([&] { return plugs.arrived == 2; }));
    CHECK(unit.place().address != first);
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    CHECK(client.string(3) == "SIM00001");
}

TEST_CASE("in real time a frame carries one command, and the event character saves the timer",
          "[usb_bench]") {
    UsbBench bench;
    Unit& unit = bench.plug();
    UsbClient client;
    REQUIRE(client.open_and_claim(unit.place()) == LIBUSB_SUCCESS);
    start_firmware(unit, client);
    REQUIRE(client.set(6, 0x100 | '>') == 0);
    unit.set_realtime(true);
    const auto begin = std::chrono::steady_clock::now();
    constexpr int kTrips = 100;
    for (int i = 0; i < kTrips; ++i) {
        int moved = 0;
        REQUIRE(client.write(kZeroCommand, moved) == LIBUSB_SUCCESS);
        REQUIRE(read_reply(client).size() == kZeroCommand.size());
    }
    CHECK(std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(kTrips - 2));
}
