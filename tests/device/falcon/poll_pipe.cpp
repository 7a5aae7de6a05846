// Pipes by bare system calls: past the preloaded open(), read() and write(), whose locks would
// count as the driver's time.
#include "tests/device/falcon/poll_pipe.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <ctime>

namespace dibhr::test::falcon {

namespace {

constexpr int kOnePage = 4096;  // one page holds one write: full after one byte

void close_bare(int descriptor) noexcept {
    syscall(SYS_close, descriptor);
}

/// When the pipe is full it changes nothing.
void put_byte(int write_end) noexcept {
    const char byte = 0;
    syscall(SYS_write, write_end, &byte, 1);
}

}  // namespace

PollPipe::PollPipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC) != 0) return;
    read_end_ = ends[0];
    write_end_ = ends[1];
    inode_ = inode_of_pipe(read_end_);
    std::snprintf(path_.data(), path_.size(), "/proc/self/fd/%d", read_end_);
    fcntl(write_end_, F_SETPIPE_SZ, kOnePage);
    put_byte(write_end_);
}

PollPipe::~PollPipe() {
    hang_up();
}

void PollPipe::ready() noexcept {
    std::array<char, kOnePage> bytes;  // all that a full pipe holds
    if (read_end_ >= 0) syscall(SYS_read, read_end_, bytes.data(), bytes.size());
}

void PollPipe::not_ready() noexcept {
    if (read_end_ < 0) return;
    if (inode_of_pipe(write_end_) == inode_) {
        put_byte(write_end_);  // the program is this one
        return;
    }
    // A write end of our own for a moment: one that was kept would hide who else has one.
    const auto end = static_cast<int>(
        syscall(SYS_openat, AT_FDCWD, path_.data(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
    if (end < 0) return;
    put_byte(end);
    close_bare(end);
}

void PollPipe::hang_up() noexcept {
    if (read_end_ < 0) return;
    was_abandoned_ = abandoned();
    close_bare(read_end_);
    read_end_ = -1;
}

bool PollPipe::abandoned() const noexcept {
    if (read_end_ < 0) return was_abandoned_;
    pollfd end{read_end_, 0, 0};
    timespec at_once{};
    syscall(SYS_ppoll, &end, 1, &at_once, nullptr, 0);
    return (end.revents & POLLHUP) != 0;
}

ino_t inode_of_pipe(int descriptor) noexcept {
    struct stat status {};
    if (syscall(SYS_fstat, descriptor, &status) != 0 || !S_ISFIFO(status.st_mode)) return 0;
    return status.st_ino;
}

}  // namespace dibhr::test::falcon
