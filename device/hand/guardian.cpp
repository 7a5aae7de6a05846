// The guardian process, and the program's requests to it. The process is forked from a program with
// many threads: it takes no lock, allocates nothing, and makes only async-signal-safe calls.
#include "device/hand/guardian.hpp"

#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>
#include <utility>

namespace dibhr {

struct SharedPage {
    std::atomic<std::uint32_t> beats{0};
    std::atomic<std::uint32_t> sent{0};
};

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// ../falcon/README.md, Safety numbers.
constexpr milliseconds kSilentAfter{50};
constexpr milliseconds kCheckPeriod{10};
constexpr milliseconds kSendPeriod{5};
constexpr int kLastPackets = 5;
constexpr unsigned kPacketLimit_ms = 10;
constexpr milliseconds kLingerTimeout{1000};  // for bytes that the stream has not delivered yet
constexpr int kDismissLimit_ms = 100;

// Requests to the guardian; it sends kDismiss back as its answer.
constexpr char kWatch = 'w';
constexpr char kDismiss = 'd';
constexpr char kAlarm = 'a';

struct Message {
    char request{0};
    StopPacket stop_packet{};
};

/// A message in the form of sendmsg() and recvmsg(), with room for one descriptor.
struct Envelope {
    explicit Envelope(Message& message) noexcept : part{&message, sizeof message} {
        head.msg_iov = &part;
        head.msg_iovlen = 1;
        head.msg_control = control.data();
        head.msg_controllen = control.size();
    }
    Envelope(const Envelope&) = delete;
    Envelope& operator=(const Envelope&) = delete;

    void enclose(int descriptor) noexcept {
        cmsghdr* const rights = CMSG_FIRSTHDR(&head);
        rights->cmsg_level = SOL_SOCKET;
        rights->cmsg_type = SCM_RIGHTS;
        rights->cmsg_len = CMSG_LEN(sizeof descriptor);
        std::memcpy(CMSG_DATA(rights), &descriptor, sizeof descriptor);
    }
    void enclose_nothing() noexcept { head.msg_controllen = 0; }
    /// -1: none.
    [[nodiscard]] int enclosed() noexcept {
        int descriptor = -1;
        const cmsghdr* const rights = CMSG_FIRSTHDR(&head);
        if (rights != nullptr) std::memcpy(&descriptor, CMSG_DATA(rights), sizeof descriptor);
        return descriptor;
    }

    iovec part;
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr head{};
};

// Variables of the whole program, because a signal handler has no other way to find the guardians.
// The program's ends of all socket pairs; 0: none.
constexpr std::size_t kMostGuardians = 8;
std::array<std::atomic<int>, kMostGuardians> all_sockets{};
std::atomic<bool> alarm_sounded{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void replace_in_all(int before, int after) noexcept {
    for (auto& socket : all_sockets) {
        int expected = before;
        if (socket.compare_exchange_strong(expected, after)) return;
    }
}

/// The guardian process.
class Watch {
  public:
    Watch(int socket, SharedPage& page) noexcept : socket_(socket), page_(page) {}

    /// Returns after the program has ended and the last packets are sent.
    void run() noexcept {
        while (wait_for_request()) {
            if (file_ < 0) continue;
            check_beats();
            if (sending_) send();
        }
        for (int k = 0; k < kLastPackets && file_ >= 0; ++k) {
            if (k > 0) (void)poll(nullptr, 0, kSendPeriod.count());
            send();
        }
        if (file_ >= 0 && stop_packet_.channel == StopPacket::Channel::stream) linger();
    }

  private:
    /// Sleeps until a request comes or the next check is due; false when the program has ended.
    bool wait_for_request() noexcept {
        const milliseconds period = sending_ ? kSendPeriod : kCheckPeriod;
        pollfd end{socket_, POLLIN, 0};
        if (poll(&end, 1, file_ < 0 ? -1 : static_cast<int>(period.count())) <= 0) return true;
        Message message;
        Envelope envelope(message);
        const ssize_t size = recvmsg(socket_, &envelope.head, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
        if (size == 0) return false;
        if (size < 0) return errno == EAGAIN || errno == EINTR;
        if (message.request == kAlarm) alarmed_ = true;
        if (message.request == kDismiss) {
            release();
            (void)::send(socket_, &message.request, 1, MSG_NOSIGNAL | MSG_DONTWAIT);
        }
        if (message.request == kWatch) {
            release();
            file_ = envelope.enclosed();
            stop_packet_ = message.stop_packet;
            sends_ = 0;
            last_beats_ = page_.beats;
            last_beat_at_ = Clock::now();
        }
        return true;
    }

    void check_beats() noexcept {
        const std::uint32_t beats = page_.beats;
        // Read after the beats: otherwise a pause of this process would look like missing beats.
        const Clock::time_point now = Clock::now();
        if (beats != last_beats_) last_beat_at_ = now;
        last_beats_ = beats;
        const bool arrives = stop_packet_.channel == StopPacket::Channel::stream;
        sending_ = (alarmed_ || now - last_beat_at_ >= kSilentAfter) &&
                   !(arrives && sends_ >= kLastPackets);
    }

    void send() noexcept {
        if (stop_packet_.size == 0) return;
        page_.sent.fetch_add(1);
        ++sends_;
        if (stop_packet_.channel == StopPacket::Channel::usb) {
            send_by_usb();
        } else {
            send_by_stream();
        }
    }

    /// The kernel sends it after what is still in the program's queue.
    void send_by_usb() noexcept {
        usbdevfs_bulktransfer transfer{};
        transfer.ep = stop_packet_.endpoint;
        transfer.len = stop_packet_.size;
        transfer.timeout = kPacketLimit_ms;
        transfer.data = stop_packet_.bytes.data();
        if (ioctl(file_, USBDEVFS_BULK, &transfer) < 0 && errno == ENODEV) release();  // unplugged
    }

    /// Without room for the whole packet, a part of it would spoil the next one: the connection is
    /// closed instead, so that the other end notices.
    void send_by_stream() noexcept {
        discard_answers();
        const ssize_t gone = ::send(file_, stop_packet_.bytes.data(), stop_packet_.size,
                                    MSG_NOSIGNAL | MSG_DONTWAIT);
        if (gone == stop_packet_.size || (gone < 0 && errno == EINTR)) return;
        (void)shutdown(file_, SHUT_RDWR);
        release();
    }

    /// False: the stream has ended.
    bool discard_answers() noexcept {
        std::array<char, 4096> unread;
        ssize_t got = 0;
        while ((got = recv(file_, unread.data(), unread.size(), MSG_DONTWAIT)) > 0) {
        }
        return got < 0 && (errno == EAGAIN || errno == EINTR);
    }

    /// Closing a socket that has unread bytes would discard what was sent: reads until the end.
    void linger() noexcept {
        (void)shutdown(file_, SHUT_WR);
        const Clock::time_point end = Clock::now() + kLingerTimeout;
        while (discard_answers() && Clock::now() < end) {
            pollfd other{file_, POLLIN, 0};
            (void)poll(&other, 1, static_cast<int>(kSendPeriod.count()));
        }
    }

    void release() noexcept {
        if (file_ >= 0) close(file_);
        file_ = -1;
        sending_ = false;
    }

    int socket_;
    SharedPage& page_;
    int file_{-1};  // of the device; -1: no device to guard
    StopPacket stop_packet_{};
    int sends_{0};  // packets sent since kWatch
    std::uint32_t last_beats_{0};
    Clock::time_point last_beat_at_{};  // when the count of beats changed last
    bool alarmed_{false};
    bool sending_{false};
};

/// The memory of this program's arguments, which `ps` shows (proc_pid_stat(5), fields 48 and 49);
/// empty: not known. To be read before the fork: a library interposed before libc's open() (as
/// umockdev's) may hold a lock in another thread during the fork.
std::span<char> arguments_of_program() noexcept {
    std::array<char, 1024> text{};
    const int file = open("/proc/self/stat", O_RDONLY | O_CLOEXEC);
    const ssize_t length = file >= 0 ? read(file, text.data(), text.size() - 1) : 0;
    if (file >= 0) close(file);
    const char* field = length > 0 ? std::strrchr(text.data(), ')') : nullptr;
    constexpr int kFromNameToBegin = 46;
    for (int k = 0; field != nullptr && k < kFromNameToBegin; ++k)
        field = std::strchr(field + 1, ' ');
    if (field == nullptr) return {};
    char* rest = nullptr;
    const auto begin = std::strtoull(field, &rest, 10);
    const auto end = std::strtoull(rest, nullptr, 10);
    constexpr unsigned long long kMost = 1U << 21U;  // that a program is given
    if (begin == 0 || end <= begin || end - begin > kMost) return {};
    return {reinterpret_cast<char*>(begin), end - begin};
}

/// So that `pkill -f` with the program's name does not find this process; changes only its copy.
void rename_arguments(std::span<char> arguments) noexcept {
    if (arguments.empty()) return;
    std::memset(arguments.data(), 0, arguments.size());
    std::memcpy(arguments.data(), Guardian::kProcessName,
                std::min(std::strlen(Guardian::kProcessName), arguments.size() - 1));
}

/// Leaves the program's terminal and process group, ignores the signals that end the program, and
/// closes all descriptors that it inherited.
void detach_from_program(int socket, std::span<char> arguments) noexcept {
    (void)setsid();
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGPIPE}) {
        (void)std::signal(number, SIG_IGN);
    }
    sigset_t none;
    sigemptyset(&none);
    (void)sigprocmask(SIG_SETMASK, &none, nullptr);
    const auto kept = static_cast<unsigned>(socket);
    if (kept > 0) (void)close_range(0, kept - 1, 0);
    (void)close_range(kept + 1, ~0U, 0);
    rename_arguments(arguments);
    (void)prctl(PR_SET_NAME, Guardian::kProcessName);
    const sched_param priority{sched_get_priority_max(SCHED_FIFO) - 1};
    (void)sched_setscheduler(0, SCHED_FIFO, &priority);  // where it is allowed
}

/// Forks twice, so that the guardian is no child of the program, which would have to wait for it.
/// Returns 0, or an errno.
int fork_guardian(int programs_end, int socket, SharedPage& page) noexcept {
    const std::span<char> arguments = arguments_of_program();
    const pid_t between = fork();
    if (between < 0) return errno;
    if (between == 0) {
        const pid_t guardian = fork();
        if (guardian != 0) _exit(guardian < 0 ? errno : 0);
        close(programs_end);  // first of all: it is how the program's end is noticed
        detach_from_program(socket, arguments);
        Watch(socket, page).run();
        _exit(0);
    }
    int status = 0;
    while (waitpid(between, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status)) return EINTR;
    return WEXITSTATUS(status);
}

}  // namespace

void StopPacket::set_message(std::span<const std::uint8_t> message) noexcept {
    if (message.size() > kMostBytes) return;
    std::copy(message.begin(), message.end(), bytes.begin());
    size = static_cast<std::uint16_t>(message.size());
}

Guardian::Guardian(std::string device) : device_(std::move(device)) {
    begin();
}

void Guardian::begin() noexcept {
    failed_ = nullptr;
    sent_before_ = 0;
    void* const page = mmap(nullptr, sizeof(SharedPage), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED) return note_failure("memory");
    page_ = new (page) SharedPage;
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        return note_failure("socket");
    }
    const int refused = fork_guardian(ends[0], ends[1], *page_);
    close(ends[1]);
    if (refused != 0) {
        close(ends[0]);
        errno = refused;
        return note_failure("fork");
    }
    socket_ = ends[0];
    replace_in_all(0, socket_);
}

Guardian::~Guardian() {
    if (socket_ >= 0) dismiss();
    detach();
}

void Guardian::detach() noexcept {
    if (socket_ >= 0) {
        replace_in_all(socket_, 0);
        close(socket_);
    }
    socket_ = -1;
    if (page_ != nullptr) (void)munmap(page_, sizeof(SharedPage));
    page_ = nullptr;
}

bool Guardian::died() const noexcept {
    pollfd end{socket_, 0, 0};
    return socket_ >= 0 && poll(&end, 1, 0) == 1 && (end.revents & POLLHUP) != 0;
}

void Guardian::note_failure(const char* step) noexcept {
    failed_ = step;
    error_ = errno;
}

std::string Guardian::fault() const {
    if (failed_ == nullptr) return {};
    return std::string("no guardian process (") + failed_ + ": " + std::strerror(error_) +
           "): if dibhr is killed, only the " + device_ +
           " itself can end the force; close other programs and start dibhr again";
}

bool Guardian::send_message(char request, int descriptor, const StopPacket& stop_packet) noexcept {
    if (socket_ < 0) return false;
    Message message{request, stop_packet};
    Envelope envelope(message);
    if (descriptor >= 0) {
        envelope.enclose(descriptor);
    } else {
        envelope.enclose_nothing();
    }
    if (sendmsg(socket_, &envelope.head, MSG_NOSIGNAL | MSG_DONTWAIT) > 0) return true;
    note_failure("it has ended");
    return false;
}

void Guardian::watch(int descriptor, const StopPacket& stop_packet) noexcept {
    if (socket_ < 0 || died()) {
        detach();
        begin();
    }
    beat();
    if (descriptor >= 0) {
        (void)send_message(kWatch, descriptor, stop_packet);
    } else if (socket_ >= 0) {
        errno = EBADF;
        note_failure("the device's open file is not known");
    }
}

void Guardian::dismiss() noexcept {
    if (!send_message(kDismiss)) return;
    const auto end = Clock::now() + milliseconds(kDismissLimit_ms);
    pollfd answer{socket_, POLLIN, 0};
    while (poll(&answer, 1, kDismissLimit_ms) < 0 && errno == EINTR && Clock::now() < end) {
    }
    char request = 0;
    (void)recv(socket_, &request, sizeof request, MSG_DONTWAIT);
    sent_before_ = page_->sent;
}

bool Guardian::has_sent() const noexcept {
    return page_ != nullptr && page_->sent != sent_before_;
}

void Guardian::beat() noexcept {
    if (page_ != nullptr) page_->beats.fetch_add(1);
}

void Guardian::alarm() noexcept {
    const int error = errno;
    alarm_sounded = true;
    const Message message{kAlarm, {}};
    for (const auto& socket : all_sockets) {
        const int end = socket;
        if (end > 0) (void)send(end, &message, sizeof message, MSG_NOSIGNAL | MSG_DONTWAIT);
    }
    errno = error;
}

bool Guardian::alarmed() noexcept {
    return alarm_sounded;
}

}  // namespace dibhr
