// What is on a Falcon's bus after the program that pressed has died, or while it stands still: the
// unit is falcon_host's and outlives it.
#include "device/hand/guardian.hpp"

#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "device/falcon/bring_up.hpp"
#include "tests/device/falcon/packet_file.hpp"
#include "tests/device/falcon/usb_bench.hpp"
#include "tests/device/pressing_process.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using dibhr::Guardian;
using dibhr::falcon::farewell;
using dibhr::test::kWaysToDie;
using dibhr::test::PressingProcess;
using std::chrono::milliseconds;
using Packets = std::vector<LoggedPacket>;

constexpr std::chrono::seconds kPatience = PressingProcess::kPatience;
constexpr double kLatest_s = 0.1;
constexpr double kSilence_s = 0.04;  ///< the guardian's 50 ms, looked at every 10

/// The pressing program, with a homed unit whose motors hold a command for ever.
class Pressing : public PressingProcess {
  public:
    explicit Pressing(const std::string& way) {
        std::vector<std::string> words{FALCON_HOST, "--packets", file("packets.csv").string()};
        for (const char* command : {"firmware", "home", "hold 0", "realtime on"}) {
            words.insert(words.end(), {"--command", command});
        }
        words.insert(words.end(), {"--", PRESSING_PROGRAM, way, file("moment").string()});
        begin(words);
    }

    [[nodiscard]] Packets after(double t_s) const {
        return packets_after(file("packets.csv"), t_s);
    }
};

/// Keeps the machine busy.
class Load {
  public:
    explicit Load(int threads) {
        for (int k = 0; k < threads; ++k) {
            threads_.emplace_back([](const std::stop_token& stop) {
                while (!stop.stop_requested()) {
                }
            });
        }
    }

  private:
    std::vector<std::jthread> threads_{};
};

bool is_farewell(const LoggedPacket& packet) {
    return packet.led == 0;
}

/// How long until the first packet without force, after which all have none [s].
double let_go(const Packets& packets, double since_s) {
    const auto first = std::ranges::find_if_not(packets, &LoggedPacket::has_force);
    REQUIRE(first != packets.end());
    CHECK(std::none_of(first, packets.end(), [](const auto& each) { return each.has_force(); }));
    CHECK(std::all_of(first, packets.end(), [](const auto& each) { return each.homing; }));
    return first->t_s - since_s;
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

/// On a machine that is too busy for one of them.
constexpr int kTries = 3;

}  // namespace

TEST_CASE("however a program dies while it presses, zero is on the bus within 100 ms, five times",
          "[guardian]") {
    const auto way = GENERATE(from_range(std::begin(kWaysToDie), std::end(kWaysToDie)));
    CAPTURE(way.name);
    double soonest_s = 1.0;
    std::ptrdiff_t farewells = 0;  // one that such a machine takes too long for is given up
    for (int k = 0; k < kTries && (soonest_s > kLatest_s || farewells < 5); ++k) {
        Pressing pressing(way.name);
        const double died_s = pressing.end_begins();
        CHECK(pressing.ended() == way.code);
        INFO(pressing.errors());
        const Packets packets = pressing.after(died_s);
        soonest_s = std::min(soonest_s, let_go(packets, died_s));
        const std::ptrdiff_t now = std::ranges::count_if(packets, is_farewell);
        CHECK(now >= 1);
        farewells = std::max(farewells, now);
        CHECK(pressing.guardians().empty());
    }
    CHECK(soonest_s < kLatest_s);
    CHECK(farewells >= 5);
}

TEST_CASE("a program that is stopped in mid-touch is without force until it goes on",
          "[guardian]") {
    Pressing pressing("stop");
    const double stopped_s = pressing.end_begins();
    REQUIRE(eventually([&] { return pressing.after(stopped_s).size() > 40; }, kPatience));
    CHECK(let_go(pressing.after(stopped_s), stopped_s) < kLatest_s);
    const double goes_on_s = pressing.after(stopped_s).back().t_s;
    ::kill(pressing.program(), SIGCONT);
    CHECK(pressing.ended() == 0);
    const Packets later = pressing.after(goes_on_s);
    CHECK(std::ranges::count_if(later, &LoggedPacket::has_force) > 500);
    CHECK_FALSE(later.back().has_force());
}

TEST_CASE("a program that presses is never disturbed, nor is it on a busy machine", "[guardian]") {
    const std::optional<Load> load =
        GENERATE(false, true) ? std::make_optional<Load>(4) : std::nullopt;
    Pressing pressing("leave");
    const double begin_s = pressing.end_begins();
    CHECK(pressing.guardians_at_work().size() == 1);
    CHECK(pressing.ended() == 0);
    CHECK(pressing.errors().empty());
    const Packets packets = pressing.after(begin_s);
    CHECK(std::ranges::count_if(packets, &LoggedPacket::has_force) > 500);
    CHECK(std::ranges::all_of(packets, &LoggedPacket::homing));
    // Its own last five, and the guardian's where a busy machine took longer than 50 ms for them.
    const auto leaves = std::find_if_not(packets.rbegin(), packets.rend(), is_farewell).base();
    CHECK(packets.end() - leaves >= 3);
    for (auto at = packets.begin(); at != leaves; ++at) {
        if (!is_farewell(*at) || (at != packets.begin() && is_farewell(*(at - 1)))) continue;
        INFO("a machine that let nobody write for 50 ms, or a guardian that disturbs");
        CHECK(longest_pause_before(packets, at) > kSilence_s);
    }
}

TEST_CASE("an alarm takes the force off for good, though the program goes on", "[guardian]") {
    Pressing pressing("alarm");
    const double sounded_s = pressing.end_begins();
    CHECK(pressing.ended() == 0);
    const Packets packets = pressing.after(sounded_s);
    CHECK(let_go(packets, sounded_s) < kLatest_s);
    CHECK(std::ranges::count_if(packets, is_farewell) > 20);
}

TEST_CASE("a program whose guardian was killed presses on, and leaves in order", "[guardian]") {
    Pressing pressing("leave");
    const double begin_s = pressing.end_begins();
    const std::vector<pid_t> guardians = pressing.guardians_at_work();
    REQUIRE(guardians.size() == 1);
    REQUIRE(::kill(guardians.front(), SIGKILL) == 0);
    CHECK(pressing.ended() == 0);
    const Packets packets = pressing.after(begin_s + 0.2);
    CHECK(std::ranges::count_if(packets, &LoggedPacket::has_force) > 500);
    CHECK(std::ranges::count_if(packets, is_farewell) == 5);
}

TEST_CASE("a guardian keeps nothing of the program's open, and is gone when it is dismissed",
          "[guardian]") {
    std::array<int, 2> ends{};
    REQUIRE(::pipe(ends.data()) == 0);
    const auto told_of_end = [&] {
        pollfd reader{ends[0], POLLIN, 0};
        return ::poll(&reader, 1, 0) == 1 && (reader.revents & POLLHUP) != 0;
    };
    SECTION("what was open before it") {
        const Guardian guardian("Falcon");
        CHECK(guardian.fault().empty());
        ::close(ends[1]);
        CHECK(eventually(told_of_end));
    }
    SECTION("what it is given, until it is dismissed") {
        Guardian guardian("Falcon");
        guardian.watch(ends[1], farewell());
        ::close(ends[1]);
        guardian.dismiss();
        CHECK(told_of_end());
    }
    ::close(ends[0]);
    CHECK(::waitpid(-1, nullptr, WNOHANG) == -1);  // no child is left
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
        guardian.watch(0, farewell());
        guardian.beat();
        guardian.dismiss();
        ::_exit(guardian.fault().find("no guardian process (fork: ") == 0 ? 0 : 1);
    }
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
}
