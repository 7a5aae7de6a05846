// Waits for a signal, and then for the program.
#include "app/window/ending.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace dibhr {

Ending::Ending(LastWords& words) : words_(words), over_(eventfd(0, EFD_CLOEXEC)) {
    if (over_ < 0) {
        throw DeviceError(std::string("the thread for signals cannot be made (") +
                          std::strerror(errno) + "): close other programs");
    }
    thread_ = std::thread([this] { run(); });
}

Ending::~Ending() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t told = write(over_, &one, sizeof one);
    thread_.join();
    close(over_);
}

void Ending::run() {
    using Clock = std::chrono::steady_clock;
    pthread_setname_np(pthread_self(), "dibhr-signals");
    Clock::time_point patient_until{};
    Clock::time_point another_from{};
    bool again = false;
    while (!again) {
        int timeout_ms = -1;
        if (asked_) {
            const auto left =
                std::chrono::ceil<std::chrono::milliseconds>(patient_until - Clock::now());
            if (left.count() <= 0) break;
            timeout_ms = static_cast<int>(left.count());
        }
        std::array<pollfd, 2> ready{{{over_, POLLIN, 0}, {signals_.descriptor(), POLLIN, 0}}};
        poll(ready.data(), ready.size(), timeout_ms);
        if (ready[0].revents != 0) return;
        if (!signals_.arrived()) continue;
        const auto now = Clock::now();
        again = asked_ && now >= another_from;
        if (!asked_) {
            patient_until = now + kPatience;
            another_from = now + kOneWish;
        }
        asked_ = true;
    }
    words_.tell({again ? "asked twice to end" : "asked to end", ", but hung while ",
                 words_.what_is_done(), "; the force is off, ended at once"});
    _exit(EXIT_FAILURE);
}

}  // namespace dibhr
