// Messages of the service, in every form that the sources have, and invalid ones.
#include "device/inverse3/message.hpp"

#include <string>
#include <utility>
#include <vector>

#include "device/inverse3/kept_settings.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::inverse3;
using Catch::Matchers::WithinAbs;

// The Haply documentation's own, shortened as in device/inverse3/README.md.
const std::string kInventory35 =
    R"({"session_id":7,"inverse3":[{"device_id":"049D","config":{"type":"inverse3",)"
    R"("handedness":"right","preset":"defaults","basis":{"permutation":"XYZ"},)"
    R"("gravity_compensation":{"enabled":true}},"state":{"cursor_position":{"x":0.0,"y":-0.12,)"
    R"("z":0.15},"cursor_velocity":{"x":0,"y":0,"z":0},"current_cursor_force":{"x":0,"y":0,)"
    R"("z":1.5}},"status":{"calibrated":true,"in_use":false,"power_supply":true,"ready":true,)"
    R"("started":true}}],"wireless_verse_grip":[{"device_id":"61548","state":{"orientation":)"
    R"({"w":1,"x":0,"y":0,"z":0},"buttons":{"a":false,"b":true,"c":false},"battery_level":0.8},)"
    R"("status":{"connected":true,"awake":true,"ready":true}}]})";

const std::string kState31 =
    R"({"inverse3":[{"status":{"calibrated":true,"power_supply":true,"in_use":false},)"
    R"("state":{"cursor_position":{"z":1,"x":-0.25,"y":0}},"device_id":"049D"}]})";

ServiceMessage read(const std::string& text, bool understood = true) {
    MessageReader reader;
    ServiceMessage message;
    CHECK(reader.read(text, message) == understood);
    return message;
}

/// A state whose position's x is spelled so.
std::string at_x(const std::string& x) {
    return R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":)" + x +
           R"(,"y":0,"z":0}},"status":{"calibrated":true}}]})";
}

std::string grip(const std::string& state, const std::string& list = "wireless_verse_grip") {
    return R"({")" + list + R"(":[{"device_id":"61548","state":)" + state + "}]}";
}

}  // namespace

TEST_CASE("an inventory of 3.5 tells of arm, grip, configuration and force", "[inverse3]") {
    const ServiceMessage message = read(kInventory35);
    CHECK(message.has_session);
    REQUIRE(message.arm_count == 1);
    const Arm& arm = message.arms[0];
    CHECK(arm.id.view() == "049D");
    REQUIRE(arm.config.has_value());
    CHECK(arm.config->handedness == Handedness::right);
    CHECK(arm.config->preset.view() == "defaults");
    CHECK(arm.config->basis.view() == "XYZ");
    CHECK_FALSE(arm.config->minverse);
    REQUIRE(arm.position_m.has_value());
    CHECK_THAT(arm.position_m->y, WithinAbs(-0.12, 1e-15));
    REQUIRE(arm.force_newton.has_value());
    CHECK_THAT(arm.force_newton->z, WithinAbs(1.5, 1e-15));
    CHECK(arm.calibrated);
    CHECK_FALSE(arm.locked);
    REQUIRE(message.grip_count == 1);
    CHECK(message.grips[0].buttons == 2);
    CHECK_THAT(message.grips[0].battery.value_or(0.0), WithinAbs(0.8, 1e-15));
}

TEST_CASE(
    "a state of 3.1 has neither session, configuration nor force, in any order, of whole "
    "numbers, too",
    "[inverse3]") {
    const ServiceMessage message = read(kState31);
    CHECK_FALSE(message.has_session);
    REQUIRE(message.arm_count == 1);
    CHECK_FALSE(message.arms[0].config.has_value());
    CHECK_FALSE(message.arms[0].force_newton.has_value());
    REQUIRE(message.arms[0].position_m.has_value());
    CHECK_THAT(message.arms[0].position_m->x, WithinAbs(-0.25, 1e-15));
    CHECK_THAT(message.arms[0].position_m->z, WithinAbs(1.0, 1e-15));
}

TEST_CASE("what is not told of an arm is taken for what keeps the hand safe", "[inverse3]") {
    const ServiceMessage message = read(R"({"inverse3":[{"device_id":"1"}]})");
    REQUIRE(message.arm_count == 1);
    CHECK_FALSE(message.arms[0].position_m.has_value());
    CHECK_FALSE(message.arms[0].calibrated);
}

TEST_CASE("a position that is null, no number or out of any arm's reach is none", "[inverse3]") {
    CHECK(read(at_x("0.1")).arms[0].position_m.has_value());
    for (const char* x : {"null", "\"0.1\"", "true", "{}", "1e6", "-1e300", "2.1"}) {
        CAPTURE(x);
        CHECK_FALSE(read(at_x(x)).arms[0].position_m.has_value());
    }
}

TEST_CASE("what is no JSON object is not understood, and nothing of the last message stays",
          "[inverse3]") {
    for (const std::string& text :
         {std::string{}, std::string("null"), std::string("[]"), std::string("7"), at_x("NaN"),
          kInventory35.substr(0, kInventory35.size() / 2), kInventory35 + "}",
          "{\"x\":\"" + std::string(MessageReader::kLongest_bytes, 'a') + "\"}"}) {
        MessageReader reader;
        ServiceMessage message;
        REQUIRE(reader.read(kInventory35, message));
        CAPTURE(text.substr(0, 80));
        CHECK_FALSE(reader.read(text, message));
        CHECK(message.arm_count == 0);
        CHECK(message.grip_count == 0);
        CHECK(reader.read(kInventory35, message));
    }
}

TEST_CASE("both naming schemes of buttons, wired and wireless, mean the same bits", "[inverse3]") {
    CHECK(read(grip(R"({"buttons":{"a":true,"c":true}})")).grips[0].buttons == 5);
    CHECK(read(grip(R"({"buttons":{"button_0":true,"button_2":true}})")).grips[0].buttons == 5);
    CHECK(read(grip(R"({"buttons":{"home":true}})")).grips[0].buttons == 8);
    CHECK(read(grip(R"({"buttons":{"button_3":true}})")).grips[0].buttons == 8);
    const Grip wired = read(grip(R"({"button":true,"hall":3})", "verse_grip")).grips[0];
    CHECK(wired.wired);
    CHECK(wired.buttons == 1);
    CHECK(read(grip(R"({"buttons":null})")).grips[0].buttons == 0);
}

TEST_CASE("a grip that sleeps says so", "[inverse3]") {
    const ServiceMessage message = read(
        R"({"wireless_verse_grip":[{"device_id":"1","status":{"awake":false,"connected":false}}]})");
    REQUIRE(message.grip_count == 1);
    CHECK_FALSE(message.grips[0].awake);
    CHECK_FALSE(message.grips[0].connected);
}

TEST_CASE("an arm is found by its name wherever it stands in the list", "[inverse3]") {
    const ServiceMessage message =
        read(R"({"inverse3":[{"device_id":"A"},{"device_id":"B","status":{"in_use":true}}]})");
    REQUIRE(message.arm(DeviceId("B")) != nullptr);
    CHECK(message.arm(DeviceId("B"))->in_use);
    CHECK(message.arm(DeviceId("C")) == nullptr);
}

TEST_CASE("a device without a name, or with one that would have to be cut, is left out",
          "[inverse3]") {
    const std::string long_name(200, '0');
    CHECK(read(R"({"inverse3":[{"state":{}},7,{"device_id":""},{"device_id":")" + long_name +
               R"("},{"device_id":"1"}]})")
              .arm_count == 1);
}

TEST_CASE("a Minverse is an arm in either list", "[inverse3]") {
    CHECK(read(R"({"inverse3":[{"device_id":"1","config":{"type":"minverse"}}]})")
              .arms[0]
              .config->minverse);
    CHECK(read(R"({"minverse":[{"device_id":"1"}]})").arm_count == 1);
}

TEST_CASE("reading allocates nothing", "[inverse3]") {
    MessageReader reader;
    ServiceMessage message;
    bool understood = true;
    const int allocations = test::allocations_in([&] {
        for (int k = 0; k < 100; ++k) {
            understood = reader.read(kInventory35, message) && understood;
            understood = reader.read(kState31, message) && understood;
        }
    });
    CHECK(understood);
    CHECK(allocations == 0);
}

TEST_CASE("what the service keeps is told in words, whatever JSON it comes in", "[inverse3]") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"({"enabled":true,"gravity_scaling_factor":0.5})", "on, gravity scaling factor 0.5"},
        {R"({"ok":true,"data":{"enabled":false}})", "off"},
        {R"({"force_gate":{"gain":0.3},"damping":{"scalar":0}})",
         "force gate gain 0.3, damping scalar 0"},
        {R"({"ok":true,"value":1.25})", "1.25"},
        {"0.75", "0.75"},
        {R"([{"device_id":"049D","enabled":true}])", "on"},
        {R"({"limits":[1,2.5,"soft"],"curve":null})", "limits 1, 2.5, soft, curve none"},
        {R"({"ok":false,"error":"no such device"})", "not told: no such device"},
        {R"({"ok":false})", "not told: refused"},
        {"plain text\n", "plain text "},
        {"{}", "{}"},
        {"{\"cut", "{\"cut"}};
    for (const auto& [told, words] : cases) {
        CAPTURE(told);
        CHECK(setting_text(told) == words);
    }
    CHECK(setting_text(std::string(5000, 'x')).size() < 130);
    std::string deep(3000, '[');
    CHECK(setting_text(deep + std::string(3000, ']')).size() < 130);
}
