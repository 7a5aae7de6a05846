// What is still done when the program crashes: the force, one plain line, and then what is usual.
#pragma once

#include <cstddef>
#include <memory>

#include "app/window/last_words.hpp"

namespace dibhr {

/// While it lives, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT and std::terminate() run `first`
/// and say what happened; then the signal does what it does by default, so that exit status and
/// core dump are the usual ones; but of an allocation that failed the status is 1. A sanitizer's
/// own handlers stay. A write that meets the limit of a file's size (SIGXFSZ) fails with EFBIG and
/// nothing else; the same signal from another program is a crash. One at a time.
class CrashHandler {
  public:
    /// `first` is called by the thread that crashed: it may do only what is async-signal-safe.
    /// `words` outlives it.
    CrashHandler(const LastWords& words, void (*first)() noexcept);
    ~CrashHandler();
    CrashHandler(const CrashHandler&) = delete;
    CrashHandler& operator=(const CrashHandler&) = delete;

    /// `first` and the line; from a signal handler.
    void crashed(const char* how) const noexcept;

  private:
    const LastWords& words_;
    void (*first_)() noexcept;
    std::unique_ptr<std::byte[]> stack_;  // for a stack that overflowed: this thread's
};

}  // namespace dibhr
