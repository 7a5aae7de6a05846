// A thread a connection.
#include "tests/device/falcon/usbfs_host.hpp"

#include <linux/ioctl.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

#include "tests/device/falcon/usbfs_call.hpp"

namespace dibhr::test::falcon {

namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename Argument>
Argument& argument_of(UsbfsCall& call) {
    return *reinterpret_cast<Argument*>(call.argument.data());
}

void take_back(const UsbfsUrb& ended, UsbfsAnswer& answer, Bytes& bytes) {
    answer.urb = ended.id;
    answer.status = ended.urb.status;
    answer.length = ended.urb.actual_length;
    const auto end = ended.bytes.begin() + static_cast<std::ptrdiff_t>(ended.bytes_back());
    bytes.assign(ended.bytes.begin(), end);
}

/// `bytes`: those that came with the call, then those that go with the answer.
void perform(UsbfsUnit& unit, UsbfsFile& file, UsbfsCall& call, UsbfsAnswer& answer, Bytes& bytes) {
    switch (call.request) {
        case USBDEVFS_SUBMITURB: {
            auto urb = argument_of<usbdevfs_urb>(call);
            urb.buffer = bytes.data();
            urb.buffer_length = static_cast<int>(bytes.size());
            answer.result = unit.submit(file, urb, call.urb);
            bytes.clear();
            return;
        }
        case USBDEVFS_DISCARDURB:
            answer.result = unit.discard(file, call.urb);
            return;
        case USBDEVFS_REAPURBNDELAY: {
            UsbfsUrb ended;
            answer.result = unit.reap(file, ended);
            if (answer.result == 0) take_back(ended, answer, bytes);
            return;
        }
        case USBDEVFS_BULK: {
            auto transfer = argument_of<usbdevfs_bulktransfer>(call);
            transfer.data = bytes.data();
            transfer.len = static_cast<unsigned>(bytes.size());
            answer.result = unit.bulk(file, transfer);
            return;
        }
        default:
            answer.result = unit.ioctl(file, call.request, call.argument.data());
            answer.argument = call.argument;
    }
}

UsbfsAnswer answer_to(UsbfsFiles& files, UsbfsCall& call, Bytes& bytes) {
    UsbfsAnswer answer;
    if (call.inode == 0) {
        call.argument.back() = 0;
        const auto* const node = reinterpret_cast<const char*>(call.argument.data());
        answer.result = files.open(node).value_or(UsbfsAnswer::kNotHere);
        return answer;
    }
    const auto opened = files.find(call.inode, call.request);
    const auto unit = opened == nullptr ? nullptr : opened->unit.lock();
    if (opened == nullptr) {
        answer.result = UsbfsAnswer::kNotHere;
    } else if (unit == nullptr) {
        answer.result = -ENODEV;
    } else {
        perform(*unit, opened->file, call, answer, bytes);
    }
    return answer;
}

void send(int socket, UsbfsAnswer& answer, Bytes& bytes, int descriptor) {
    std::array<iovec, 2> parts{iovec{&answer, sizeof answer}, iovec{bytes.data(), bytes.size()}};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    if (descriptor >= 0) {
        message.msg_control = control.data();
        message.msg_controllen = control.size();
        cmsghdr* const rights = CMSG_FIRSTHDR(&message);
        rights->cmsg_level = SOL_SOCKET;
        rights->cmsg_type = SCM_RIGHTS;
        rights->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(rights), &descriptor, sizeof descriptor);
    }
    static_cast<void>(::sendmsg(socket, &message, MSG_NOSIGNAL));
}

/// Until the program closes its end.
void serve(int socket, UsbfsFiles& files) {
    Bytes bytes;
    for (;;) {
        UsbfsCall call;
        bytes.resize(kMostTransferBytes);
        std::array<iovec, 2> parts{iovec{&call, sizeof call}, iovec{bytes.data(), bytes.size()}};
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = parts.size();
        const ssize_t size = ::recvmsg(socket, &message, 0);
        if (size < static_cast<ssize_t>(sizeof call)) return;
        bytes.resize(static_cast<std::size_t>(size) - sizeof call);
        UsbfsAnswer answer = answer_to(files, call, bytes);
        const bool opened = call.inode == 0 && answer.result >= 0;
        const int descriptor = opened ? answer.result : -1;
        send(socket, answer, bytes, descriptor);
        if (opened) ::close(descriptor);  // the program has it
    }
}

int listen_at(const std::string& path) {
    const int socket = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) throw std::runtime_error("too long: " + path);
    path.copy(static_cast<char*>(address.sun_path), path.size());
    constexpr int kCallers = 64;
    if (::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(socket, kCallers) != 0) {
        throw std::runtime_error("cannot listen on " + path + ": " + std::strerror(errno));
    }
    return socket;
}

}  // namespace

KernelWork::KernelWork() noexcept {
    const sched_param above{sched_get_priority_max(SCHED_FIFO) - 1};
    sched_setscheduler(0, SCHED_FIFO, &above);
}

KernelWork::~KernelWork() {
    const sched_param none{0};
    sched_setscheduler(0, SCHED_OTHER, &none);
}

UsbfsHost::Connection::Connection(int accepted, UsbfsFiles& files)
    : socket(accepted), thread([accepted, &files] {
          serve(accepted, files);
          ::shutdown(accepted, SHUT_RDWR);
      }) {}

UsbfsHost::Connection::~Connection() {
    ::shutdown(socket, SHUT_RDWR);
    thread.join();
    ::close(socket);
}

UsbfsHost::UsbfsHost(const std::string& path, UsbfsFiles& files)
    : files_(files), listening_(listen_at(path)), thread_([this] { accept_all(); }) {}

UsbfsHost::~UsbfsHost() {
    ::shutdown(listening_, SHUT_RDWR);
    thread_.join();
    ::close(listening_);
}

void UsbfsHost::accept_all() {
    for (;;) {
        const int accepted = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
        if (accepted < 0) return;
        connections_.emplace_back(accepted, files_);
    }
}

}  // namespace dibhr::test::falcon
