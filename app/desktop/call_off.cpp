// An eventfd, because the waiting thread waits in poll().
#include "app/desktop/call_off.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace dibhr {

CallOff::CallOff() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

CallOff::~CallOff() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void CallOff::call_off() const noexcept {
    if (descriptor_ >= 0) ::eventfd_write(descriptor_, 1);
}

bool CallOff::called_off() const noexcept {
    if (descriptor_ < 0) return true;
    pollfd event{descriptor_, POLLIN, 0};
    return ::poll(&event, 1, 0) > 0;
}

}  // namespace dibhr
