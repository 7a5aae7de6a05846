// Records made-up ticks until it is killed: session_child FILE COUNTER TICKS_PER_MS. COUNTER is a
// file of eight bytes, through which the test sees how many ticks were pushed.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <thread>

#include "core/session/recorder.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"

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
    auto deadline = std::chrono::steady_clock::now();
    while (recorder.status().failure.empty()) {
        for (int k = 0; k < per_ms; ++k) {
            test::push(*ring, hand.next());
            pushed.fetch_add(1);
        }
        deadline += std::chrono::milliseconds(1);
        std::this_thread::sleep_until(deadline);
    }
    return 1;
}
