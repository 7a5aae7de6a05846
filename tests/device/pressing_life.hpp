// A program that presses with a device until it ends in a chosen way; the guardian's tests watch it
// from outside.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <string>

#include "device/hand/guardian.hpp"
#include "tests/device/last_moment.hpp"

namespace dibhr::test {

inline constexpr int kExitCode = 3;

/// Of a program that presses in `Loop`, a TickingDevice.
template <typename Loop>
class Life {
  public:
    /// Presses until the test lets it go on; `file` holds the LastMoment.
    Life(const char* file, Loop& loop) : loop_(loop), last_(last_moment_in(file)) {
        setpgid(0, 0);
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        if (last_ == nullptr) std::exit(EXIT_FAILURE);
        loop_.force_newton = {0.0, 0.0, 1.0};
        press_until_let_on(1);
    }

    /// False: there is no such way to end it.
    bool end(const std::string& way) {
        const std::map<std::string, std::function<void()>> ways{
            {"kill", told_before([] { (void)raise(SIGKILL); })},
            {"kill-group", told_before([] { kill(0, SIGKILL); })},
            {"segmentation", told_before([] { (void)raise(SIGSEGV); })},
            {"bus-error", [this] { touch_what_is_not_there(); }},
            {"abort", told_before([] { std::abort(); })},
            {"exception", told_before([] { std::terminate(); })},
            {"file-size", [this] { write_too_much(); }},
            {"exit", told_before([] { _exit(kExitCode); })},
            // These press on until the test lets them go on once more.
            {"leave", told_before([this] { press_until_let_on(2); })},
            {"stop", told_before([this] {
                 (void)raise(SIGSTOP);
                 press_until_let_on(2);
             })},
            {"alarm", told_before([this] {
                 Guardian::alarm();
                 press_until_let_on(2);
             })},
        };
        const auto found = ways.find(way);
        if (found == ways.end()) return false;
        found->second();
        return true;
    }

  private:
    void press_until_let_on(int times) {
        const auto let_on = [this, times] { return last_->goes_on >= times; };
        if (!loop_.tick_until(let_on, std::chrono::minutes(5))) std::exit(EXIT_FAILURE);
    }
    template <typename End>
    std::function<void()> told_before(End end) {
        return [this, end] {
            tell();
            end();
        };
    }
    void tell() {
        loop_.tick();
        last_->t_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
                .count();
        last_->program = getpid();
    }
    /// A page of a file that has none.
    void touch_what_is_not_there() {
        std::FILE* const file = std::tmpfile();
        auto* const page = static_cast<volatile char*>(map_page(fileno(file)));
        tell();
        *page = 1;
    }
    void write_too_much() {
        std::FILE* const file = std::tmpfile();
        const rlimit none{0, 0};
        setrlimit(RLIMIT_FSIZE, &none);
        tell();
        (void)!write(fileno(file), "x", 1);
    }

    Loop& loop_;
    LastMoment* last_;
};

}  // namespace dibhr::test
