// The connection to the service, over real sockets.
#include "device/inverse3/service_link.hpp"

#include <chrono>
#include <string>
#include <vector>

#include "device/inverse3/frame_bounds.hpp"
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

/// The next message as it is understood; fails when none comes.
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

std::vector<std::size_t> pieces(std::string bytes, std::size_t at_a_time) {
    FrameBounds bounds;
    (void)bounds.take({reinterpret_cast<const std::uint8_t*>("HTTP\r\n\r\n"), 8});
    std::vector<std::size_t> ends;
    std::size_t at = 0;
    while (at < bytes.size()) {
        const std::size_t here = std::min(at_a_time, bytes.size() - at);
        at += bounds.take({reinterpret_cast<const std::uint8_t*>(bytes.data()) + at, here});
        ends.push_back(at);
    }
    return ends;
}

}  // namespace

TEST_CASE("bytes are cut at the end of every frame, whatever its length, however they come",
          "[inverse3_link]") {
    const std::string one = simulated::frame("{}");
    const std::string two = simulated::frame(std::string(300, 'x'));
    const std::string three = simulated::frame("");
    const std::string four = simulated::frame(std::string(70'000, 'y'));
    const std::string all = one + two + three + four + one;
    CHECK(pieces(all, all.size()) ==
          std::vector<std::size_t>{one.size(), one.size() + two.size(),
                                   one.size() + two.size() + three.size(), all.size() - one.size(),
                                   all.size()});
    for (const std::size_t at_a_time : {1U, 2U, 3U, 7U, 64U}) {
        CAPTURE(at_a_time);
        const auto ends = pieces(all, at_a_time);
        for (const std::size_t end : {one.size(), one.size() + two.size(), all.size()}) {
            CHECK(std::find(ends.begin(), ends.end(), end) != ends.end());
        }
    }
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
    scene.manners.garble = GENERATE(Garble::fragments, Garble::binary, Garble::long_length);
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
    scene.manners.garble = Garble::two;
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
        service.with([](simulated::Scene& scene) { scene.manners.garble = Garble::megabyte; });
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
