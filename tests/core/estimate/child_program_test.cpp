// However an estimator's program, what it has started, or dibhr ends, nothing of it goes on.
#include "core/estimate/child_program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

namespace {

using namespace dibhr;
using dibhr::test::eventually;
namespace fs = std::filesystem;

/// Ways in which an estimator starts what goes on; $0 is a time to sleep that is nobody else's.
constexpr std::array kStarts{
    "sleep $0 & wait",
    "nohup sleep $0 >/dev/null & wait",
    "setsid sleep $0 & wait",
    "setsid sh -c \"sleep $0 & wait\" & wait",
    "(sleep $0 &); sleep 60",
    "setsid nohup sh -c \"trap '' HUP INT; sleep $0\" & wait",
    "(setsid sh -c \"(setsid sleep $0 &)\" &); sleep 60",
    "env -i setsid sleep $0 & wait",
    "exec >/dev/null 2>&1; sleep $0 & wait",
    "timeout 60 sleep $0 & wait",
    "nice setsid sleep $0 & wait",
    "sleep $0 & until grep -q sleep /proc/$!/comm; do :; done; kill -STOP $!; wait",
    "setsid -f sleep $0; sleep 60",
    "echo $0 | xargs sleep & wait",
    "find / -maxdepth 0 -exec sleep $0 ';' & wait",
    "yes $0 >/dev/null & wait",
    "sleep $0 | sleep $0 & wait",
    "exec sleep $0",
    "setsid sh -c \"setsid sh -c \\\"setsid sleep $0 & exit\\\" & exit\" & sleep 60",
    "for k in 1 2 3 4 5; do setsid sleep $0 & done; wait",
    "cd /; setsid -f sh -c \"while :; do sleep $0; done\"; kill -STOP $$",
    "trap '' TERM; setsid sh -c \"trap '' TERM HUP; sleep $0\" & sleep 60; sleep 60"};

std::string own_time() {
    static std::atomic<int> number{0};
    return "77" + std::to_string(++number) + "." + std::to_string(::getpid());
}

/// Processes that were told it, and have not ended.
int processes_told(const std::string& time) {
    int count = 0;
    std::error_code gone;
    for (const auto& process : fs::directory_iterator("/proc", gone)) {
        if (process.path().filename().string().find_first_not_of("0123456789") != std::string::npos)
            continue;
        std::array<char, 256> line{};  // one that has ended meanwhile has none
        const int file = ::open((process.path() / "cmdline").c_str(), O_RDONLY | O_CLOEXEC);
        const ssize_t got = file < 0 ? 0 : ::read(file, line.data(), line.size());
        ::close(file);
        const std::string words(line.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        const bool sleeps = words.starts_with("sleep") || words.starts_with("yes");
        if (sleeps && words.find(time) != std::string::npos) ++count;
    }
    return count;
}

std::vector<std::string> program(const char* script, const std::string& time) {
    return {"/bin/sh", "-c", script, time};
}

bool goes_on(const std::string& time) {
    return eventually([&] { return processes_told(time) > 0; });
}

bool nothing_is_left(const std::string& time) {
    return eventually([&] { return processes_told(time) == 0; });
}

}  // namespace

TEST_CASE("all that an estimator has started ends when it is asked to, or given up", "[estimate]") {
    for (const char* const script : kStarts) {
        CAPTURE(script);
        for (const bool asked : {true, false}) {
            const std::string time = own_time();
            std::optional<ChildProgram> child(std::in_place, program(script, time),
                                              ChildPriority::normal);
            CHECK(goes_on(time));
            if (asked) child->end();
            if (asked) CHECK(processes_told(time) == 0);
            child.reset();
            CHECK(processes_told(time) == 0);
        }
    }
}

TEST_CASE("all that an estimator has started ends when dibhr is killed", "[estimate]") {
    for (const char* const script : kStarts) {
        CAPTURE(script);
        const std::string time = own_time();
        const pid_t dibhr = ::fork();
        if (dibhr == 0) {
            const ChildProgram child(program(script, time), ChildPriority::low);
            while (true) ::pause();
        }
        CHECK(goes_on(time));
        ::kill(dibhr, SIGKILL);
        ::waitpid(dibhr, nullptr, 0);
        CHECK(nothing_is_left(time));
    }
}

TEST_CASE("what an estimator leaves when it ends by itself ends with it, and it says how it ended",
          "[estimate]") {
    struct Way {
        const char* script;
        int code, signal;
    };
    const Way way = GENERATE(Way{"setsid sleep $0 & exit 0", 0, 0}, Way{"sleep $0 & exit 3", 3, 0},
                             Way{"setsid -f sleep $0; kill -SEGV $$", 0, SIGSEGV},
                             Way{"sleep $0 & kill -TERM $$", 0, SIGTERM},
                             Way{"nohup sleep $0 & kill -KILL $$", 0, SIGKILL},
                             Way{"sleep $0 & kill -HUP $$", 0, SIGHUP});
    CAPTURE(way.script);
    const std::string time = own_time();
    ChildProgram child(program(way.script, time), ChildPriority::normal);
    CHECK(eventually([&] { return child.ended().has_value(); }));
    CHECK(processes_told(time) == 0);
    const ChildEnd end = child.ended().value_or(ChildEnd{});
    CHECK(end.exit_code == way.code);
    CHECK(end.signal == way.signal);
    CHECK(::kill(child.keeper(), 0) == 0);  // its number is no other program's
}

TEST_CASE("one that talks faster than anybody listens is listened to in pieces", "[estimate]") {
    ChildProgram child({"/bin/sh", "-c", "yes 'all of it, again and again'"},
                       ChildPriority::normal);
    for (int k = 0; k < 5; ++k) {
        std::string text;
        CHECK(eventually([&] {
            text = child.written(std::chrono::milliseconds(50));
            return !text.empty();
        }));
        CHECK(text.size() <= (std::size_t{1} << 16) + 4096);
    }
}
