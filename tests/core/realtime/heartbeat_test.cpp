// Who listens to a heartbeat hears when its thread stands still, and only then.
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include "core/realtime/heartbeat.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace std::chrono_literals;
using Clock = Heartbeat::Clock;

TEST_CASE("a heart is silent for as long as its last beat is past", "[heartbeat]") {
    Heartbeat heart;
    HeartbeatListener listener(&heart);
    const Clock::time_point before = Clock::now();
    heart.beat();
    const Clock::time_point after = Clock::now();
    CHECK(listener.silence(before + 300ms) <= 300ms);
    CHECK(listener.silence(after + 300ms) >= 300ms);
    CHECK(listener.silence(before - 1s) == 0s);  // a tick that began before the beat
    heart.beat();
    CHECK(listener.silence(Clock::now()) < 300ms);
}

TEST_CASE("a heart that rests, has not begun or is none is never silent", "[heartbeat]") {
    Heartbeat heart;
    HeartbeatListener listener(&heart);
    CHECK(listener.silence(Clock::now() + 1h) == 0s);
    heart.beat();
    heart.rest();
    CHECK(listener.silence(Clock::now() + 1h) == 0s);
    CHECK(HeartbeatListener(nullptr).silence(Clock::now() + 1h) == 0s);
}

namespace {

/// The longest silence of a thread that beats once and then does `work`, in that time.
template <typename Work>
Clock::duration longest_silence(bool also_computes, const Work& work,
                                std::chrono::milliseconds time = 1s) {
    Heartbeat heart;
    std::atomic<bool> begun{false};
    std::thread thread([&] {
        if (also_computes) heart.also_computes();
        heart.beat();
        begun = true;
        work();
        heart.rest();
    });
    while (!begun) std::this_thread::yield();
    HeartbeatListener listener(&heart);
    Clock::duration longest{};
    for (const auto end = Clock::now() + time; Clock::now() < end;) {
        longest = std::max(longest, listener.silence(Clock::now()));
        std::this_thread::sleep_for(1ms);
    }
    thread.join();
    return longest;
}

}  // namespace

TEST_CASE("a thread that decodes for long is heard while it computes, but not while it waits",
          "[heartbeat]") {
    const auto compute = [] {
        volatile unsigned sum = 0;
        for (const auto end = Clock::now() + 1200ms; Clock::now() < end;) sum = sum + 1;
    };
    const auto wait_for_a_disk = [] {
        // Catch2's assertions are for one thread: what fails here is heard as no silence below.
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) return;
        std::thread disk([&] {
            std::this_thread::sleep_for(1200ms);
            [[maybe_unused]] const auto written = write(ends[1], "x", 1);
        });
        char byte{};
        [[maybe_unused]] const auto got = read(ends[0], &byte, 1);
        disk.join();
        close(ends[0]);
        close(ends[1]);
    };
    CHECK(longest_silence(true, compute) < 200ms);
    CHECK(longest_silence(true, wait_for_a_disk) > 900ms);
    CHECK(longest_silence(false, compute) > 900ms);  // as a window that loops for ever
}

TEST_CASE("a thread that waits for another one is heard, but not for ever", "[heartbeat]") {
    const auto wait_for_a_thread = [] {
        std::thread other([] { std::this_thread::sleep_for(3200ms); });
        other.join();
    };
    CHECK(longest_silence(true, wait_for_a_thread) < 200ms);
    CHECK(longest_silence(true, wait_for_a_thread, 3s) > 600ms);
}
