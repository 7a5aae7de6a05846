// A file descriptor that polls as usbfs does: writable when a transfer can be reaped, in error when
// the device is gone.
#pragma once

namespace dibhr::test::falcon {

/// The write end of a pipe that holds one byte: full is "nothing to reap", empty is POLLOUT, and
/// without a reader it is POLLERR.
class PollPipe {
  public:
    PollPipe();  ///< nothing to reap
    ~PollPipe();
    PollPipe(const PollPipe&) = delete;
    PollPipe& operator=(const PollPipe&) = delete;

    /// The program's file descriptor; -1 when there was none left. The program closes it.
    [[nodiscard]] int descriptor() const noexcept { return write_end_; }
    void ready() noexcept;
    void not_ready() noexcept;
    void hang_up() noexcept;

  private:
    int read_end_{-1};
    int write_end_{-1};
};

}  // namespace dibhr::test::falcon
