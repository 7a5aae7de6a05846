// What is on a Falcon's bus after the program that pressed has died, or while it stands still: the
// unit is falcon_host's and outlives it.
#include "device/falcon/guardian.hpp"

#include <fcntl.h>
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
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/device/falcon/last_moment.hpp"
#include "tests/device/falcon/packet_file.hpp"
#include "tests/device/falcon/usb_bench.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace {

using namespace dibhr::test::falcon;
using dibhr::falcon::encode;
using dibhr::falcon::Guardian;
using dibhr::falcon::Led;
using dibhr::falcon::no_force;
using dibhr::test::read_text;
using dibhr::test::TemporaryFolder;
using std::chrono::milliseconds;
using Packets = std::vector<LoggedPacket>;
namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{20};  // of a busy machine
constexpr double kLatest_s = 0.1;
constexpr double kSilence_s = 0.04;  ///< the guardian's 50 ms, looked at every 10

/// The guardians whose programs were started with this folder in their environment.
std::vector<pid_t> guardians_of(const fs::path& folder) {
    std::vector<pid_t> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        if (read_text(entry.path() / "comm") != "dibhr guardian\n") continue;
        if (read_text(entry.path() / "environ").find(folder.string()) == std::string::npos)
            continue;
        found.push_back(std::stoi(name));
    }
    return found;
}

/// The pressing program, with a homed unit whose motors hold a command for ever.
class Pressing {
  public:
    explicit Pressing(const std::string& way) {
        const std::string packets = file("packets.csv").string();
        const std::string moment = file("moment").string();
        std::vector<std::string> words{FALCON_HOST, "--packets", packets};
        for (const char* command : {"firmware", "home", "hold 0", "realtime on"}) {
            words.insert(words.end(), {"--command", command});
        }
        words.insert(words.end(), {"--", PRESSING_PROGRAM, way, moment});
        host_ = ::fork();
        REQUIRE(host_ >= 0);
        if (host_ == 0) become(words);
    }
    ~Pressing() {
        if (host_ > 0) {
            for (const pid_t guardian : guardians_of(folder_.path())) ::kill(guardian, SIGKILL);
            if (program_ > 0) ::kill(program_, SIGKILL);
            ::kill(host_, SIGKILL);
            ::waitpid(host_, nullptr, 0);
        }
    }
    Pressing(const Pressing&) = delete;
    Pressing& operator=(const Pressing&) = delete;

    [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::vector<pid_t> guardians() const { return guardians_of(folder_.path()); }
    /// Once there is one, which a busy machine may hide for a moment.
    [[nodiscard]] std::vector<pid_t> guardians_at_work() const {
        std::vector<pid_t> found;
        (void)eventually([&] { return !(found = guardians()).empty(); }, std::chrono::seconds(2));
        return found;
    }

    /// Until it has pressed, just before it goes its way; then when that was.
    double end_begins() {
        LastMoment last;
        const auto told = [&] {
            std::ifstream(file("moment"), std::ios::binary)
                .read(reinterpret_cast<char*>(&last), sizeof last);
            return last.program != 0;
        };
        REQUIRE(eventually(told, kPatience));
        program_ = last.program;
        return last.t_s;
    }
    [[nodiscard]] pid_t program() const noexcept { return program_; }
    /// The program's exit code, or 128 and its signal.
    int ended() {
        int status = 0;
        REQUIRE(eventually([&] { return ::waitpid(host_, &status, WNOHANG) == host_; }, kPatience));
        host_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    [[nodiscard]] Packets after(double t_s) const {
        return packets_after(file("packets.csv"), t_s);
    }
    [[nodiscard]] std::string errors() const { return read_text(file("errors")); }

  private:
    [[noreturn]] void become(std::vector<std::string>& words) const {
        const int errors = ::open(file("errors").c_str(), O_WRONLY | O_CREAT, 0600);
        ::dup2(errors, STDOUT_FILENO);
        ::dup2(errors, STDERR_FILENO);
        ::setenv("PRESSING", folder_.path().c_str(), 1);
        // A sanitizer is to let it die, and to bear libraries before its own.
        constexpr const char* kBear = "handle_segv=0:handle_sigbus=0:handle_abort=0";
        ::setenv("TSAN_OPTIONS", kBear, 1);
        ::setenv("ASAN_OPTIONS", (std::string(kBear) + ":verify_asan_link_order=0").c_str(), 1);
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        ::execv(arguments.front(), arguments.data());
        ::_exit(127);
    }

    TemporaryFolder folder_{};
    pid_t host_{-1};
    pid_t program_{-1};
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
    struct Way {
        const char* name;
        int code;
    };
    const auto way = GENERATE(values<Way>({{"kill", 128 + SIGKILL},
                                           {"kill-group", 128 + SIGKILL},
                                           {"segmentation", 128 + SIGSEGV},
                                           {"bus-error", 128 + SIGBUS},
                                           {"abort", 128 + SIGABRT},
                                           {"exception", 128 + SIGABRT},
                                           {"file-size", 128 + SIGXFSZ},
                                           {"exit", 3}}));
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
        const Guardian guardian;
        CHECK(guardian.fault().empty());
        ::close(ends[1]);
        CHECK(eventually(told_of_end));
    }
    SECTION("what it is given, until it is dismissed") {
        Guardian guardian;
        guardian.watch(ends[1], encode(no_force(Led::off)));
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
        Guardian guardian;
        guardian.watch(0, encode(no_force(Led::off)));
        guardian.beat();
        guardian.dismiss();
        ::_exit(guardian.fault().find("no guardian process (fork: ") == 0 ? 0 : 1);
    }
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
}
