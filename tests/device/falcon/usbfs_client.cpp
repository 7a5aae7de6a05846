// System calls as messages, by bare system calls: past everything that is preloaded.
#include "tests/device/falcon/usbfs_client.hpp"

#include <linux/ioctl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string_view>

#include "tests/device/falcon/usbfs_call.hpp"

namespace dibhr::test::falcon {

namespace {

/// As often as a signal of the program's comes in between.
template <typename Call>
long insist(Call call) noexcept {
    long result = 0;
    do {
        result = call();
    } while (result < 0 && errno == EINTR);
    return result;
}

bool can_be_reaped(int descriptor) noexcept {
    pollfd file{descriptor, POLLOUT, 0};
    timespec at_once{};
    return syscall(SYS_ppoll, &file, 1, &at_once, nullptr, 0) > 0;
}

/// Bytes of the program's own memory, of a call or an answer.
iovec bytes_at(void* data, std::size_t size) noexcept {
    return {data, std::min(size, kMostTransferBytes)};
}

}  // namespace

/// One of the idle ones, or a new one; idle again afterwards.
class UsbfsClient::Connection {
  public:
    explicit Connection(UsbfsClient& client) noexcept
        : client_(client), process_(static_cast<std::uint32_t>(syscall(SYS_getpid))) {
        for (auto& slot : client_.idle_) {
            const std::uint64_t idle = slot.exchange(0);
            // What the parent process left here is not this one's to use or to close.
            if (idle >> 32U != process_) continue;
            descriptor_ = static_cast<int>(idle & 0xFFFFFFFFU);
            return;
        }
        descriptor_ =
            static_cast<int>(syscall(SYS_socket, AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
        const auto connect = [this] {
            return syscall(SYS_connect, descriptor_, &client_.host_, sizeof client_.host_);
        };
        if (insist(connect) != 0) fail();
    }
    ~Connection() {
        if (descriptor_ < 0) return;
        const std::uint64_t idle =
            std::uint64_t{process_} << 32U | static_cast<unsigned>(descriptor_);
        for (auto& slot : client_.idle_) {
            std::uint64_t none = 0;
            if (slot.compare_exchange_strong(none, idle)) return;
        }
        fail();
    }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// False: the host has gone.
    [[nodiscard]] bool send(UsbfsCall& call, iovec bytes) noexcept {
        std::array<iovec, 2> parts{iovec{&call, sizeof call}, bytes};
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = parts.size();
        const auto send = [&] { return syscall(SYS_sendmsg, descriptor_, &message, MSG_NOSIGNAL); };
        if (insist(send) > 0) return true;
        fail();
        return false;
    }
    /// With the bytes that follow the answer, and the descriptor, if one comes; MSG_PEEK: it will
    /// be received once more.
    [[nodiscard]] bool receive(UsbfsAnswer& answer, iovec bytes, int flags = 0,
                               int* descriptor = nullptr) noexcept {
        std::array<iovec, 2> parts{iovec{&answer, sizeof answer}, bytes};
        alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = parts.size();
        if (descriptor != nullptr) {
            message.msg_control = control.data();
            message.msg_controllen = control.size();
        }
        const auto receive = [&] {
            return syscall(SYS_recvmsg, descriptor_, &message, flags | MSG_CMSG_CLOEXEC);
        };
        if (insist(receive) < static_cast<long>(sizeof answer)) {
            fail();
            return false;
        }
        const cmsghdr* const sent = CMSG_FIRSTHDR(&message);
        if (sent != nullptr) std::memcpy(descriptor, CMSG_DATA(sent), sizeof(int));
        return true;
    }

  private:
    void fail() noexcept {
        if (descriptor_ >= 0) syscall(SYS_close, descriptor_);
        descriptor_ = -1;
    }

    UsbfsClient& client_;
    std::uint32_t process_;
    int descriptor_{-1};
};

UsbfsClient::UsbfsClient(const std::string& socket) {
    host_.sun_family = AF_UNIX;
    if (socket.size() >= sizeof host_.sun_path) throw std::invalid_argument("too long: " + socket);
    socket.copy(static_cast<char*>(host_.sun_path), socket.size());
}

std::optional<int> UsbfsClient::open(const char* path) {
    UsbfsCall call;
    const std::string_view name(path);
    if (name.size() >= call.argument.size()) return std::nullopt;
    std::ranges::copy(name, call.argument.begin());
    Connection host(*this);
    UsbfsAnswer answer;
    int descriptor = -1;
    if (!host.send(call, {}) || !host.receive(answer, {}, 0, &descriptor)) return -ENODEV;
    if (answer.result == UsbfsAnswer::kNotHere) return std::nullopt;
    return answer.result < 0 ? answer.result : descriptor;
}

std::optional<int> UsbfsClient::ioctl(int descriptor, ino_t inode, unsigned long request,
                                      void* argument) {
    UsbfsCall call{.inode = inode, .request = request};
    const std::size_t size = std::min<std::size_t>(_IOC_SIZE(request), call.argument.size());
    const bool about_urb = request == USBDEVFS_DISCARDURB || request == USBDEVFS_REAPURBNDELAY;
    if (!about_urb && size > 0) std::memcpy(call.argument.data(), argument, size);
    call.urb = reinterpret_cast<std::uintptr_t>(argument);
    iovec bytes{};
    if (request == USBDEVFS_SUBMITURB) {
        const auto& urb = *static_cast<const usbdevfs_urb*>(argument);
        bytes = bytes_at(urb.buffer, static_cast<std::size_t>(urb.buffer_length));
    } else if (request == USBDEVFS_BULK) {
        const auto& transfer = *static_cast<const usbdevfs_bulktransfer*>(argument);
        bytes = bytes_at(transfer.data, transfer.len);
    } else if (request == USBDEVFS_REAPURBNDELAY && !can_be_reaped(descriptor)) {
        return -EAGAIN;  // every program asks until there is nothing more
    }
    Connection host(*this);
    UsbfsAnswer answer;
    if (!host.send(call, bytes) || !host.receive(answer, {}, MSG_PEEK)) return -ENODEV;
    if (request == USBDEVFS_REAPURBNDELAY && answer.result == 0) {
        auto* const urb = reinterpret_cast<usbdevfs_urb*>(answer.urb);
        urb->status = answer.status;
        urb->actual_length = answer.length;
        bytes = bytes_at(urb->buffer, static_cast<std::size_t>(urb->buffer_length));
        *static_cast<usbdevfs_urb**>(argument) = urb;
    }
    if (!host.receive(answer, bytes)) return -ENODEV;
    if (answer.result == UsbfsAnswer::kNotHere) return std::nullopt;
    // Another thread may have reaped what was submitted, and have freed it.
    const bool answers_in_argument = !about_urb && bytes.iov_base == nullptr;
    if (answers_in_argument && size > 0) std::memcpy(argument, answer.argument.data(), size);
    return answer.result;
}

}  // namespace dibhr::test::falcon
