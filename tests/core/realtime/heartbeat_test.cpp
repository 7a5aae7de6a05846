// A monitor of a heartbeat detects when its thread stands still, and only then. The time is the
// test's own; the state of threads is the kernel's.
#include "core/realtime/heartbeat.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include "tests/core/realtime/blocked_thread.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using namespace std::chrono_literals;
using Clock = Heartbeat::Clock;

namespace {

constexpr Clock::time_point kBeat{5h};

}  // namespace

TEST_CASE("a heart is silent for as long as its last beat is past", "[heartbeat]") {
    Heartbeat heart;
    HeartbeatMonitor listener(&heart);
    heart.beat(kBeat);
    CHECK(listener.silence(kBeat) == 0s);
    CHECK(listener.silence(kBeat + 300ms) == 300ms);
    CHECK(listener.silence(kBeat - 1s) == 0s);  // a tick that began before the beat
    heart.beat(kBeat + 400ms);
    CHECK(listener.silence(kBeat + 450ms) == 50ms);
    const Clock::time_point before = Clock::now();
    heart.beat();  // now
    CHECK(listener.silence(before) == 0s);
    CHECK(listener.silence(Clock::now() + 300ms) >= 300ms);
}

TEST_CASE("a heart that rests, has not begun or is none is never silent", "[heartbeat]") {
    Heartbeat heart;
    HeartbeatMonitor listener(&heart);
    CHECK(listener.silence(kBeat + 1h) == 0s);
    heart.beat(kBeat);
    heart.set_idle();
    CHECK(listener.silence(kBeat + 1h) == 0s);
    CHECK(HeartbeatMonitor(nullptr).silence(kBeat + 1h) == 0s);
}

namespace {

/// A pipe into which nothing is written: a reader waits until it is closed.
class EndlessPipe {
  public:
    EndlessPipe() { REQUIRE(::pipe(ends_.data()) == 0); }
    ~EndlessPipe() {
        close_end();
        ::close(ends_[0]);
    }
    EndlessPipe(const EndlessPipe&) = delete;
    EndlessPipe& operator=(const EndlessPipe&) = delete;

    void wait() const {
        char byte{};
        [[maybe_unused]] const auto got = ::read(ends_[0], &byte, 1);
    }
    void close_end() {
        if (ends_[1] >= 0) ::close(std::exchange(ends_[1], -1));
    }

  private:
    std::array<int, 2> ends_{};
};

enum class AlsoComputes { no, yes };

/// A thread that beats once and then does its work.
class BeatingThread {
  public:
    BeatingThread(AlsoComputes also, std::function<void()> work)
        : thread_([this, also, work = std::move(work)] {
              if (also == AlsoComputes::yes) heart_.count_computing_as_beat();
              heart_.beat(kBeat);
              id_ = static_cast<pid_t>(::syscall(SYS_gettid));
              work();
          }) {
        while (id_ == 0) std::this_thread::yield();
    }
    ~BeatingThread() { thread_.join(); }
    BeatingThread(const BeatingThread&) = delete;
    BeatingThread& operator=(const BeatingThread&) = delete;

    [[nodiscard]] pid_t id() const { return id_; }
    /// The silence found by a check once a millisecond, for that time after the beat.
    [[nodiscard]] Clock::duration longest_silence(std::chrono::milliseconds until) const {
        HeartbeatMonitor listener(&heart_);
        Clock::duration longest{};
        for (auto at = 0ms; at <= until; at += 1ms)
            longest = std::max(longest, listener.silence(kBeat + at));
        return longest;
    }

  private:
    Heartbeat heart_{};
    std::atomic<pid_t> id_{0};
    std::thread thread_;
};

}  // namespace

TEST_CASE("a thread that decodes for long is heard while it computes, but not while it waits",
          "[heartbeat]") {
    SECTION("it computes") {
        std::atomic<bool> enough{false};
        const auto compute = [&enough] {
            volatile unsigned sum = 0;
            while (!enough) sum = sum + 1;
        };
        const BeatingThread decoder(AlsoComputes::yes, compute);
        const BeatingThread window(AlsoComputes::no, compute);  // as one that loops for ever
        CHECK(decoder.longest_silence(1200ms) <= 100ms);
        CHECK(window.longest_silence(1200ms) == 1200ms);
        enough = true;
    }
    SECTION("it waits for a disk") {
        EndlessPipe disk;
        const BeatingThread decoder(AlsoComputes::yes, [&disk] { disk.wait(); });
        CHECK(comes_to_wait_in(SYS_read, decoder.id()));
        CHECK(decoder.longest_silence(1200ms) == 1200ms);
        disk.close_end();
    }
}

TEST_CASE("a thread that waits for another one is heard, but not for ever", "[heartbeat]") {
    EndlessPipe disk;
    std::atomic<pid_t> other_id{0};
    const BeatingThread waiting(AlsoComputes::yes, [&] {
        std::thread other([&] {
            other_id = static_cast<pid_t>(::syscall(SYS_gettid));
            disk.wait();
        });
        other.join();
    });
    while (other_id == 0) std::this_thread::yield();
    // To start a thread is a wait, too, under the thread sanitizer: that is over then.
    CHECK(comes_to_wait_in(SYS_read, other_id));
    CHECK(comes_to_wait_in(SYS_futex, waiting.id()));
    CHECK(waiting.longest_silence(1999ms) <= 100ms);
    CHECK(waiting.longest_silence(3s) > 1s);
    disk.close_end();
}
