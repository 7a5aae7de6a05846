// The guided check of a simulated Touch.
#include "device/openhaptics/check/checked_touch.hpp"

#include "core/error.hpp"
#include "tests/device/checking_person.hpp"
#include "tests/device/openhaptics/touch_desk.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::openhaptics;
using Catch::Matchers::WithinAbs;
using test::CheckingPerson;
using test::measured_in;

CheckingPerson person_at(ArmBench& bench) {
    return CheckingPerson({.place = [&bench](Vec3 mm) { bench.move_to(mm); },
                           .felt_newton =
                               [&bench] {
                                   const auto now = Clock::now().time_since_epoch();
                                   return bench.arm().newton(now.count()) > 0.0
                                              ? bench.felt_newton()
                                              : Vec3{0.0};
                               },
                           .right = {1.0, 0.0, 0.0},
                           .up = {0.0, 1.0, 0.0},
                           .towards = {0.0, 0.0, 1.0}});
}

CheckResult checked(const test::TemporaryFolder& folder, CheckConsole& person) {
    const ArmCheckTimes quick{.calls = milliseconds(50),
                              .ramp = milliseconds(50),
                              .hold = milliseconds(50),
                              .short_hold = milliseconds(20),
                              .silences = {milliseconds(15), milliseconds(200), milliseconds(800)}};
    TouchUnderCheck arm(options_for());
    return check_arm(arm, {.record = folder / "check.json"}, person, quick);
}

}  // namespace

TEST_CASE("the check measures what is not known of a Touch, and keeps it in a record",
          "[openhaptics]") {
    const test::TemporaryFolder folder;
    FoundArm found({});
    found.bench.arm().watchdog_ms = GENERATE(0, 100);
    const bool has_watchdog = found.bench.arm().watchdog_ms > 0;
    CheckingPerson person = person_at(found.bench);
    const CheckResult result = checked(folder, person);
    INFO(person.received);
    CHECK(result.fault.empty());
    CHECK_THAT(measured_in(result.record, "calls")["servo tick"]["per_s"].get<double>(),
               WithinAbs(1000.0, 100.0));
    CHECK_THAT(measured_in(result.record, "moving")["step_mm_p05"].get<double>(),
               WithinAbs(1.0, 1e-9));
    CHECK(person.received.find("right is +x, up is +y, towards you is +z: as dibhr") !=
          std::string::npos);
    const Json silence = measured_in(result.record, "silence");
    CHECK(silence["15_ms"]["force_on"] == true);
    CHECK(silence["800_ms"]["force_on"] == !has_watchdog);
    CHECK(silence["800_ms"]["rose_mm"] == 0.0);
    CHECK_THAT(measured_in(result.record, "force")["0.44_newton"]["newton"].get<double>(),
               WithinAbs(0.44, 0.01));
    CHECK_THAT(person.most_newton, WithinAbs(0.88, 1e-9));
    CHECK(found.bench.felt_newton() == Vec3{0.0});
    CHECK_FALSE(found.bench.arm().output);
    CHECK_FALSE(found.bench.arm().open);
    CAPTURE(found.bench.page().first_wrong);
    CHECK(found.bench.page().wrong_calls == 0);
}

TEST_CASE("any key ends a force of the check of a Touch at once", "[openhaptics]") {
    const test::TemporaryFolder folder;
    FoundArm found({});
    CheckingPerson person = person_at(found.bench);
    person.wish = GENERATE(CheckConsole::Request::release, CheckConsole::Request::quit);
    (void)checked(folder, person);
    CHECK(person.most_newton == 0.0);
    CHECK(strongest(found.bench.sent_since({})) == 0.0);
    CHECK(found.bench.page().wrong_calls == 0);
}

TEST_CASE("a Touch that is not calibrated is not checked", "[openhaptics]") {
    const test::TemporaryFolder folder;
    FoundArm found([](ArmPage& page) { page.arms[0].calibration = 0x5002; });
    CheckingPerson person = person_at(found.bench);
    CHECK_THROWS_AS(checked(folder, person), DeviceError);
    CHECK_FALSE(found.bench.arm().open);
}
