// Pipes by bare system calls: past this program's own interposed close(), and past the preloaded
// read() and write(), whose locks would count as the driver's time.
#include "tests/device/falcon/poll_pipe.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>

namespace dibhr::test::falcon {

namespace {

constexpr int kOnePage = 4096;  // one page holds one write: full after one byte

}  // namespace

PollPipe::PollPipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC) != 0) return;
    read_end_ = ends[0];
    write_end_ = ends[1];
    fcntl(write_end_, F_SETPIPE_SZ, kOnePage);
    not_ready();
}

PollPipe::~PollPipe() {
    hang_up();
}

void PollPipe::ready() noexcept {
    std::array<char, kOnePage> bytes;  // all that a full pipe holds
    if (read_end_ >= 0) syscall(SYS_read, read_end_, bytes.data(), bytes.size());
}

void PollPipe::not_ready() noexcept {
    const char byte = 0;
    // Without a reader the write would raise SIGPIPE; when the pipe is full it changes nothing.
    if (read_end_ >= 0) syscall(SYS_write, write_end_, &byte, 1);
}

void PollPipe::hang_up() noexcept {
    if (read_end_ >= 0) syscall(SYS_close, read_end_);
    read_end_ = -1;
}

}  // namespace dibhr::test::falcon
