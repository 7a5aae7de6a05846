// An eventfd, because the waiting thread waits in poll().
#include "app/desktop/cancellation.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace dibhr {

Cancellation::Cancellation() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

Cancellation::~Cancellation() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void Cancellation::cancel() const noexcept {
    if (descriptor_ >= 0) ::eventfd_write(descriptor_, 1);
}

bool Cancellation::is_cancelled() const noexcept {
    if (descriptor_ < 0) return true;
    pollfd event{descriptor_, POLLIN, 0};
    return ::poll(&event, 1, 0) > 0;
}

}  // namespace dibhr
