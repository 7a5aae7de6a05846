// Cancels a file dialog from another thread than the one that waits for its answer.
#pragma once

namespace dibhr {

/// Shared by the thread that cancels and the thread that waits. For any thread.
class CallOff {
  public:
    CallOff();
    ~CallOff();
    CallOff(const CallOff&) = delete;
    CallOff& operator=(const CallOff&) = delete;

    /// Cannot be undone.
    void call_off() const noexcept;
    [[nodiscard]] bool called_off() const noexcept;

    /// Readable after call_off(), so that a poll() can wait for it. Negative: too many files are
    /// open, and called_off() is always true.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  private:
    int descriptor_;
};

}  // namespace dibhr
