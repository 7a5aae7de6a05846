// Records made-up ticks until it is killed: session_child FILE COUNTERS TICKS_PER_MS FLUSH.
// COUNTERS is a file of Counters, by which the test follows the progress. FLUSH sets how a flush of
// the disk behaves once ticks come: "works", "hangs" for ever, "fails", or the milliseconds that it
// takes. Prints why the recording stopped, if it does.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <thread>

#include "core/session/recorder.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_child.hpp"
#include "tests/core/session/session_folder.hpp"

namespace {

enum class Flush { works, hangs, fails };
std::atomic<Flush> flush{Flush::works};
std::atomic<int> flush_ms{0};

}  // namespace

/// In place of the C library's: SQLite flushes through it.
extern "C" int fdatasync(int file) {
    while (flush == Flush::hangs) ::pause();
    if (flush == Flush::fails) {
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
        ::mmap(nullptr, sizeof(test::Counters), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file < 0 || memory == MAP_FAILED) return 1;
    auto& counters = *static_cast<test::Counters*>(memory);
    const int per_ms = std::atoi(arguments[3]);
    const std::string_view disk = arguments[4];

    test::MovingSurface surface;
    test::Exploration hand(surface);
    const auto ring = std::make_unique<TickRing>();
    // At the loop's rate: many times as fast, five algorithms take more than a core.
    test::FeltMovingSurface felt(surface);
    const RecordedSurface stored{per_ms == 1 ? &felt : nullptr};
    Recorder recorder(arguments[1], *ring, {}, nullptr, std::chrono::steady_clock::now, stored);
    recorder.parameters(hand.parameters);
    recorder.media(1, "colour.mp4", "depth.mp4");
    flush_ms = std::atoi(arguments[4]);
    flush = disk == "hangs" ? Flush::hangs : disk == "fails" ? Flush::fails : Flush::works;
    auto deadline = std::chrono::steady_clock::now();
    for (RecorderStatus status; status.failure.empty(); status = recorder.status()) {
        counters.kept = static_cast<std::int64_t>(status.rows);
        for (int k = 0; k < per_ms; ++k) {
            test::push(*ring, hand.next());
            ++counters.pushed;
        }
        deadline += std::chrono::milliseconds(1);
        std::this_thread::sleep_until(deadline);
    }
    std::puts(recorder.status().failure.c_str());
    return 1;
}
