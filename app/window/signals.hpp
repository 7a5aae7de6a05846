// Ctrl+C and the other shutdown signals, taken as requests to close the window, so that the force
// ends at zero.
#pragma once

namespace dibhr {

/// During its life, SIGINT, SIGTERM, SIGHUP and SIGQUIT do not kill the process and Ctrl+Z does not
/// stop it. Construct it before any thread starts: threads inherit the blocked signals.
class ShutdownSignals {
  public:
    ShutdownSignals();
    ~ShutdownSignals();
    ShutdownSignals(const ShutdownSignals&) = delete;
    ShutdownSignals& operator=(const ShutdownSignals&) = delete;

    /// Whether a shutdown signal has arrived since the last call.
    [[nodiscard]] bool arrived();
    /// Readable when a signal may have arrived; negative: no signal is blocked.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  private:
    int descriptor_{-1};
};

}  // namespace dibhr
