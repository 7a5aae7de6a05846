// The haptic loop with a simulated Falcon: every round trip, no allocation, no needless wake.
// Allocations are counted by replacing operator new for this program.
#include <pthread.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>

#include "device/falcon/falcon_device.hpp"
#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/device/falcon/usbfs.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

thread_local int no_alloc_depth = 0;
thread_local int alloc_in_tick = 0;
std::atomic<bool> no_memory_for_usb_thread{false};  // once

/// Now, if this is the USB thread.
bool memory_is_out() {
    if (!no_memory_for_usb_thread.load(std::memory_order_relaxed)) return false;
    if (dibhr::test::falcon::in_simulated_kernel()) return false;
    std::array<char, 16> name{};  // as long as Linux has them
    pthread_getname_np(pthread_self(), name.data(), name.size());
    return std::string_view(name.data()) == "dibhr falcon" &&
           no_memory_for_usb_thread.exchange(false);
}

}  // namespace

void* operator new(std::size_t size) {
    if (no_alloc_depth > 0) ++alloc_in_tick;
    if (memory_is_out()) throw std::bad_alloc{};
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc{};
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    if (no_alloc_depth > 0) ++alloc_in_tick;
    return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace {

using namespace dibhr::test::falcon;
using namespace dibhr::falcon;
using dibhr::test::let_pass;
using dibhr::test::waits_so_far_of;
using std::chrono::milliseconds;

/// How often the USB thread wakes in a second.
std::uint64_t wakes_in_a_second() {
    const std::uint64_t before = waits_so_far_of("dibhr falcon");
    REQUIRE(before > 0);
    let_pass(std::chrono::seconds(1));
    return waits_so_far_of("dibhr falcon") - before;
}

/// From a bare unit to homed and on, for so many ticks that come as fast as replies do.
void check_trips(std::uint64_t trips) {
    UsbBench bus;
    Unit& unit = bus.plug();
    TickingFalcon loop(ConnectionOptions{}, any_firmware());
    REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::homing; }));
    home(unit);
    REQUIRE(loop.tick_until_ready());

    loop.force_newton = {0.0, 0.0, 0.2};
    const auto commands_before = log_of(unit).commands;
    const auto first = loop.device.reply_number();
    std::uint64_t ticks_without_reply = 0;
    bool can_touch = true;
    for (std::uint64_t tick = 0; tick < trips; ++tick) {
        const auto last = loop.device.reply_number();
        ++no_alloc_depth;
        loop.tick();
        --no_alloc_depth;
        let_pass(std::chrono::microseconds(50));  // until the USB thread waits again
        can_touch = can_touch && loop.device.can_touch();
        ticks_without_reply += tick > 0 && loop.device.reply_number() == last ? 1 : 0;
    }
    CHECK(ticks_without_reply == 0);
    CHECK(loop.device.reply_number() + 2 >= first + trips);
    CHECK(log_of(unit).commands - commands_before <= trips + 1);
    CHECK(loop.device.status().resent == 0);
    CHECK(can_touch);
    CHECK(alloc_in_tick == 0);
    CHECK(log_of(unit).force_before_homing == 0);
    alloc_in_tick = 0;
}

}  // namespace

TEST_CASE("the counter counts an allocation", "[allocation]") {
    ++no_alloc_depth;
    int* volatile kept = new int(3);  // volatile: or the pair is optimised away
    delete kept;
    --no_alloc_depth;
    CHECK(alloc_in_tick == 1);
    alloc_in_tick = 0;
}

TEST_CASE("from a bare unit to homed and on: every command has its reply, in every tick its own",
          "[trips]") {
    check_trips(5'000);
}

TEST_CASE("very many commands have a reply each, and none of as many ticks allocates",
          "[trips][long]") {
    check_trips(DIBHR_SANITIZED ? 20'000 : 200'000);
}

TEST_CASE("at 1 kHz and with frames of 1 ms a tick has one reply", "[pace]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    unit.with([](FalconModel& model) {
        model.board().start_firmware();
        model.board().home();
    });
    unit.set_realtime(true);
    TickingFalcon loop(ConnectionOptions{});
    REQUIRE(loop.tick_until_ready());
    loop.tick_times(10);
    constexpr int kTicks = 500;
    const auto first = loop.device.reply_number();
    loop.tick_times(kTicks);
    const auto replies = loop.device.reply_number() - first;
    CHECK(replies >= kTicks - 1);
    CHECK(replies <= kTicks + 1);
}

TEST_CASE("a USB thread without memory leaves the Falcon without force, says so, and begins again",
          "[memory]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    unit.with([](FalconModel& model) {
        model.board().start_firmware();
        model.board().home();
        model.board().hold_commands(Moment(0));
    });
    TickingFalcon loop(ConnectionOptions{});
    loop.force_newton = {0.0, 0.0, 1.0};
    REQUIRE(loop.tick_until([&] { return !is_limp(unit); }));
    const auto flushes = [&] {
        return unit.with([](FalconModel& model) { return model.chip().flushes(); });
    };
    CHECK(flushes());
    // The sentence about the lost homing is what there is no memory for.
    no_memory_for_usb_thread = true;
    start_firmware(unit);
    REQUIRE(loop.tick_until([&] { return loop.device.status().trouble; }));
    const Status status = loop.device.status();
    CAPTURE(status.sentence);
    CHECK(status.stage == Stage::looking);
    CHECK(status.sentence.find("begins again") != std::string::npos);
    CHECK_FALSE(flushes());  // the last that is asked for, after the packets without force
    CHECK(log_of(unit).zeros_in_a_row >= 5);
    loop.tick();
    CHECK_FALSE(loop.reading.ready);
    home(unit);
    CHECK(loop.tick_until([&] { return !is_limp(unit); }));
}

// Who looked for something instead of waiting would keep the clock from passing: then this would
// not end.
TEST_CASE("waiting wakes the USB thread no oftener than it has to look", "[load]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    SECTION("for a unit to be plugged in: twice a second") {
        bus.unplug(unit);
        const TickingFalcon loop(ConnectionOptions{});
        let_pass(milliseconds(50));
        CHECK(wakes_in_a_second() <= 10);
    }
    SECTION("for a haptic loop that pauses: the chip is asked for fewer empty packets") {
        start_firmware(unit);
        unit.set_realtime(true);
        TickingFalcon loop(ConnectionOptions{});
        REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::homing; }));
        const auto empty_packets = [&] {
            return unit.with([](FalconModel& model) { return model.traffic().empty_packets_in; });
        };
        let_pass(milliseconds(300));  // until the pause is noticed
        const auto before = empty_packets();
        CHECK(wakes_in_a_second() < 450);      // of 6 and of 12 ms, where 1 ms would be 1000
        CHECK(empty_packets() > before + 80);  // it is not left to fall asleep
        loop.tick();
        REQUIRE(loop.tick_until([&] {
            return unit.with([](FalconModel& model) { return model.chip().latency_ms() == 1; });
        }));
    }
    SECTION("for a unit that takes no more, until it is given up") {
        start_firmware(unit);
        TickingFalcon loop(ConnectionOptions{});
        REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::homing; }));
        unit.set_faults({.frozen_in = 1, .frozen_out = 1});
        const std::uint64_t before = waits_so_far_of("dibhr falcon");
        let_pass(milliseconds(900));
        CHECK(waits_so_far_of("dibhr falcon") - before < 100);  // every 12 ms
        CHECK(loop.device.status().stage == Stage::homing);
    }
}
