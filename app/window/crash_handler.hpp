// What still runs when the program crashes: force off, the crash note, then the default action.
#pragma once

#include <cstddef>
#include <memory>

#include "app/window/crash_note.hpp"

namespace dibhr {

/// During its life, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT and std::terminate() run `first` and
/// print the crash note. Then the signal's default action gives the usual exit status and core
/// dump; after a failed allocation the status is 1. A sanitizer's own handlers stay. A write beyond
/// the limit of a file's size (SIGXFSZ) only fails with EFBIG; SIGXFSZ from another program is a
/// crash. At most one handler may exist.
class CrashHandler {
  public:
    /// The crashing thread calls `first`, which must be async-signal-safe. `crash_note` must
    /// outlive it.
    CrashHandler(const CrashNote& crash_note, void (*first)() noexcept);
    ~CrashHandler();
    CrashHandler(const CrashHandler&) = delete;
    CrashHandler& operator=(const CrashHandler&) = delete;

    /// Calls `first` and prints the crash note; from a signal handler.
    void report_crash(const char* how) const noexcept;

  private:
    const CrashNote& crash_note_;
    void (*first_)() noexcept;
    std::unique_ptr<std::byte[]> stack_;  // the handler's, if this thread's stack overflowed
};

}  // namespace dibhr
