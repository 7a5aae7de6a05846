// A file descriptor that polls as usbfs does: writable when a transfer can be reaped, in error when
// the device is gone.
#pragma once

#include <sys/types.h>

#include <array>

namespace dibhr::test::falcon {

/// The write end of a pipe that holds one byte: full is "nothing to reap", empty is POLLOUT, and
/// without a reader it is POLLERR. The pipe knows, as a kernel does, when the last program has
/// closed its end, whoever inherited it or was sent it.
class PollPipe {
  public:
    PollPipe();  ///< nothing to reap
    ~PollPipe();
    PollPipe(const PollPipe&) = delete;
    PollPipe& operator=(const PollPipe&) = delete;

    /// The program's file descriptor; -1 when there was none left. The program closes it.
    [[nodiscard]] int descriptor() const noexcept { return write_end_; }
    /// The same behind every copy of it, in any process.
    [[nodiscard]] ino_t inode() const noexcept { return inode_; }
    void ready() noexcept;
    void not_ready() noexcept;
    void hang_up() noexcept;
    /// Nobody has the program's end any more; after hang_up(): nobody had it then.
    [[nodiscard]] bool abandoned() const noexcept;

  private:
    int read_end_{-1};
    int write_end_{-1};
    ino_t inode_{0};
    std::array<char, 32> path_{};  // of the read end, from which a write end can be opened
    bool was_abandoned_{false};
};

/// Of the pipe behind a descriptor; 0 when it is none. Async-signal-safe.
[[nodiscard]] ino_t inode_of_pipe(int descriptor) noexcept;

}  // namespace dibhr::test::falcon
