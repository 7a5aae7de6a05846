// The run-time exchange over the real libusb: one command, one reply, and what ends it.
#include "device/falcon/link.hpp"

#include <sys/resource.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "device/falcon/bring_up.hpp"
#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using dibhr::falcon::Command;
using dibhr::falcon::Link;
using dibhr::test::let_pass;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// A link to a unit whose firmware runs.
struct Linked {
    UsbBench bus{};
    Unit& unit{bus.plug()};
    dibhr::falcon::UsbContext usb{};
    dibhr::falcon::FtdiPort port{usb, attached_falcons(usb).at(0)};
    dibhr::Wake wake{};
    std::optional<Link> link{};
    std::uint64_t replies{0};

    Linked() {
        start_firmware(unit);
        REQUIRE(answers(port, std::stop_token()));
        link.emplace(usb, port, wake);
    }
    /// Sends whenever a command may go.
    void exchange(milliseconds span) {
        const auto end = Clock::now() + span;
        while (Clock::now() < end && !link->loss()) {
            const auto now = Clock::now();
            if (link->can_send(now)) link->send(encode(Command{}), now);
            link->wait(link->idle() ? end : link->retry_at());
            replies += link->replies().size();
        }
    }
    void exchange_until(std::uint64_t wanted) {
        for (int k = 0; k < 500 && replies < wanted && !link->loss(); ++k) {
            exchange(milliseconds(1));
        }
        CHECK(replies >= wanted);
    }
    std::string loss() { return link->loss() ? link->loss()->what() : ""; }
};

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("every command gets one reply, and the next one waits for it", "[link]") {
    Linked linked;
    linked.exchange_until(1000);
    const auto commands = log_of(linked.unit).commands;
    CHECK(commands <= linked.replies + 2);  // the probe's, and one on its way
    CHECK(linked.link->counts().resent == 0);
    CHECK(linked.link->counts().bytes_discarded == 0);
}

TEST_CASE("replies that are split, joined, garbled, lost or spoilt do not end the link", "[link]") {
    struct Spoilt {
        Faults faults;
        bool resent;
        bool discarded;
        bool line_errors;
    };
    const auto spoilt = GENERATE(Spoilt{{.split_to = 7}, false, false, false},
                                 Spoilt{{.merged_replies = 5}, true, false, false},
                                 Spoilt{{.garbage_before = 5}, false, true, false},
                                 Spoilt{{.garbage_inside = 5}, true, true, false},
                                 Spoilt{{.dropped_replies = 5}, true, false, false},
                                 Spoilt{{.lost_to_overrun = 5}, true, false, true},
                                 Spoilt{{.lost_halves = 5}, true, true, true});
    Linked linked;
    linked.unit.set_faults(spoilt.faults);
    linked.exchange_until(50);
    CAPTURE(linked.loss());
    CHECK_FALSE(linked.link->loss());
    const auto counts = linked.link->counts();
    CHECK((counts.resent > 0) == spoilt.resent);
    CHECK((counts.bytes_discarded > 0) == spoilt.discarded);
    CHECK((counts.line_errors > 0) == spoilt.line_errors);
}

TEST_CASE("a unit that says nothing more is asked again, and given up after a second", "[link]") {
    Linked linked;
    linked.exchange_until(10);
    const auto begin = Clock::now();  // before the last answer
    linked.exchange_until(linked.replies + 1);
    linked.unit.set_faults({.dropped_replies = kForEver});
    linked.exchange(milliseconds(3000));
    CHECK(Clock::now() - begin > milliseconds(1000));
    CHECK(Clock::now() - begin < milliseconds(1010));
    CHECK(holds(linked.loss(), "not answered for a second"));
    CHECK(holds(linked.loss(), "power adapter"));
    CHECK(linked.link->counts().resent >= 123);  // every 8 ms
    CHECK(linked.link->counts().resent <= 125);
}

TEST_CASE("a stall, a pulled cable and a wire that takes nothing end the link with their reason",
          "[link]") {
    Linked linked;
    linked.exchange_until(10);
    SECTION("stall") {
        linked.unit.set_faults({.stalled_reads = 1});
        linked.exchange(milliseconds(3000));
        CHECK(holds(linked.loss(), "stall"));
    }
    SECTION("cable") {
        UsbBench::pull_cable(linked.unit);
        linked.exchange(milliseconds(3000));
        CHECK(holds(linked.loss(), "unplugged"));
        CHECK(linked.link->loss()->unplugged());
    }
    SECTION("wire") {
        linked.unit.set_faults({.frozen_out = 1});
        linked.exchange(milliseconds(3000));
        CHECK(holds(linked.loss(), "took no command for"));
        CHECK_FALSE(holds(linked.loss(), "power adapter"));
    }
    CHECK(holds(linked.loss(), "SIM00001"));
    const auto begin = Clock::now();
    linked.link.reset();
    CHECK(Clock::now() - begin < milliseconds(10));
}

// The undefined behaviour sanitizer makes a pipe to look at an object's type: under this limit it
// cannot, and reports the object.
#ifdef DIBHR_FEW_DESCRIPTORS
TEST_CASE("a descriptor limit that ends the waiting ends the link, with a sentence", "[link]") {
    Linked linked;
    linked.exchange_until(10);
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_NOFILE, &before) == 0);
    const rlimit none{1, before.rlim_max};  // fewer than are waited for: EINVAL
    REQUIRE(setrlimit(RLIMIT_NOFILE, &none) == 0);
    linked.link->wait(Clock::now() + milliseconds(50));
    REQUIRE(setrlimit(RLIMIT_NOFILE, &before) == 0);
    CHECK(holds(linked.loss(), "does not let dibhr wait for the Falcon SIM00001"));
    CHECK(holds(linked.loss(), "close other programs"));
}
#endif

TEST_CASE("waiting ends with a wake of another thread, or when its time is over", "[link]") {
    Linked linked;
    linked.unit.set_faults({.frozen_in = 1});
    linked.exchange(milliseconds(1));
    const auto waited = [&](milliseconds limit) {
        const auto begin = Clock::now();
        linked.link->wait(begin + limit);
        return Clock::now() - begin;
    };
    constexpr milliseconds kExact{1};
    CHECK(waited(milliseconds(30)) >= milliseconds(30));
    std::thread other([&] {
        let_pass(milliseconds(20));
        linked.wake.signal();
    });
    const auto woken_after = waited(std::chrono::seconds(20));
    CHECK(woken_after >= milliseconds(20) - kExact);
    CHECK(woken_after < milliseconds(20) + kExact);
    other.join();
    CHECK(waited(milliseconds(30)) >= milliseconds(30));  // the wake was for once
}
