// Cancels a file dialog from another thread than the one that waits for its answer.
#pragma once

namespace dibhr {

/// Shared by the thread that cancels and the thread that waits. For any thread.
class Cancellation {
  public:
    Cancellation();
    ~Cancellation();
    Cancellation(const Cancellation&) = delete;
    Cancellation& operator=(const Cancellation&) = delete;

    /// Cannot be undone.
    void cancel() const noexcept;
    [[nodiscard]] bool is_cancelled() const noexcept;

    /// Readable after cancel(), so that a poll() can wait for it. Negative: too many files are
    /// open, and is_cancelled() is always true.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  private:
    int descriptor_;
};

}  // namespace dibhr
