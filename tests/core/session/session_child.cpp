// Records made-up ticks until it is killed: session_child FILE COUNTER TICKS_PER_MS FLUSH_MS.
// COUNTER is a file of eight bytes, through which the test sees how many ticks were pushed;
// FLUSH_MS is how long the disk needs for what is to be flushed once ticks come, -1 for a disk
// that fails then. Prints why the recording stopped, if it does.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "core/session/recorder.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"

namespace {

std::atomic<int> flush_ms{0};

}  // namespace

/// In place of the C library's: SQLite flushes through it.
extern "C" int fdatasync(int file) {
    if (flush_ms < 0) {
        errno = EIO;
        return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(flush_ms));
    return static_cast<int>(::syscall(SYS_fdatasync, file));
}

int main(int, char** arguments) {
    using namespace dibhr;
    const int file = ::open(arguments[2], O_RDWR);
    void* const memory =
        ::mmap(nullptr, sizeof(std::int64_t), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file < 0 || memory == MAP_FAILED) return 1;
    auto& pushed = *static_cast<std::atomic<std::int64_t>*>(memory);
    const int per_ms = std::atoi(arguments[3]);

    test::MovingSurface surface;
    test::Exploration hand(surface);
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(arguments[1], *ring, {});
    recorder.parameters(hand.parameters);
    recorder.media(1, "colour.mp4", "depth.mp4");
    flush_ms = std::atoi(arguments[4]);
    auto deadline = std::chrono::steady_clock::now();
    while (recorder.status().failure.empty()) {
        for (int k = 0; k < per_ms; ++k) {
            test::push(*ring, hand.next());
            pushed.fetch_add(1);
        }
        deadline += std::chrono::milliseconds(1);
        std::this_thread::sleep_until(deadline);
    }
    std::puts(recorder.status().failure.c_str());
    return 1;
}
