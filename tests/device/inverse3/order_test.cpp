// Messages to the service, letter by letter as in its documentation.
#include "device/inverse3/service_request.hpp"

#include <limits>
#include <string>

#include "core/files/json.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::inverse3;

std::string written(const ServiceRequest& request) {
    RequestWriter writer;
    return std::string(writer.write(request));
}

}  // namespace

TEST_CASE("a force is spelled in either dialect", "[inverse3]") {
    ServiceRequest request{.arm = DeviceId("049D"), .force_newton = Vec3{0.0, -0.25, 1.5}};
    CHECK(written(request) == R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":)"
                              R"({"vector":{"x":0,"y":-0.25,"z":1.5}}}}]})");
    request.dialect = ForceDialect::values;
    CHECK(written(request) == R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":)"
                              R"({"values":{"x":0,"y":-0.25,"z":1.5}}}}]})");
}

TEST_CASE("without a force the pose is asked for, and nothing is driven", "[inverse3]") {
    CHECK(written({.arm = DeviceId("049D")}) ==
          R"({"inverse3":[{"device_id":"049D","commands":{"probe_position":{}}}]})");
}

TEST_CASE("the first message names the session and sets the preset", "[inverse3]") {
    CHECK(written(
              {.arm = DeviceId("1"), .sets_session_name = true, .preset = ShortWord("defaults")}) ==
          R"({"session":{"configure":{"profile":{"name":"dibhr:viewer"}}},)"
          R"("inverse3":[{"device_id":"1","configure":{"preset":{"preset":"defaults"}},)"
          R"("commands":{"probe_position":{}}}]})");
}

TEST_CASE("without a device the whole state is asked for", "[inverse3]") {
    CHECK(written({.whole_state = true}) == R"({"session":{"force_render_full_state":{}}})");
    CHECK(written({}) == "{}");
}

TEST_CASE("a force that is no number is none", "[inverse3]") {
    const double bad =
        GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
    CHECK(written({.arm = DeviceId("1"), .force_newton = Vec3{bad, 1.0, 0.0}}) ==
          written({.arm = DeviceId("1"), .force_newton = Vec3{0.0}}));
}

TEST_CASE("the longest message fits, and any name of a device is whole JSON", "[inverse3]") {
    const std::string name = "\"\\" + std::string(46, '\x01');
    const ServiceRequest request{.arm = DeviceId(name),
                                 .sets_session_name = true,
                                 .preset = ShortWord(std::string(32, '\x02')),
                                 .whole_state = true,
                                 .force_newton = Vec3{-1.2345678901234567e-300},
                                 .dialect = ForceDialect::vector};
    const auto json = parsed_json(written(request));
    CHECK(json["inverse3"][0]["device_id"] == name);
    CHECK(json["session"].contains("force_render_full_state"));
}

TEST_CASE("writing allocates nothing", "[inverse3]") {
    RequestWriter writer;
    const ServiceRequest request{
        .arm = DeviceId("049D"), .sets_session_name = true, .force_newton = Vec3{1.0 / 3.0}};
    std::size_t size = 0;
    CHECK(test::allocations_in([&] { size = writer.write(request).size(); }) == 0);
    CHECK(size > 100);
}
