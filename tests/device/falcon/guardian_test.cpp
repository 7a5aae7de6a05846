// What is on a Falcon's bus after the program that pressed has died, or while it stands still: the
// unit is falcon_host's and outlives it. When the guardian speaks, to the millisecond, is tested on
// simulated time (../hand/guardian_test.cpp).
#include "device/hand/guardian.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "device/falcon/bring_up.hpp"
#include "tests/device/falcon/packet_file.hpp"
#include "tests/device/pressing_process.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using dibhr::Guardian;
using dibhr::falcon::stop_packet;
using dibhr::test::eventually;
using dibhr::test::kWaysToDie;
using dibhr::test::PressingProcess;
using Packets = std::vector<LoggedPacket>;

constexpr double kSilence_s = 0.04;  ///< the guardian's 50 ms, looked at every 10

bool is_farewell(const LoggedPacket& packet) {
    return packet.led == 0;
}

/// The pressing program, with a homed unit whose motors hold a command for ever.
class Pressing : public PressingProcess {
  public:
    /// `realtime`: whether the bus has frames of 1 ms, or takes no time.
    explicit Pressing(const std::string& way, bool realtime = false) {
        std::vector<std::string> words{FALCON_HOST, "--packets", file("packets.csv").string()};
        for (const char* command : {"firmware", "home", "hold 0"}) {
            words.insert(words.end(), {"--command", command});
        }
        if (realtime) words.insert(words.end(), {"--command", "realtime on"});
        words.insert(words.end(), {"--", PRESSING_PROGRAM, way, file("moment").string()});
        begin(words);
    }

    double end_begins() {
        return PressingProcess::end_begins([this] { return forces_after(0.0) > 0; });
    }
    [[nodiscard]] Packets after(double t_s) const {
        return packets_after(file("packets.csv"), t_s);
    }
    [[nodiscard]] std::ptrdiff_t forces_after(double t_s) const {
        return std::ranges::count_if(after(t_s), &LoggedPacket::has_force);
    }
    [[nodiscard]] std::ptrdiff_t farewells_after(double t_s) const {
        return std::ranges::count_if(after(t_s), is_farewell);
    }
    /// When the last packet with force came, by now [s].
    [[nodiscard]] double last_force_s() const {
        const Packets packets = after(0.0);
        const auto last =
            std::find_if(packets.rbegin(), packets.rend(), std::mem_fn(&LoggedPacket::has_force));
        REQUIRE(last != packets.rend());
        return last->t_s;
    }
    /// Once there have been so many without a force between them.
    [[nodiscard]] bool is_let_go_by(std::ptrdiff_t farewells) const {
        return eventually([&] { return farewells_after(last_force_s()) >= farewells; }, kPatience);
    }
};

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// When the first packet came that has no force, after which all have none [s].
double let_go(const Packets& packets) {
    const auto first = std::ranges::find_if_not(packets, &LoggedPacket::has_force);
    REQUIRE(first != packets.end());
    CHECK(std::none_of(first, packets.end(), [](const auto& each) { return each.has_force(); }));
    CHECK(std::all_of(first, packets.end(), [](const auto& each) { return each.homing; }));
    return first->t_s;
}

/// Between two of the last few packets up to `at` [s]; of those that the unit was kept from taking
/// some come at once.
double longest_pause_before(const Packets& packets, Packets::const_iterator at) {
    const auto few = std::min<std::ptrdiff_t>(at - packets.begin(), 5);
    double longest_s = 0.0;
    for (auto packet = at - few; packet != at; ++packet)
        longest_s = std::max(longest_s, (packet + 1)->t_s - packet->t_s);
    return longest_s;
}

}  // namespace

TEST_CASE("however a program dies while it presses, the last on the bus are five zeros",
          "[guardian]") {
    const auto way = GENERATE(from_range(std::begin(kWaysToDie), std::end(kWaysToDie)));
    CAPTURE(way.name);
    Pressing pressing(way.name);
    const double died_s = pressing.end_begins();
    CHECK(pressing.ended() == way.code);
    INFO(pressing.errors());
    const Packets packets = pressing.after(pressing.last_force_s());
    CHECK(std::ranges::count_if(packets, is_farewell) >= 5);
    CHECK(std::ranges::all_of(packets, &LoggedPacket::homing));
    CHECK(packets.back().t_s > died_s);
    CHECK(pressing.its_guardian_ends());
}

TEST_CASE("a program that is stopped in mid-touch is without force until it goes on",
          "[guardian]") {
    Pressing pressing("stop");
    (void)pressing.end_begins();
    REQUIRE(pressing.is_let_go_by(40));
    const double stands_still_s = now_s();
    ::kill(pressing.program(), SIGCONT);
    REQUIRE(eventually([&] { return pressing.forces_after(stands_still_s) > 20; },
                       PressingProcess::kPatience));
    pressing.go_on();
    CHECK(pressing.ended() == 0);
    CHECK_FALSE(pressing.after(stands_still_s).back().has_force());
}

TEST_CASE("a program that presses is disturbed only when it falls silent", "[guardian]") {
    Pressing pressing("leave");
    const double begin_s = pressing.end_begins();
    CHECK(pressing.guardian() > 0);
    REQUIRE(eventually([&] { return pressing.forces_after(begin_s) > 200; },
                       PressingProcess::kPatience));
    pressing.go_on();
    CHECK(pressing.ended() == 0);
    CHECK(pressing.errors().empty());
    const Packets packets = pressing.after(begin_s);
    CHECK(std::ranges::all_of(packets, &LoggedPacket::homing));
    const auto leaves = std::find_if_not(packets.rbegin(), packets.rend(), is_farewell).base();
    CHECK(packets.end() - leaves >= 5);
    for (auto at = packets.begin(); at != leaves; ++at) {
        if (!is_farewell(*at) || (at != packets.begin() && is_farewell(*(at - 1)))) continue;
        INFO("a machine that let nobody write for 50 ms, or a guardian that disturbs");
        CHECK(longest_pause_before(packets, at) > kSilence_s);
    }
}

TEST_CASE("an alarm takes the force off for good, though the program goes on", "[guardian]") {
    Pressing pressing("alarm");
    (void)pressing.end_begins();
    REQUIRE(pressing.is_let_go_by(20));
    const double last_force_s = pressing.last_force_s();
    pressing.go_on();
    CHECK(pressing.ended() == 0);
    CHECK(pressing.forces_after(last_force_s) == 0);
}

TEST_CASE("a program whose guardian was killed lets go, and presses with another guardian",
          "[guardian]") {
    Pressing pressing("leave");
    (void)pressing.end_begins();
    const pid_t first = pressing.guardian();
    const double killed_s = now_s();
    REQUIRE(::kill(first, SIGKILL) == 0);
    REQUIRE(eventually([&] { return pressing.farewells_after(killed_s) >= 5; },
                       PressingProcess::kPatience));
    const Packets later = pressing.after(killed_s);
    const auto zero = std::ranges::find_if_not(later, &LoggedPacket::has_force);
    REQUIRE(zero != later.end());
    WARN("Falcon, guardian killed: zero force after " << zero->t_s - killed_s << " s");
    const double let_go_s = later.back().t_s;
    REQUIRE(eventually([&] { return pressing.forces_after(let_go_s) > 50; },
                       PressingProcess::kPatience));
    CHECK(pressing.guardian() != first);
    REQUIRE(::kill(pressing.program(), SIGKILL) == 0);
    CHECK(pressing.ended() == 128 + SIGKILL);
    CHECK(pressing.is_let_go_by(5));
    CHECK(pressing.its_guardian_ends());
}

TEST_CASE("zero is on the bus 0.1 s after a program has died, and 0.2 s after it was stopped",
          "[guardian][realtime]") {
    const auto way = GENERATE(from_range(std::begin(kWaysToDie), std::end(kWaysToDie)));
    CAPTURE(way.name);
    Pressing pressing(way.name, true);
    const double died_s = pressing.end_begins();
    CHECK(pressing.ended() == way.code);
    const double taken_s = let_go(pressing.after(died_s)) - died_s;
    WARN("Falcon, " << way.name << ": zero force after " << taken_s << " s");
    CHECK(taken_s < 0.1);
    CHECK(pressing.farewells_after(died_s) >= 5);

    Pressing stopped("stop", true);
    const double stopped_s = stopped.end_begins();
    REQUIRE(eventually([&] { return stopped.farewells_after(stopped_s) > 5; },
                       PressingProcess::kPatience));
    const double stop_taken_s = let_go(stopped.after(stopped_s)) - stopped_s;
    WARN("Falcon, stopped: zero force after " << stop_taken_s << " s");
    CHECK(stop_taken_s < 0.2);
    ::kill(stopped.program(), SIGCONT);
    stopped.go_on();
    CHECK(stopped.ended() == 0);
}

TEST_CASE("where no process may be made the program goes on and says that nobody guards it",
          "[guardian]") {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        if (::getuid() == 0 && ::setuid(65534) != 0) ::_exit(2);  // no limit holds for root
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_NPROC, &none);
        Guardian guardian("Falcon");
        guardian.watch(0, stop_packet());
        guardian.beat();
        guardian.dismiss();
        ::_exit(guardian.fault().find("no guardian process (fork: ") == 0 ? 0 : 1);
    }
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
}
