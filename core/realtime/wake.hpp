// A way for any thread, also the haptic one, to end the poll() of another.
#pragma once

#include <chrono>

namespace dibhr {

/// An eventfd with which one thread ends the poll() of another.
class Wake {
  public:
    /// Throws DeviceError when the system has none left.
    Wake();
    ~Wake();
    Wake(const Wake&) = delete;
    Wake& operator=(const Wake&) = delete;

    /// Any thread; one system call that never waits.
    void signal() const noexcept;
    /// For the waiting thread: resets the signals so far.
    void clear() const noexcept;
    /// For the waiting thread: returns at a signal, or at this time; the signals are then reset.
    void wait_until(std::chrono::steady_clock::time_point until) const noexcept;
    /// Readable after a signal.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  private:
    int descriptor_{-1};
};

}  // namespace dibhr
