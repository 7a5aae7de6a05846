// Shutdown requests and crashes, each in a child process that contains only their handlers.
#include "app/window/shutdown_watchdog.hpp"

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "app/window/crash_handler.hpp"
#include "app/window/crash_note.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace std::chrono_literals;

namespace {

struct HowItEnded {
    int status{0};  ///< 128 + signal
    std::string errors{};
};

/// Runs `life` in a process of its own, which writes one byte when it is ready for the test's
/// signals.
class Child {
  public:
    using Life = std::function<int(int told)>;

    explicit Child(const Life& life) {
        REQUIRE(::pipe(told_.data()) == 0);
        REQUIRE(::pipe(errors_.data()) == 0);
        process_ = ::fork();
        REQUIRE(process_ >= 0);
        if (process_ == 0) {
            const rlimit no_core{0, 0};
            ::setrlimit(RLIMIT_CORE, &no_core);
            ::dup2(errors_[1], STDERR_FILENO);
            ::close(errors_[1]);
            ::_exit(life(told_[1]));
        }
        ::close(told_[1]);
        ::close(errors_[1]);
    }
    ~Child() {
        ::close(told_[0]);
        ::close(errors_[0]);
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    void wait_until_told() const {
        char byte = 0;
        REQUIRE(::read(told_[0], &byte, 1) == 1);
    }
    void send(int signal) const { REQUIRE(::kill(process_, signal) == 0); }
    HowItEnded wait() {
        HowItEnded how;
        std::array<char, 256> part{};
        for (ssize_t size = 0; (size = ::read(errors_[0], part.data(), part.size())) > 0;)
            how.errors.append(part.data(), static_cast<std::size_t>(size));
        int status = 0;
        REQUIRE(::waitpid(process_, &status, 0) == process_);
        process_ = -1;
        how.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return how;
    }

  private:
    std::array<int, 2> told_{};
    std::array<int, 2> errors_{};
    pid_t process_{-1};
};

void tell(int told) {
    if (::write(told, "!", 1) != 1) ::_exit(99);
}

/// A program that shuts down when requested.
int end_when_asked(int told) {
    CrashNote crash_note;
    ShutdownWatchdog shutdown(crash_note);
    tell(told);
    const bool requested = test::eventually([&] { return shutdown.requested().load(); }, 60s);
    return requested && shutdown.without_force() ? 0 : 98;
}

/// A program that does not.
int hang(int told) {
    CrashNote crash_note;
    crash_note.set_activity("sleeping");
    crash_note.set_recording("hand.dibhr");
    const ShutdownWatchdog shutdown(crash_note);
    tell(told);
    for (;;) ::pause();
}

/// A program that needs a second of computing to end, by a thread for which it waits.
int end_slowly(int told) {
    CrashNote crash_note;
    const ShutdownWatchdog shutdown(crash_note);
    tell(told);
    if (!test::eventually([&] { return shutdown.requested().load(); }, 60s)) return 98;
    std::thread([] {
        const auto begin = std::chrono::steady_clock::now();
        while (std::chrono::steady_clock::now() - begin < 1s) continue;
    }).join();
    return 0;
}

/// The handler's first action in a crash.
void say_first() noexcept {
    if (::write(STDERR_FILENO, "first, ", 7) != 7) ::_exit(97);
}

int crash(const std::function<void()>& how) {
    CrashNote crash_note;
    crash_note.set_recording("hand.dibhr");
    const CrashHandler handler(crash_note, &say_first);
    how();
    return 0;
}

}  // namespace

TEST_CASE("two signals within 200 ms are one request to end; a later one is another", "[ending]") {
    const ShutdownRequests::Time begin{};
    ShutdownRequests requests;
    CHECK_FALSE(requests.is_repeated(begin));
    CHECK_FALSE(requests.is_repeated(begin + 199ms));
    CHECK(requests.is_repeated(begin + 200ms));
    CHECK(requests.is_repeated(begin + 599ms));
}

TEST_CASE(
    "after a request a window hangs that stays in its loop for 600 ms and two turns, or outside it "
    "is silent for 600 ms, and in any case after 5 s, which no other request renews",
    "[ending]") {
    const ShutdownRequests::Time begin{};
    ShutdownRequests requests;
    CHECK_FALSE(requests.is_hung(begin, 0ms, 700ms));
    (void)requests.is_repeated(begin);
    CHECK_FALSE(requests.is_hung(begin + 1s, 0ms, 599ms));
    CHECK(requests.is_hung(begin + 1s, 0ms, 600ms));
    CHECK_FALSE(requests.is_hung(begin + 599ms, 50ms, 700ms));
    CHECK(requests.is_hung(begin + 600ms, 50ms, 0ms));
    CHECK_FALSE(requests.is_hung(begin + 799ms, 400ms, 0ms));
    CHECK(requests.is_hung(begin + 800ms, 400ms, 0ms));
    (void)requests.is_repeated(begin + 150ms);
    CHECK_FALSE(requests.is_hung(begin + 4999ms, 3s, 0ms));
    CHECK(requests.is_hung(begin + 5s, 3s, 0ms));
}

TEST_CASE("a signal asks for the end and takes the force off, whichever of the four it is",
          "[ending]") {
    const int signal = GENERATE(as<int>{}, SIGTERM, SIGINT, SIGHUP, SIGQUIT);
    CAPTURE(signal);
    Child program(end_when_asked);
    program.wait_until_told();
    program.send(signal);
    const HowItEnded how = program.wait();
    CHECK(how.status == 0);
    CHECK(how.errors.empty());
}

TEST_CASE("a program that hangs is ended after a signal, and says what it did", "[ending]") {
    Child program(hang);
    program.wait_until_told();
    program.send(SIGTERM);
    program.send(SIGHUP);  // part of the same request
    const HowItEnded how = program.wait();
    CHECK(how.status == 1);
    CHECK(how.errors ==
          "dibhr: asked to end, but hung while sleeping; the force is off, ended at once; the "
          "recording up to now is in hand.dibhr\n");
}

TEST_CASE("a program that still works is not taken for one that hangs", "[ending]") {
    Child program(end_slowly);
    program.wait_until_told();
    program.send(SIGTERM);
    const HowItEnded how = program.wait();
    CHECK(how.status == 0);
    CHECK(how.errors.empty());
}

TEST_CASE("a display that goes takes the force off, and asks for nothing", "[ending]") {
    Child program([](int told) {
        std::array<int, 2> display{};
        if (::socketpair(AF_UNIX, SOCK_STREAM, 0, display.data()) != 0) return 96;
        CrashNote crash_note;
        ShutdownWatchdog shutdown(crash_note);
        shutdown.watch_display(display[0]);
        tell(told);
        if (shutdown.without_force()) return 95;
        ::close(display[1]);
        if (!test::eventually([&] { return shutdown.without_force().load(); }, 60s)) return 94;
        return shutdown.requested() ? 93 : 0;
    });
    CHECK(program.wait().status == 0);
}

TEST_CASE("a crash takes the force off, is told in one line, and ends as it would have",
          "[crash]") {
    const auto [signal, name] = GENERATE(table<int, std::string>({{SIGSEGV, "segmentation fault"},
                                                                  {SIGBUS, "bus error"},
                                                                  {SIGFPE, "arithmetic error"},
                                                                  {SIGILL, "illegal instruction"},
                                                                  {SIGABRT, "aborted"},
                                                                  {SIGXFSZ, "file-size limit"}}));
    if (DIBHR_SANITIZED && signal != SIGXFSZ) {
        SUCCEED("a sanitizer's own handlers stay");
        return;
    }
    CAPTURE(name);
    Child program([](int told) {
        return crash([&] {
            tell(told);
            for (;;) ::pause();
        });
    });
    program.wait_until_told();
    program.send(signal);
    const HowItEnded how = program.wait();
    CHECK(how.status == 128 + signal);
    CHECK(how.errors == "first, dibhr: crashed (" + name +
                            "); the force is off; the recording up to now is in hand.dibhr\n");
}

TEST_CASE("an exception that nobody catches is told in one line", "[crash]") {
    if (DIBHR_SANITIZED) {
        SUCCEED("a sanitizer's own handlers stay");
        return;
    }
    Child faulty([](int) {
        return crash([] { std::thread([] { throw std::runtime_error("a fault"); }).join(); });
    });
    const HowItEnded fault = faulty.wait();
    CHECK(fault.status == 128 + SIGABRT);
    CHECK(fault.errors ==
          "first, dibhr: crashed (a fault); the force is off; the recording up to now is in "
          "hand.dibhr\n");
    Child short_of_memory(
        [](int) { return crash([] { std::thread([] { throw std::bad_alloc(); }).join(); }); });
    const HowItEnded lack = short_of_memory.wait();
    CHECK(lack.status == 1);
    CHECK(lack.errors.starts_with("first, dibhr: crashed (there is not enough memory: "));
}

TEST_CASE("a write of the program's own that meets the limit of a file's size fails, no more",
          "[crash]") {
    Child program([](int) {
        return crash([] {
            std::FILE* const file = std::tmpfile();
            const rlimit none{0, 0};
            ::setrlimit(RLIMIT_FSIZE, &none);
            if (::write(::fileno(file), "x", 1) != -1 || errno != EFBIG) ::_exit(92);
        });
    });
    const HowItEnded how = program.wait();
    CHECK(how.status == 0);
    CHECK(how.errors.empty());
}
