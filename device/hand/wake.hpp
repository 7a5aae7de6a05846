// Lets the haptic thread end a device thread's poll().
#pragma once

namespace dibhr {

/// Lets one thread end another's poll(): an eventfd.
class Wake {
  public:
    /// Throws DeviceError when the system has none left.
    Wake();
    ~Wake();
    Wake(const Wake&) = delete;
    Wake& operator=(const Wake&) = delete;

    /// Any thread; one system call that never waits.
    void signal() const noexcept;
    /// The waiting thread: forgets the signals so far.
    void clear() const noexcept;
    /// Readable after a signal.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  private:
    int descriptor_{-1};
};

}  // namespace dibhr
