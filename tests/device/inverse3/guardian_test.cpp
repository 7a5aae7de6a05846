// What the service receives after a pressing program has died, or while it is stopped. The times of
// the guardian's packets are tested on simulated time (../hand/guardian_test.cpp).
#include "device/hand/guardian.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "device/inverse3/service_link.hpp"
#include "device/inverse3/service_request.hpp"
#include "device/inverse3/simulated/service.hpp"
#include "tests/device/pressing_process.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::inverse3;
using simulated::ReceivedMessage;
using std::chrono::milliseconds;
using test::eventually;
using test::kWaysToDie;
using test::PressingProcess;

bool is_zero(const ReceivedMessage& one) {
    return one.force_newton == Vec3(0.0);
}

bool presses(const ReceivedMessage& one) {
    return glm::length(one.force_newton) > 0.9;
}

/// With a service whose motors hold a force for ever.
class Pressing : public PressingProcess {
  public:
    explicit Pressing(const std::string& way) {
        service.with([](simulated::Scene& scene) { scene.behaviour.force_held = milliseconds(0); });
        begin({PRESSING_PROGRAM, way, file("moment").string(), std::to_string(service.port())});
    }

    double end_begins() {
        return PressingProcess::end_begins([this] { return forces_after(0.0) > 0; });
    }
    /// What drives, from then on.
    [[nodiscard]] std::vector<ReceivedMessage> after(double t_s) const {
        std::vector<ReceivedMessage> later = service.received();
        std::erase_if(later,
                      [&](const ReceivedMessage& one) { return !one.drives || at_s(one) <= t_s; });
        return later;
    }
    [[nodiscard]] std::ptrdiff_t forces_after(double t_s) const {
        return std::ranges::count_if(after(t_s), presses);
    }
    [[nodiscard]] std::ptrdiff_t zeros_after(double t_s) const {
        return std::ranges::count_if(after(t_s), is_zero);
    }
    /// Once there have been so many, and no force between them.
    [[nodiscard]] bool is_let_go_by(std::ptrdiff_t zeros) const {
        return eventually(
            [&] {
                const std::vector<ReceivedMessage> received = after(0.0);
                return std::find_if(received.rbegin(), received.rend(), presses) -
                           received.rbegin() >=
                       zeros;
            },
            kPatience);
    }
    [[nodiscard]] double felt_newton() {
        return service.with(
            [](simulated::Scene& scene) { return glm::length(scene.arms[0].force_newton); });
    }
    static double at_s(const ReceivedMessage& one) {
        return std::chrono::duration<double>(one.at.time_since_epoch()).count();
    }

    simulated::Service service{};
};

/// Time of the first zero force, after which all forces are zero [s].
double let_go(const std::vector<ReceivedMessage>& received) {
    const auto first = std::ranges::find_if(received, is_zero);
    REQUIRE(first != received.end());
    CHECK(std::all_of(first, received.end(), is_zero));
    return Pressing::at_s(*first);
}

}  // namespace

TEST_CASE("however a program dies while it presses, the last that the service hears are five zeros",
          "[guardian]") {
    const auto way = GENERATE(from_range(std::begin(kWaysToDie), std::end(kWaysToDie)));
    CAPTURE(way.name);
    Pressing pressing(way.name);
    const double died_s = pressing.end_begins();
    CHECK(pressing.ended() == way.code);
    INFO(pressing.errors());
    CHECK(pressing.its_guardian_ends());
    CHECK(
        eventually([&] { return pressing.zeros_after(died_s) >= 5; }, PressingProcess::kPatience));
    CHECK(pressing.is_let_go_by(5));
    CHECK(pressing.felt_newton() == 0.0);
    CHECK(pressing.service.not_understood() == 0);
}

TEST_CASE(
    "a program that is stopped in mid-touch is without force, and connects anew when it goes on",
    "[guardian]") {
    Pressing pressing("stop");
    (void)pressing.end_begins();
    CHECK(pressing.guardian() > 0);
    REQUIRE(pressing.is_let_go_by(5));
    CHECK(pressing.felt_newton() == 0.0);
    const auto connections = pressing.service.connections();
    const double goes_on_s = Pressing::at_s(pressing.after(0.0).back());
    ::kill(pressing.program(), SIGCONT);
    REQUIRE(eventually([&] { return pressing.forces_after(goes_on_s) > 20; },
                       PressingProcess::kPatience));
    CHECK(pressing.service.connections() > connections);
    pressing.go_on();
    CHECK(pressing.ended() == 0);
    CHECK(pressing.errors().empty());
    CHECK(pressing.its_guardian_ends());
    const std::vector<ReceivedMessage> later = pressing.after(goes_on_s);
    CHECK(is_zero(later.back()));
    // The zero that ends the old connection comes first, or after the one force whose message was
    // being sent when the program was stopped.
    const auto zero = std::ranges::find_if(later, is_zero);
    CHECK(zero - later.begin() <= 1);
}

TEST_CASE("a program whose guardian was killed lets go, and presses with another guardian",
          "[guardian]") {
    Pressing pressing("leave");
    (void)pressing.end_begins();
    const pid_t first = pressing.guardian();
    const double killed_s = Pressing::at_s(pressing.after(0.0).back());
    REQUIRE(::kill(first, SIGKILL) == 0);
    REQUIRE(
        eventually([&] { return pressing.zeros_after(killed_s) > 0; }, PressingProcess::kPatience));
    const std::vector<ReceivedMessage> later = pressing.after(killed_s);
    const double let_go_s = Pressing::at_s(*std::ranges::find_if(later, is_zero));
    WARN("Inverse3, guardian killed: zero force after " << let_go_s - killed_s << " s");
    REQUIRE(eventually([&] { return pressing.forces_after(let_go_s) > 20; },
                       PressingProcess::kPatience));
    CHECK(pressing.guardian() != first);
    REQUIRE(::kill(pressing.program(), SIGKILL) == 0);
    CHECK(pressing.ended() == 128 + SIGKILL);
    CHECK(pressing.is_let_go_by(5));
    CHECK(pressing.its_guardian_ends());
}

TEST_CASE("an alarm takes the force off for good, though the program goes on", "[guardian]") {
    Pressing pressing("alarm");
    (void)pressing.end_begins();
    REQUIRE(pressing.is_let_go_by(5));
    const double let_go_s = Pressing::at_s(pressing.after(0.0).back());
    pressing.go_on();
    CHECK(pressing.ended() == 0);
    CHECK(pressing.forces_after(let_go_s) == 0);
}

TEST_CASE("a service hears zero 0.1 s after a program has died, and 0.2 s after it was stopped",
          "[guardian][realtime]") {
    const auto way = GENERATE(from_range(std::begin(kWaysToDie), std::end(kWaysToDie)));
    CAPTURE(way.name);
    Pressing pressing(way.name);
    const double died_s = pressing.end_begins();
    CHECK(pressing.ended() == way.code);
    CHECK(pressing.its_guardian_ends());
    const double taken_s = let_go(pressing.after(died_s)) - died_s;
    WARN("Inverse3, " << way.name << ": zero force after " << taken_s << " s");
    CHECK(taken_s < 0.1);

    Pressing stopped("stop");
    const double stopped_s = stopped.end_begins();
    REQUIRE(eventually([&] { return stopped.zeros_after(stopped_s) >= 5; },
                       PressingProcess::kPatience));
    const double stop_taken_s = let_go(stopped.after(stopped_s)) - stopped_s;
    WARN("Inverse3, stopped: zero force after " << stop_taken_s << " s");
    CHECK(stop_taken_s < 0.2);
}

TEST_CASE("the guardian's farewell is a frame that a service understands, for any device's name",
          "[guardian]") {
    const std::string name =
        GENERATE("049D", "61548", "a \"name\" with \\ and \n in it, of 48 letters..");
    simulated::Service service;
    ServiceLink link(service.port(), ServiceLink::Time::clock::now() + PressingProcess::kPatience);
    for (const ForceDialect dialect : {ForceDialect::vector, ForceDialect::values}) {
        RequestWriter writer;
        const std::string_view zero =
            writer.write({.arm = DeviceId(name), .force_newton = Vec3{0.0}, .dialect = dialect});
        const StopPacket last = link.set_stop_packet(zero);
        REQUIRE(last.size > 6);
        CHECK(last.channel == StopPacket::Channel::stream);
        CHECK(last.bytes[0] == 0x81);
        std::size_t head = 2;
        std::size_t length = last.bytes[1] & 0x7FU;
        CHECK((last.bytes[1] & 0x80U) != 0);
        if (length == 126) {
            length = last.bytes[2] * 256U + last.bytes[3];
            head = 4;
        }
        REQUIRE(last.size == head + 4 + length);
        std::string text;
        for (std::size_t k = 0; k < length; ++k) {
            text += static_cast<char>(last.bytes[head + 4 + k] ^ last.bytes[head + k % 4]);
        }
        CHECK(text == zero);
        CHECK(service.exchanges() == 0);
    }
}
