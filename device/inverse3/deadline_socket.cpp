// A TCP connection to this machine with deadlines.
#include "device/inverse3/deadline_socket.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <utility>

namespace dibhr::inverse3 {

namespace {

using Time = DeadlineSocket::Time;

std::error_code last_error() noexcept {
    return {errno, std::system_category()};
}

constexpr std::uint8_t kCloseFrame = 0x88;  // its first byte (RFC 6455, 5.2)

timespec time_left(Time until) noexcept {
    constexpr std::chrono::nanoseconds kLongest = std::chrono::hours(1);
    const auto now = DeadlineSocket::Clock::now();
    const auto left = std::clamp<std::chrono::nanoseconds>(
        until < now ? std::chrono::nanoseconds(0)
                    : std::min<std::chrono::nanoseconds>(until - now, kLongest),
        std::chrono::nanoseconds(0), kLongest);
    return {static_cast<time_t>(left.count() / 1'000'000'000),
            static_cast<long>(left.count() % 1'000'000'000)};
}

}  // namespace

std::error_code DeadlineSocket::connect(std::uint16_t port) noexcept {
    close();
    descriptor_ = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (descriptor_ < 0) return last_error();
    const int yes = 1;
    // If this fails, messages are only delayed.
    (void)setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
        return {};
    }
    if (errno != EINPROGRESS) return last_error();
    if (const std::error_code late = wait_for(POLLOUT)) return late;
    int failure = 0;
    socklen_t size = sizeof failure;
    if (getsockopt(descriptor_, SOL_SOCKET, SO_ERROR, &failure, &size) != 0) return last_error();
    return {failure, std::system_category()};
}

std::size_t DeadlineSocket::read(std::span<std::uint8_t> into, std::error_code& error) noexcept {
    error.clear();
    while (from_ == to_) {
        const ssize_t got = recv(descriptor_, came_.data(), came_.size(), 0);
        if (got == 0) return 0;
        if (got > 0) {
            from_ = 0;
            to_ = static_cast<std::size_t>(got);
        } else if (errno == EAGAIN || errno == EINTR) {
            if ((error = wait_for(POLLIN))) return 0;
        } else {
            error = last_error();
            return 0;
        }
    }
    const std::size_t taken = std::min(into.size(), to_ - from_);
    std::copy_n(came_.data() + from_, taken, into.data());
    from_ += taken;
    return taken;
}

std::size_t DeadlineSocket::write(std::span<const iovec> parts, std::error_code& error) noexcept {
    error.clear();
    std::size_t all = 0;
    for (const iovec& part : parts) all += part.iov_len;
    const bool closes = whole_ && !parts.empty() && parts.front().iov_len > 0 &&
                        *static_cast<const std::uint8_t*>(parts.front().iov_base) == kCloseFrame;
    if (closes && !send_stop_packet()) {  // then the guardian has to send it
        error = std::make_error_code(std::errc::no_buffer_space);
        return 0;
    }
    msghdr message{};
    message.msg_iov = const_cast<iovec*>(parts.data());  // sendmsg() only reads it
    message.msg_iovlen = parts.size();
    for (;;) {
        const ssize_t gone = sendmsg(descriptor_, &message, MSG_NOSIGNAL);
        if (gone >= 0) {
            whole_ = static_cast<std::size_t>(gone) == all;
            return static_cast<std::size_t>(gone);
        }
        if (errno == EAGAIN || errno == EINTR) {
            if ((error = wait_for(POLLOUT))) return 0;
        } else {
            error = last_error();
            return 0;
        }
    }
}

void DeadlineSocket::set_stop_packet(std::span<const std::uint8_t> frame) noexcept {
    stop_packet_size_ = frame.size() <= stop_packet_.size() ? frame.size() : 0;
    std::copy_n(frame.begin(), stop_packet_size_, stop_packet_.begin());
}

bool DeadlineSocket::send_stop_packet() noexcept {
    const std::size_t size = std::exchange(stop_packet_size_, 0);
    if (descriptor_ < 0 || size == 0) return true;
    // Behind a partial frame, this frame would be taken for its rest.
    return whole_ && send(descriptor_, stop_packet_.data(), size, MSG_NOSIGNAL | MSG_DONTWAIT) ==
                         static_cast<ssize_t>(size);
}

void DeadlineSocket::close() noexcept {
    (void)send_stop_packet();
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    from_ = to_ = 0;
    whole_ = true;
}

bool DeadlineSocket::wait_readable(const Wake* wake, Time until) const noexcept {
    if (from_ != to_) return true;
    std::array<pollfd, 2> watched{pollfd{descriptor_, POLLIN, 0},
                                  pollfd{wake != nullptr ? wake->descriptor() : -1, POLLIN, 0}};
    const timespec left = time_left(until);
    if (ppoll(watched.data(), watched.size(), &left, nullptr) <= 0) return false;
    if (watched[1].revents != 0) wake->clear();
    return watched[0].revents != 0;
}

std::error_code DeadlineSocket::wait_for(short events) const noexcept {
    pollfd watched{descriptor_, events, 0};
    for (;;) {
        const timespec left = time_left(deadline_);
        const int ready = ppoll(&watched, 1, &left, nullptr);
        if (ready > 0) return {};
        if (ready == 0) return std::make_error_code(std::errc::timed_out);
        if (errno != EINTR) return last_error();
    }
}

}  // namespace dibhr::inverse3
