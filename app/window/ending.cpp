// The thread waits for a signal or the loss of the display, then for the end of the program.
#include "app/window/ending.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace dibhr {

bool EndRequests::is_repeated(Time now) noexcept {
    if (first_) return now - *first_ >= kOneRequest;
    first_ = now;
    return false;
}

std::optional<std::chrono::milliseconds> EndRequests::patience_left(Time now) const noexcept {
    using std::chrono::milliseconds;
    if (!first_) return std::nullopt;
    return std::max(std::chrono::ceil<milliseconds>(*first_ + kPatience - now), milliseconds(0));
}

Ending::Ending(LastWords& words) : words_(words), told_(eventfd(0, EFD_CLOEXEC)) {
    if (told_ < 0)
        throw DeviceError(std::string("the thread for signals cannot be made (") +
                          std::strerror(errno) + "): close other programs");
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
    EndRequests requests;
    bool again = false;
    while (!again) {
        int timeout_ms = -1;
        if (const auto left = requests.patience_left(Clock::now())) {
            if (left->count() == 0) break;
            timeout_ms = static_cast<int>(left->count());
        }
        int display = display_;
        std::array<pollfd, 3> ready{
            {{told_, POLLIN, 0}, {signals_.descriptor(), POLLIN, 0}, {display, POLLRDHUP, 0}}};
        poll(ready.data(), ready.size(), timeout_ms);
        if (over_) return;
        if (eventfd_t times = 0; ready[0].revents != 0) eventfd_read(told_, &times);
        // Unless watch_display() has replaced the display meanwhile.
        if (ready[2].revents != 0 && display_.compare_exchange_strong(display, -1))
            without_force_ = true;
        if (!signals_.arrived()) continue;
        again = requests.is_repeated(Clock::now());
        without_force_ = true;
        asked_ = true;
    }
    words_.keep_clip();
    words_.tell({again ? "asked twice to end" : "asked to end", ", but hung while ",
                 words_.what_is_done(), "; the force is off, ended at once"});
    _exit(EXIT_FAILURE);
}

}  // namespace dibhr
