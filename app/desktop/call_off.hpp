// Calls off, from another thread, a question that somebody waits for an answer to.
#pragma once

namespace dibhr {

/// Shared by who asks and who waits. For any thread.
class CallOff {
  public:
    CallOff();
    ~CallOff();
    CallOff(const CallOff&) = delete;
    CallOff& operator=(const CallOff&) = delete;

    /// For good.
    void call_off() const noexcept;
    [[nodiscard]] bool called_off() const noexcept;

    /// Can be read from then on; to be waited for beside others. Negative: too many files are open,
    /// and called_off() is always true.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  private:
    int descriptor_;
};

}  // namespace dibhr
