// Waits for a signal or the display's end, and then for the program.
#include "app/window/ending.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace dibhr {

Ending::Ending(LastWords& words) : words_(words), told_(eventfd(0, EFD_CLOEXEC)) {
    if (told_ < 0) {
        throw DeviceError(std::string("the thread for signals cannot be made (") +
                          std::strerror(errno) + "): close other programs");
    }
    thread_ = std::thread([this] { run(); });
}

Ending::~Ending() {
    over_ = true;
    eventfd_write(told_, 1);
    thread_.join();
    close(told_);
}

void Ending::watch_display(int connection) {
    display_ = connection;
    eventfd_write(told_, 1);
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
        int display = display_;
        std::array<pollfd, 3> ready{
            {{told_, POLLIN, 0}, {signals_.descriptor(), POLLIN, 0}, {display, POLLRDHUP, 0}}};
        poll(ready.data(), ready.size(), timeout_ms);
        if (over_) return;
        if (eventfd_t times = 0; ready[0].revents != 0) eventfd_read(told_, &times);
        // Unless another one, or none, is to be watched by now.
        if (ready[2].revents != 0 && display_.compare_exchange_strong(display, -1))
            without_force_ = true;
        if (!signals_.arrived()) continue;
        const auto now = Clock::now();
        again = asked_ && now >= another_from;
        if (!asked_) {
            patient_until = now + kPatience;
            another_from = now + kOneWish;
        }
        without_force_ = true;
        asked_ = true;
    }
    words_.tell({again ? "asked twice to end" : "asked to end", ", but hung while ",
                 words_.what_is_done(), "; the force is off, ended at once"});
    _exit(EXIT_FAILURE);
}

}  // namespace dibhr
