// Unix stream sockets.
#include "tests/device/falcon/line_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <utility>

namespace dibhr::test::falcon {

namespace {

class Socket {
  public:
    explicit Socket(int descriptor) noexcept : descriptor_(descriptor) {}
    ~Socket() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Socket& operator=(Socket&&) = delete;

    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

    /// Waits for something to read or accept; false when asked to stop.
    [[nodiscard]] bool readable(const std::stop_token& stop) const {
        constexpr int kLookAgain_ms = 50;
        while (!stop.stop_requested()) {
            pollfd poll_one{descriptor_, POLLIN, 0};
            if (::poll(&poll_one, 1, kLookAgain_ms) > 0) return true;
        }
        return false;
    }

    /// The next line without its end; nothing when the other side has gone, or when asked to stop.
    std::optional<std::string> read_line(const std::stop_token& stop) {
        for (;;) {
            if (const auto end = read_.find('\n'); end != std::string::npos) {
                std::string line = read_.substr(0, end);
                read_.erase(0, end + 1);
                return line;
            }
            if (!readable(stop)) return std::nullopt;
            std::array<char, 512> bytes{};
            const ssize_t size = ::read(descriptor_, bytes.data(), bytes.size());
            if (size <= 0) return std::nullopt;
            read_.append(bytes.data(), static_cast<std::size_t>(size));
        }
    }

    [[nodiscard]] bool write_line(std::string line) const {
        line += '\n';
        return ::send(descriptor_, line.data(), line.size(), MSG_NOSIGNAL) ==
               static_cast<ssize_t>(line.size());
    }

  private:
    int descriptor_;
    std::string read_{};
};

Socket new_socket() {
    return Socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
}

template <typename Call>
bool with_address(const Socket& socket, const std::string& path, Call call) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) throw std::runtime_error("too long: " + path);
    path.copy(static_cast<char*>(address.sun_path), path.size());
    return call(socket.descriptor(), reinterpret_cast<const sockaddr*>(&address),
                socklen_t{sizeof address}) == 0;
}

void serve(const std::stop_token& stop, const Socket& listening, const LineServer::Answer& answer) {
    while (listening.readable(stop)) {
        Socket caller(::accept4(listening.descriptor(), nullptr, nullptr, SOCK_CLOEXEC));
        if (caller.descriptor() < 0) return;
        while (const auto line = caller.read_line(stop)) {
            if (!caller.write_line(answer(*line))) break;
        }
    }
}

}  // namespace

LineServer::LineServer(const std::string& path, Answer answer) : path_(path) {
    Socket listening = new_socket();
    ::unlink(path.c_str());
    constexpr int kCallers = 8;
    if (!with_address(listening, path, ::bind) || ::listen(listening.descriptor(), kCallers) != 0) {
        throw std::runtime_error("cannot listen on " + path + ": " + std::strerror(errno));
    }
    thread_ = std::jthread([socket = std::move(listening), served = std::move(answer)](
                               const std::stop_token& stop) { serve(stop, socket, served); });
}

LineServer::~LineServer() {
    ::unlink(path_.c_str());
}

std::string ask_line(const std::string& path, const std::string& line,
                     const std::function<bool()>& patient) {
    for (;;) {
        Socket socket = new_socket();
        if (with_address(socket, path, ::connect)) {
            std::optional<std::string> answer;
            if (socket.write_line(line)) answer = socket.read_line({});
            return answer.value_or("error: the program has ended");
        }
        if (!patient()) return "error: no one listens on " + path;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace dibhr::test::falcon
