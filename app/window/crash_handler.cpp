// The signal handlers for a crash.
#include "app/window/crash_handler.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <utility>

namespace dibhr {

namespace {

constexpr bool kSanitized = DIBHR_SANITIZED;

constexpr std::size_t kStack_bytes = 65536;

constexpr std::array<std::pair<int, const char*>, 5> kCrashes{{{SIGSEGV, "segmentation fault"},
                                                               {SIGBUS, "bus error"},
                                                               {SIGFPE, "arithmetic error"},
                                                               {SIGILL, "illegal instruction"},
                                                               {SIGABRT, "aborted"}}};

// A signal handler gets no argument of ours: here it finds the CrashHandler that exists. The first
// crash takes it, so that only one line is printed.
std::atomic<const CrashHandler*> active_handler{nullptr};

const char* name_of_signal(int signal) noexcept {
    for (const auto& [number, name] : kCrashes)
        if (number == signal) return name;
    return "file-size limit";
}

void on_crash(int signal, siginfo_t* info, void*) noexcept {
    // The kernel sends SIGXFSZ to the thread that wrote; the failed write is enough.
    if (signal == SIGXFSZ && (info->si_code == SI_KERNEL || info->si_pid == getpid())) return;
    if (const CrashHandler* const handler = active_handler.exchange(nullptr))
        handler->report_crash(name_of_signal(signal));
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // pending until this returns
}

[[noreturn]] void on_terminate() noexcept {
    if (const CrashHandler* const handler = active_handler.exchange(nullptr)) {
        try {
            if (const auto error = std::current_exception()) std::rethrow_exception(error);
            handler->report_crash("terminated");
        } catch (const std::bad_alloc&) {
            // In a thread or library that cannot report it: not a fault of the program.
            handler->report_crash(
                "there is not enough memory: close other programs or raise the limit");
            _exit(EXIT_FAILURE);
        } catch (const std::exception& error) {
            handler->report_crash(error.what());
        } catch (...) {
            handler->report_crash("an error of an unknown kind");
        }
    }
    std::abort();
}

template <typename Act>
void for_each_signal(const Act& act) {
    act(SIGXFSZ);
    if (kSanitized) return;
    for (const auto& [number, name] : kCrashes) act(number);
}

}  // namespace

CrashHandler::CrashHandler(const CrashNote& crash_note, void (*first)() noexcept)
    : crash_note_(crash_note), first_(first), stack_(std::make_unique<std::byte[]>(kStack_bytes)) {
    active_handler = this;
    if (!kSanitized) {
        const stack_t stack{stack_.get(), 0, kStack_bytes};
        sigaltstack(&stack, nullptr);
        std::set_terminate(on_terminate);
    }
    struct sigaction action {};
    action.sa_sigaction = on_crash;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_RESTART;
    for_each_signal([&action](int signal) { sigaction(signal, &action, nullptr); });
}

CrashHandler::~CrashHandler() {
    // Other code may still write beyond the limit of a file's size: its writes only fail, too.
    for_each_signal([](int signal) { std::signal(signal, signal == SIGXFSZ ? SIG_IGN : SIG_DFL); });
    active_handler = nullptr;
    if (kSanitized) return;
    const stack_t none{nullptr, SS_DISABLE, 0};
    sigaltstack(&none, nullptr);
}

void CrashHandler::report_crash(const char* how) const noexcept {
    first_();
    crash_note_.print({"crashed (", how, "); the force is off"});
}

}  // namespace dibhr
