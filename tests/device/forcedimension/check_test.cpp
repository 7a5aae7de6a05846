// The guided check of a simulated arm.
#include "device/forcedimension/check/checked_arm.hpp"

#include "core/error.hpp"
#include "tests/device/checking_person.hpp"
#include "tests/device/forcedimension/arm_bench.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::forcedimension;
using Catch::Matchers::WithinAbs;
using test::CheckingPerson;
using test::measured_in;

CheckingPerson person_at(Page& page) {
    Unit& unit = page.units[0];
    return CheckingPerson(
        {.place =
             [&unit](Vec3 mm) {
                 for (int axis = 0; axis < 3; ++axis)
                     unit.position_m[static_cast<std::size_t>(axis)] = 0.001 * mm[axis];
             },
         .felt_newton =
             [&unit] {
                 return Vec3{unit.newton[0].load(), unit.newton[1].load(), unit.newton[2].load()};
             },
         .right = {0.0, 1.0, 0.0},
         .up = {0.0, 0.0, 1.0},
         .towards = {1.0, 0.0, 0.0}});
}

CheckResult checked(const test::TemporaryFolder& folder, CheckConsole& person) {
    const ArmCheckTimes quick{.calls = milliseconds(5),
                              .ramp = milliseconds(50),
                              .hold = milliseconds(50),
                              .short_hold = milliseconds(20)};
    ArmUnderCheck arm(options_for());
    return check_arm(arm, {.record = folder / "check.json"}, person, quick);
}

}  // namespace

TEST_CASE("the check measures what is not known of an arm, and keeps it in a record",
          "[forcedimension]") {
    const test::TemporaryFolder folder;
    Page& page = page_with_omega();
    CheckingPerson person = person_at(page);
    const CheckResult result = checked(folder, person);
    INFO(person.received);
    CHECK(result.fault.empty());
    CHECK(measured_in(result.record, "calls")["position"]["per_s"].get<double>() > 0.0);
    CHECK_THAT(measured_in(result.record, "moving")["step_mm_p05"].get<double>(),
               WithinAbs(1.0, 1e-9));
    CHECK(person.received.find("right is +y, up is +z, towards you is +x: as dibhr") !=
          std::string::npos);
    const Json silence = measured_in(result.record, "silence");
    CHECK(silence["15_ms"]["force_on"] == true);
    CHECK(silence["25_ms"]["force_on"] == false);
    CHECK(silence["25_ms"]["cause"] == 3);
    CHECK_THAT(measured_in(result.record, "force")["3.00_newton"]["newton"].get<double>(),
               WithinAbs(3.0, 0.01));
    CHECK_THAT(person.most_newton, WithinAbs(4.0, 1e-9));
    CHECK(person.newton_at_end == 0.0);
    CHECK_FALSE(page.units[0].force_on);
    CHECK_FALSE(page.units[0].open);
    CHECK(page.wrong_calls == 0);
}

TEST_CASE("any key ends a force of the check at once", "[forcedimension]") {
    const test::TemporaryFolder folder;
    Page& page = page_with_omega();
    CheckingPerson person = person_at(page);
    person.wish = GENERATE(CheckConsole::Request::release, CheckConsole::Request::quit);
    (void)checked(folder, person);
    CHECK(person.most_newton == 0.0);
    CHECK_FALSE(page.units[0].force_on);
    CHECK(page.wrong_calls == 0);
}

TEST_CASE("an arm that does not know its position is not checked, and does not move",
          "[forcedimension]") {
    const test::TemporaryFolder folder;
    Page& page = page_with_omega();
    page.units[0].initialised = false;
    CheckingPerson person = person_at(page);
    CHECK_THROWS_AS(checked(folder, person), DeviceError);
    CHECK(page.units[0].initialisations == 0);
    CHECK_FALSE(page.units[0].open);
}
