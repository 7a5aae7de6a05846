// Ctrl+C and a request to end, handled as a request to close the window, so that the force ends at
// zero.
#pragma once

namespace dibhr {

/// While it lives, SIGINT, SIGTERM, SIGHUP and SIGQUIT do not kill the process and Ctrl+Z does not
/// stop it. Made before any thread is started, since threads inherit what is held back.
class EndingSignals {
  public:
    EndingSignals();
    ~EndingSignals();
    EndingSignals(const EndingSignals&) = delete;
    EndingSignals& operator=(const EndingSignals&) = delete;

    /// Whether one that ends has arrived since the last call.
    [[nodiscard]] bool arrived();
    /// Can be read when one may have arrived; negative: none is held back.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  private:
    int descriptor_{-1};
};

}  // namespace dibhr
