// Sockets and processes.
#include "tests/core/video/live/senders.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/support/eventually.hpp"

namespace dibhr::test {

namespace {

sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

int bound(int kind, int port) {
    const int made = ::socket(AF_INET, kind | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const sockaddr_in address = loopback(port);
    if (::bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw std::runtime_error("port " + std::to_string(port) + " is taken");
    return made;
}

bool sent_whole(int connection, const void* bytes, std::size_t count) {
    const char* at = static_cast<const char*>(bytes);
    while (count > 0) {
        const auto sent = ::send(connection, at, count, MSG_NOSIGNAL);
        if (sent <= 0) return false;
        at += sent;
        count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool can_be_read(int socket, int for_ms) {
    pollfd wanted{.fd = socket, .events = POLLIN, .revents = 0};
    return ::poll(&wanted, 1, for_ms) > 0;
}

}  // namespace

int free_port() {
    const int made = bound(SOCK_STREAM, 0);
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(made, reinterpret_cast<sockaddr*>(&address), &size);
    ::close(made);
    return ntohs(address.sin_port);
}

/// By the kernel's tables (proc(5)): a TCP socket that listens (0A), a UDP one that is bound (07).
bool comes_to_listen(int port) {
    std::ostringstream local;
    local << ':' << std::uppercase << std::hex << std::setw(4) << std::setfill('0') << port;
    const auto listens = [&](const char* table, const std::string& state) {
        std::ifstream lines(table);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string number;
            std::string here;
            std::string there;
            std::string now;
            words >> number >> here >> there >> now;
            if (here.ends_with(local.str()) && now == state) return true;
        }
        return false;
    };
    return eventually([&] {
        return listens("/proc/net/tcp", "0A") || listens("/proc/net/tcp6", "0A") ||
               listens("/proc/net/udp", "07") || listens("/proc/net/udp6", "07");
    });
}

PictureSender::PictureSender(int port, Asked asked)
    : asked_(std::move(asked)), listener_(bound(SOCK_STREAM, port)) {
    ::listen(listener_, 1);
    thread_ = std::thread([this] { run(); });
}

PictureSender::~PictureSender() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    changed_.notify_all();
    thread_.join();
    ::close(listener_);
}

void PictureSender::stop() {
    std::unique_lock lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return !sends_; });
}

void PictureSender::go_on() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = false;
    }
    changed_.notify_all();
}

int PictureSender::send() {
    std::unique_lock lock(mutex_);
    ++asked_for_;
    changed_.notify_all();
    changed_.wait_for(lock, std::chrono::seconds(60),
                      [this] { return asked_for_ == 0 && !sends_; });
    return sent_;
}

/// Waits for that time, or while it is stopped for send(). False: it leaves.
bool PictureSender::may_send(int k, Clock::time_point when) {
    std::unique_lock lock(mutex_);
    sends_ = false;
    changed_.notify_all();
    for (;;) {
        const auto is_new = [this, was_stopped = stopped_] {
            return leaving_ || stopped_ != was_stopped || (stopped_ && asked_for_ > 0);
        };
        bool due = false;
        if (stopped_)
            changed_.wait(lock, is_new);
        else
            due = !changed_.wait_until(lock, when, is_new);
        if (leaving_) return false;
        if (stopped_ && asked_for_ > 0)
            --asked_for_;
        else if (!due)
            continue;
        sends_ = true;
        sent_ = k;
        return true;
    }
}

void PictureSender::run() {
    while (!leaving_) {
        if (!can_be_read(listener_, 20)) continue;
        const int connection = ::accept(listener_, nullptr, nullptr);
        if (connection < 0) continue;
        const int yes = 1;
        ::setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        serve(connection);
        ::close(connection);
    }
}

void PictureSender::serve(int connection) {
    const std::string head =
        "YUV4MPEG2 W" + std::to_string(asked_.columns) + " H" + std::to_string(asked_.rows) + " F" +
        std::to_string(static_cast<int>(1000.0 * asked_.frames_per_s)) + ":1000 Ip A1:1 Cmono16\n";
    if (!sent_whole(connection, head.data(), head.size())) return;
    const std::string begin = "FRAME\n";
    std::vector<std::uint16_t> picture(static_cast<std::size_t>(asked_.columns) *
                                       static_cast<std::size_t>(asked_.rows));
    const auto start = Clock::now();
    for (int k = 0; !leaving_; ++k) {
        for (std::size_t at = 0; at < picture.size(); ++at)
            picture[at] = asked_.level(k, static_cast<int>(at) % asked_.columns,
                                       static_cast<int>(at) / asked_.columns);
        const std::chrono::duration<double> due(k / asked_.frames_per_s / asked_.clock_rate);
        auto when = start + std::chrono::duration_cast<Clock::duration>(due);
        if (asked_.late) when += asked_.late(k);
        if (!may_send(k, when)) break;
        if (asked_.sent) asked_.sent(k, Clock::now());
        if (!sent_whole(connection, begin.data(), begin.size()) ||
            !sent_whole(connection, picture.data(), 2 * picture.size()))
            break;
    }
    const std::lock_guard lock(mutex_);
    sends_ = false;
    changed_.notify_all();
}

Ffmpeg::Ffmpeg(const std::string& arguments) : child_(::fork()) {
    if (child_ > 0) return;
    const std::string command = "exec ffmpeg -nostdin -v quiet -y " + arguments;
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
}

void Ffmpeg::end() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    child_ = -1;
}

void Ffmpeg::stop() {
    ::kill(child_, SIGSTOP);
}

void Ffmpeg::go_on() {
    ::kill(child_, SIGCONT);
}

Relay::Relay(int from, int to, std::function<int(int)> fate_ms)
    : fate_ms_(std::move(fate_ms)), socket_(bound(SOCK_DGRAM, from)) {
    const int bytes = 4 << 20;
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
    thread_ = std::thread([this, to] { run(to); });
}

Relay::~Relay() {
    leaving_ = true;
    thread_.join();
    ::close(socket_);
}

void Relay::run(int to) {
    using Clock = std::chrono::steady_clock;
    const sockaddr_in address = loopback(to);
    std::multimap<Clock::time_point, std::vector<char>> under_way;
    std::vector<char> datagram(1 << 16);
    for (int number = 0; !leaving_;) {
        if (can_be_read(socket_, 1)) {
            const auto size = ::recv(socket_, datagram.data(), datagram.size(), 0);
            const int late_ms = size > 0 ? fate_ms_(number++) : -1;
            if (late_ms >= 0)
                under_way.emplace(Clock::now() + std::chrono::milliseconds(late_ms),
                                  std::vector<char>(datagram.begin(), datagram.begin() + size));
        }
        while (!under_way.empty() && under_way.begin()->first <= Clock::now()) {
            const std::vector<char>& first = under_way.begin()->second;
            ::sendto(socket_, first.data(), first.size(), 0,
                     reinterpret_cast<const sockaddr*>(&address), sizeof address);
            under_way.erase(under_way.begin());
        }
    }
}

}  // namespace dibhr::test
