// The simulated Inverse Service.
#include "device/inverse3/simulated/service.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <random>

#include "core/error.hpp"
#include "device/inverse3/simulated/frames.hpp"
#include "device/inverse3/simulated/name.hpp"

namespace dibhr::inverse3::simulated {

namespace {

constexpr int kPatience_ms = 20;  // period of the checks whether the service has to end
constexpr std::size_t kMostReceived = 1'000'000;

/// Throws DeviceError.
int listening_socket(std::uint16_t& port) {
    const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const int yes = 1;
    (void)setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    if (bind(descriptor, any, size) != 0 || ::listen(descriptor, 8) != 0 ||
        getsockname(descriptor, any, &size) != 0) {
        const std::string why = std::strerror(errno);
        ::close(descriptor);
        throw DeviceError("the simulated service cannot listen on port " + std::to_string(port) +
                          " (" + why + "): end the program that does, or the real service");
    }
    port = ntohs(address.sin_port);
    return descriptor;
}

/// Receives bytes of the client, for at most kPatience_ms; false: the client has closed.
bool receive(int descriptor, std::string& bytes) {
    pollfd watched{descriptor, POLLIN, 0};
    if (poll(&watched, 1, kPatience_ms) == 0) return true;
    std::array<char, 4096> piece;
    const ssize_t got = recv(descriptor, piece.data(), piece.size(), MSG_DONTWAIT);
    if (got > 0) bytes.append(piece.data(), static_cast<std::size_t>(got));
    return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

bool send_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t gone = send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (gone <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(gone));
    }
    return true;
}

/// The value of a header, whose names are written as Beast writes them.
std::string header(const std::string& head, const std::string& name) {
    const auto at = head.find("\r\n" + name + ": ");
    if (at == std::string::npos) return {};
    const auto begin = at + name.size() + 4;
    return head.substr(begin, head.find("\r\n", begin) - begin);
}

std::string http_answer(const std::string& status, const std::string& body) {
    return "HTTP/1.1 " + status +
           "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) +
           "\r\nConnection: close\r\n\r\n" + body;
}

/// The page for the head of an HTTP request, on the older port or the WebSocket's; empty: no such
/// page.
std::string page_of(const Scene& scene, const std::string& head, bool older) {
    const Behaviour& behaviour = scene.behaviour;
    if (!(older ? behaviour.http_older : behaviour.http_beside)) return {};
    if (head.starts_with("GET /version ")) {
        return R"({"project_name":")" + std::string(kProjectName) + R"(","project_version":")" +
               behaviour.version + "\"}";
    }
    for (const Arm& arm : scene.arms) {
        if (head.starts_with("GET /inverse3/" + arm.id + "/config/gravity_compensation")) {
            return behaviour.gravity_compensation;
        }
    }
    return {};
}

std::string in_fragments(const std::string& text) {
    const std::size_t third = text.size() / 3;
    return frame(text.substr(0, third), {Opcode::text, false}) +
           frame("still there?", {Opcode::ping}) +
           frame(text.substr(third, third), {Opcode::rest, false}) +
           frame(text.substr(2 * third), {Opcode::rest, true});
}

}  // namespace

Service::Service(Scene scene, std::uint16_t port, std::uint16_t older_port)
    : port_(port), older_port_(older_port), scene_(std::move(scene)) {
    listener_ = listening_socket(port_);
    try {
        older_listener_ = listening_socket(older_port_);
    } catch (...) {
        ::close(listener_);
        throw;
    }
    accepting_ = std::thread([this] { accept_clients(); });
}

Service::~Service() {
    ending_ = true;
    accepting_.join();
    reap(true);
    if (listener_ >= 0) ::close(listener_);
    ::close(older_listener_);
}

void Service::drop_clients(Loss how) {
    const std::lock_guard lock(clients_mutex_);
    for (const auto& client : clients_) {
        if (client->done) continue;
        const linger abort{1, 0};
        if (how == Loss::reset) {
            (void)setsockopt(client->descriptor, SOL_SOCKET, SO_LINGER, &abort, sizeof abort);
        }
        client->done = true;  // its thread closes the socket
    }
}

void Service::refuse() {
    listening_ = false;
    while (listener_ >= 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void Service::listen() {
    listening_ = true;
}

std::vector<ReceivedMessage> Service::received() const {
    const std::lock_guard lock(mutex_);
    return received_;
}

void Service::clear_received() {
    const std::lock_guard lock(mutex_);
    received_.clear();
}

void Service::accept_clients() {
    while (!ending_) {
        if (!listening_ && listener_ >= 0) ::close(listener_.exchange(-1));
        if (listening_ && listener_ < 0) listen_again();
        std::array<pollfd, 2> watched{pollfd{listener_, POLLIN, 0},
                                      pollfd{older_listener_, POLLIN, 0}};
        (void)poll(watched.data(), watched.size(), kPatience_ms);
        for (const pollfd& one : watched) {
            if ((one.revents & POLLIN) == 0) continue;
            const int client = accept4(one.fd, nullptr, nullptr, SOCK_CLOEXEC);
            if (client >= 0) take_client(client, one.fd == older_listener_);
        }
        reap(false);
    }
}

void Service::listen_again() {
    try {
        listener_ = listening_socket(port_);
    } catch (const DeviceError&) {
        listener_ = -1;  // another program has the port: the next round tries again
    }
}

void Service::take_client(int descriptor, bool older) {
    const int yes = 1;
    (void)setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    auto client = std::make_unique<Client>();
    client->descriptor = descriptor;
    Client& there = *client;
    const std::lock_guard lock(clients_mutex_);
    clients_.push_back(std::move(client));
    there.thread = std::thread([this, &there, older] { serve(there, older); });
}

void Service::reap(bool all) {
    std::list<std::unique_ptr<Client>> gone;
    {
        const std::lock_guard lock(clients_mutex_);
        for (auto it = clients_.begin(); it != clients_.end();) {
            const auto here = it++;
            if (all) (*here)->done = true;
            if ((*here)->done) gone.splice(gone.end(), clients_, here);
        }
    }
    for (const auto& client : gone) client->thread.join();
}

void Service::serve(Client& client, bool older) {
    prctl(PR_SET_TIMERSLACK, 1UL);  // for punctual ticks
    if (shake_hands(client, older)) exchange_messages(client);
    ::close(client.descriptor);
    client.done = true;
}

bool Service::shake_hands(Client& client, bool older) {
    while (client.came.find("\r\n\r\n") == std::string::npos) {
        if (client.done || !receive(client.descriptor, client.came)) return false;
    }
    const auto end = client.came.find("\r\n\r\n") + 4;
    const std::string head = client.came.substr(0, end);
    client.came.erase(0, end);
    const std::string key = header(head, "Sec-WebSocket-Key");
    if (!key.empty() && !older) {
        ++connections_;
        return send_all(client.descriptor,
                        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: "
                        "Upgrade\r\nSec-WebSocket-Accept: " +
                            accept_of(key) + "\r\n\r\n");
    }
    const std::string body = with([&](const Scene& scene) { return page_of(scene, head, older); });
    (void)send_all(client.descriptor,
                   body.empty()
                       ? http_answer("404 Not Found", R"({"ok":false,"error":"no such page"})")
                       : http_answer("200 OK", body));
    return false;
}

void Service::exchange_messages(Client& client) {
    const bool tells = with([](const Scene& scene) { return scene.behaviour.inventory_at_once; });
    if (tells && !send_all(client.descriptor, answer_bytes(true))) return;
    while (!client.done) {
        const auto came = take_frame(client.came);
        if (!came) {
            if (!receive(client.descriptor, client.came)) return;
        } else if (came->opcode == Opcode::close) {
            (void)send_all(client.descriptor, frame(came->payload, {Opcode::close}));
            return;
        } else if (came->opcode == Opcode::text && !answer(client, came->payload)) {
            return;
        }
    }
}

bool Service::answer(Client& client, const std::string& message) {
    const auto now = Clock::now();
    MessageEffect done;
    Behaviour behaviour;
    {
        const std::lock_guard lock(mutex_);
        done = apply_message(scene_, message, now);
        behaviour = scene_.behaviour;
        if (received_.size() < kMostReceived) {
            received_.push_back(
                {now, done.drives, done.force_newton, done.arm, done.requests_preset});
        }
    }
    if (!done.understood) ++not_understood_;
    const bool wrong = done.wrong_dialect || !done.understood;
    if (wrong && behaviour.on_wrong_dialect == OnWrongDialect::closes) return false;
    wait_before_answer();
    while (!with([](const Scene& scene) { return scene.behaviour.answers; })) {
        if (client.done || ending_) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    count_waiting_message(client);
    ++exchanges_;
    if (wrong && behaviour.on_wrong_dialect == OnWrongDialect::refuses) {
        return send_all(client.descriptor,
                        frame(R"({"ok":false,"error":"set_cursor_force: unknown field"})"));
    }
    return send_all(client.descriptor, answer_bytes(done.requests_whole_state));
}

void Service::wait_before_answer() {
    const Behaviour behaviour = with([](const Scene& scene) { return scene.behaviour; });
    thread_local std::minstd_rand chance{12345};
    auto pause = behaviour.delay;
    if (behaviour.jitter.count() > 0) {
        pause += std::chrono::microseconds(static_cast<std::int64_t>(chance()) %
                                           (behaviour.jitter.count() + 1));
    }
    if (pause.count() > 0) std::this_thread::sleep_for(pause);
    if (behaviour.tick.count() == 0) return;
    const auto since = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - began_);
    const std::chrono::nanoseconds tick = behaviour.tick;
    std::this_thread::sleep_until(began_ + (since / tick + 1) * tick);
}

std::string Service::answer_bytes(bool whole) {
    std::string text;
    Garble garble{};
    {
        const std::lock_guard lock(mutex_);
        const auto now = Clock::now();
        scene_.forget_old_forces(now);
        if (scene_.hand_m && !scene_.arms.empty()) {
            scene_.arms.front().position_m = scene_.hand_m(seconds());
        }
        text = state_text(scene_, whole);
        garble = scene_.behaviour.garble;
    }
    switch (garble) {
        case Garble::none:
            return frame(text);
        case Garble::malformed:
            return frame("{\"inverse3\":[{]}");
        case Garble::cut:
            return frame(text.substr(0, text.size() / 2));
        case Garble::empty:
            return frame("");
        case Garble::megabyte:
            return frame(std::string(1 << 20, ' '));
        case Garble::not_utf8:
            return frame("\xff\xfe");
        case Garble::masked:
            return std::string("\x81\x82\x01\x02\x03\x04zz", 8);
        case Garble::reserved_bits:
            return std::string("\xf1\x02{}", 4);
        case Garble::close_frame:
            return frame("", {Opcode::close});
        case Garble::array:
            return frame("[" + text + "]");
        case Garble::binary:
            return frame(text, {Opcode::binary});
        case Garble::fragments:
            return in_fragments(text);
        case Garble::long_length:
            return frame(text + std::string(70'000, ' '));
        case Garble::two:
            return frame(text) + frame(text);
    }
    return {};
}

void Service::count_waiting_message(Client& client) {
    // Only peeks at the waiting bytes: the message is read when its turn comes.
    std::array<char, 256> piece;
    const ssize_t waits =
        recv(client.descriptor, piece.data(), piece.size(), MSG_DONTWAIT | MSG_PEEK);
    const char first = !client.came.empty() ? client.came.front() : waits > 0 ? piece[0] : '\0';
    if ((static_cast<unsigned char>(first) & 0x0FU) == static_cast<unsigned>(Opcode::text)) {
        ++too_many_;
    }
}

}  // namespace dibhr::inverse3::simulated
