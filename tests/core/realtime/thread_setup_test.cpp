// The requests of a 1 kHz thread to the system: granted and in effect, or refused with a reason.
#include "core/realtime/tick_timer.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <array>
#include <string>
#include <thread>

#include "tests/support/catch.hpp"

namespace {

/// The system's state of a thread after become_realtime(), read inside that thread.
struct Seen {
    dibhr::RealtimeGrants grants{};
    std::string name{};
    int policy{-1};
    int policy_of_child{-1};
    int timer_slack_ns{-1};
};

Seen seen_from_a_thread(const char* name) {
    Seen seen;
    std::thread([&] {
        seen.grants = dibhr::become_realtime(name);
        std::array<char, 16> kernel_name{};
        pthread_getname_np(pthread_self(), kernel_name.data(), kernel_name.size());
        seen.name = kernel_name.data();
        seen.policy = sched_getscheduler(0);
        seen.timer_slack_ns = prctl(PR_GET_TIMERSLACK);
        std::thread([&] { seen.policy_of_child = sched_getscheduler(0); }).join();
    }).join();
    munlockall();
    return seen;
}

}  // namespace

TEST_CASE("the priority that is reported is the one in force", "[threads]") {
    const Seen seen = seen_from_a_thread("haptic");
    CAPTURE(seen.grants.priority->get().answer);
    CHECK(((seen.policy & ~SCHED_RESET_ON_FORK) == SCHED_FIFO) ==
          seen.grants.priority->get().granted);
    CHECK(seen.grants.priority->get().answer.starts_with(
        seen.grants.priority->get().granted ? "SCHED_FIFO " : "refused: "));
}

TEST_CASE("a memory lock is granted or refused with a reason", "[threads]") {
    const Seen seen = seen_from_a_thread("haptic");
    const auto& lock = seen.grants.memory_lock;
    CAPTURE(lock.answer);
    CHECK((lock.granted ? lock.answer == "locked" : lock.answer.starts_with("refused: ")));
}

TEST_CASE("a thread made by a real-time thread is an ordinary one", "[threads]") {
    CHECK(seen_from_a_thread("haptic").policy_of_child == SCHED_OTHER);
}

TEST_CASE("the thread carries its name, cut to what the kernel keeps", "[threads]") {
    CHECK(seen_from_a_thread("haptic").name == "haptic");
    CHECK(seen_from_a_thread("a name of more than fifteen").name == "a name of more ");
}

TEST_CASE("a thread that asked sleeps without slack", "[threads]") {
    // Real-time threads have none at all; the kernel then reports 0 or the requested 1 ns.
    CHECK(seen_from_a_thread("haptic").timer_slack_ns <= 1);
}
