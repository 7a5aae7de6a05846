// The connection to the service, over real sockets.
#include "device/inverse3/service_link.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "device/inverse3/message.hpp"
#include "device/inverse3/simulated/frames.hpp"
#include "device/inverse3/simulated/service.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::inverse3;
using simulated::Garble;
using std::chrono::milliseconds;
using Why = LinkError::Why;

ServiceLink::Time in(milliseconds span) {
    return ServiceLink::Time::clock::now() + span;
}

/// The next message, parsed; fails when none comes.
ServiceMessage next(ServiceLink& link) {
    MessageReader reader;
    ServiceMessage message;
    REQUIRE(link.wait(nullptr, in(milliseconds(2000))));
    CHECK(reader.read(link.read(in(milliseconds(2000))), message));
    return message;
}

template <typename Call>
Why why(Call&& call) {
    try {
        call();
    } catch (const LinkError& error) {
        CHECK_FALSE(std::string(error.what()).empty());
        return error.why();
    }
    FAIL("no LinkError");
    return Why::lost;
}

/// Shakes hands with one client and sends it these bytes, so many at a time.
class Sender {
  public:
    Sender(std::string bytes, std::size_t at_a_time)
        : listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        auto* const any = reinterpret_cast<sockaddr*>(&address);
        REQUIRE(bind(listener_, any, size) == 0);
        REQUIRE(::listen(listener_, 1) == 0);
        REQUIRE(getsockname(listener_, any, &size) == 0);
        port_ = ntohs(address.sin_port);
        thread_ =
            std::thread([this, sent = std::move(bytes), at_a_time] { serve(sent, at_a_time); });
    }
    ~Sender() {
        thread_.join();
        if (client_ >= 0) ::close(client_);
        ::close(listener_);
    }
    Sender(const Sender&) = delete;
    Sender& operator=(const Sender&) = delete;

    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }

  private:
    static bool wait(int descriptor) {
        pollfd watched{descriptor, POLLIN, 0};
        return poll(&watched, 1, 5000) > 0;
    }
    void send_all(std::string_view bytes) const {
        (void)send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }
    void serve(const std::string& bytes, std::size_t at_a_time) {
        if (!wait(listener_)) return;
        client_ = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
        const int yes = 1;
        (void)setsockopt(client_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        std::string head;
        while (head.find("\r\n\r\n") == std::string::npos) {
            std::array<char, 4096> piece{};
            const ssize_t got = wait(client_) ? recv(client_, piece.data(), piece.size(), 0) : 0;
            if (got <= 0) return;
            head.append(piece.data(), static_cast<std::size_t>(got));
        }
        const std::string name = "Sec-WebSocket-Key: ";
        const std::size_t key = head.find(name) + name.size();
        send_all(
            "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Accept: " +
            simulated::accept_of(head.substr(key, head.find("\r\n", key) - key)) + "\r\n\r\n");
        for (std::size_t at = 0; at < bytes.size(); at += at_a_time) {
            send_all(std::string_view(bytes).substr(at, at_a_time));
        }
    }

    int listener_;
    int client_{-1};
    std::uint16_t port_{0};
    std::thread thread_{};
};

}  // namespace

TEST_CASE("what follows a message stays unread, whatever their lengths, however their bytes come",
          "[inverse3_link]") {
    const auto at_a_time = GENERATE(as<std::size_t>{}, 1, 2, 3, 7, 64, 1'000'000);
    CAPTURE(at_a_time);
    std::vector<std::string> messages{"{}", std::string(300, 'x'), ""};
    for (const std::size_t length : {125U, 126U, 1535U, 1536U, 3000U})
        messages.emplace_back(length, 'y');
    if (at_a_time >= 64) messages.emplace_back(70'000, 'z');
    std::string bytes;
    for (const std::string& message : messages) bytes += simulated::frame(message);
    bytes += simulated::frame("in ", {simulated::Opcode::text, false}) +
             simulated::frame("", {simulated::Opcode::rest, false}) +
             simulated::frame("still there?", {simulated::Opcode::ping}) +
             simulated::frame("fragments", {simulated::Opcode::rest, true});
    messages.emplace_back("in fragments");
    bytes += simulated::frame("last");
    messages.emplace_back("last");

    const Sender sender(bytes, at_a_time);
    ServiceLink link(sender.port(), in(milliseconds(1000)));
    for (const std::string& message : messages) {
        REQUIRE(link.wait(nullptr, in(milliseconds(2000))));
        CHECK(link.read(in(milliseconds(2000))) == message);
    }
    CHECK_FALSE(link.wait(nullptr, in(milliseconds(0))));
}

TEST_CASE("the answer to a key is the one of RFC 6455", "[inverse3_link]") {
    CHECK(simulated::accept_of("dGhlIHNhbXBsZSBub25jZQ==") == "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
}

TEST_CASE("the inventory comes at once, and then one answer a message", "[inverse3_link]") {
    simulated::Service service;
    ServiceLink link(service.port(), in(milliseconds(1000)));
    CHECK(next(link).arms[0].config.has_value());
    for (int k = 0; k < 20; ++k) {
        link.send(R"({"inverse3":[]})", in(milliseconds(1000)));
        CHECK_FALSE(next(link).arms[0].config.has_value());
        CHECK_FALSE(link.wait(nullptr, in(milliseconds(0))));
    }
    CHECK(service.exchanges() == 20);
    link.close(in(milliseconds(200)));
}

TEST_CASE(
    "an answer comes whole in fragments with a ping between them, in a binary frame, and "
    "with a length of 64 bits",
    "[inverse3_link]") {
    simulated::Scene scene;
    scene.behaviour.garble = GENERATE(Garble::fragments, Garble::binary, Garble::long_length);
    simulated::Service service(scene);
    ServiceLink link(service.port(), in(milliseconds(1000)));
    for (int k = 0; k < 3; ++k) {
        CHECK(next(link).arm_count == 1);
        link.send("{}", in(milliseconds(1000)));
    }
    CHECK(next(link).arm_count == 1);
}

TEST_CASE("a message that nobody asked for is seen to wait", "[inverse3_link]") {
    simulated::Scene scene;
    scene.behaviour.garble = Garble::two;
    simulated::Service service(scene);
    ServiceLink link(service.port(), in(milliseconds(1000)));
    CHECK(next(link).arm_count == 1);
    CHECK(link.wait(nullptr, in(milliseconds(0))));
    CHECK(next(link).arm_count == 1);
    CHECK_FALSE(link.wait(nullptr, in(milliseconds(0))));
}

TEST_CASE("two clients have their answers each", "[inverse3_link]") {
    simulated::Service service;
    ServiceLink one(service.port(), in(milliseconds(1000)));
    ServiceLink other(service.port(), in(milliseconds(1000)));
    for (int k = 0; k < 5; ++k) {
        CHECK(next(one).arm_count == 1);
        CHECK(next(other).arm_count == 1);
        one.send("{}", in(milliseconds(1000)));
        other.send("{}", in(milliseconds(1000)));
    }
    CHECK(service.connections() == 2);
    CHECK(service.too_many_in_flight() == 0);
}

TEST_CASE(
    "who does not listen, speaks something else, sends a megabyte, closes or breaks off is "
    "told apart",
    "[inverse3_link]") {
    simulated::Service service;
    SECTION("refused") {
        service.refuse();
        CHECK(why([&] { const ServiceLink link(service.port(), in(milliseconds(1000))); }) ==
              Why::refused);
    }
    SECTION("something else") {
        CHECK(why([&] { const ServiceLink link(service.older_port(), in(milliseconds(1000))); }) ==
              Why::not_the_service);
    }
    SECTION("a megabyte") {
        service.with([](simulated::Scene& scene) { scene.behaviour.garble = Garble::megabyte; });
        ServiceLink link(service.port(), in(milliseconds(1000)));
        REQUIRE(link.wait(nullptr, in(milliseconds(1000))));
        CHECK(why([&] { (void)link.read(in(milliseconds(1000))); }) == Why::too_long);
    }
    SECTION("closed or broken off") {
        const auto how = GENERATE(simulated::Loss::closed, simulated::Loss::reset);
        ServiceLink link(service.port(), in(milliseconds(1000)));
        (void)next(link);
        service.drop_clients(how);
        REQUIRE(link.wait(nullptr, in(milliseconds(1000))));
        CHECK(why([&] { (void)link.read(in(milliseconds(1000))); }) == Why::lost);
    }
}

TEST_CASE("the version is told on either port", "[inverse3_link]") {
    simulated::Service service;
    CHECK(http_get(service.port(), "/version", in(milliseconds(500))).find("3.5.0") !=
          std::string::npos);
    CHECK(http_get(service.older_port(), "/version", in(milliseconds(500))).find("3.5.0") !=
          std::string::npos);
    CHECK(why([&] { (void)http_get(service.port(), "/none", in(milliseconds(500))); }) ==
          Why::not_the_service);
}

TEST_CASE("an exchange allocates nothing", "[inverse3_link]") {
    simulated::Service service;
    ServiceLink link(service.port(), in(milliseconds(1000)));
    MessageReader reader;
    ServiceMessage message;
    int understood = 0;
    const auto exchange = [&] {
        (void)link.wait(nullptr, in(milliseconds(1000)));
        understood += reader.read(link.read(in(milliseconds(1000))), message) ? 1 : 0;
        link.send(R"({"inverse3":[]})", in(milliseconds(1000)));
    };
    exchange();
    const int allocations = test::allocations_in([&] {
        for (int k = 0; k < 200; ++k) exchange();
    });
    CHECK(understood == 201);
    CHECK(allocations == 0);
}
