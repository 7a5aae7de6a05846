// The guided check of a simulated arm, with a person who follows it.
#include "device/forcedimension/check/check.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/files/json.hpp"
#include "tests/device/forcedimension/arm_bench.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::forcedimension;
using Catch::Matchers::WithinAbs;
using test::TemporaryFolder;

/// Moves the grip, and reads a scale.
class Person final : public CheckConsole {
  public:
    explicit Person(Page& page) : page_(page) {}

    Request wish{Request::none};  ///< while a force acts
    std::string received{};
    double most_newton{0.0};
    bool pushed_after_end{false};

    void print(const std::string& text) override { received += text + "\n"; }
    void show(const std::string& state) override { received += state + "\n"; }
    void ask(const std::string& question) override {
        received += question + "\n";
        const auto has = [&question](const char* part) {
            return question.find(part) != std::string::npos;
        };
        Unit& unit = page_.units[0];
        if (has("every end")) moves_ = 40;
        if (has("centimetres right")) unit.position_m[1] = unit.position_m[1] + 0.03;
        if (has("centimetres up")) unit.position_m[2] = unit.position_m[2] + 0.03;
        if (has("centimetres towards")) unit.position_m[0] = unit.position_m[0] + 0.03;
        line_ = has("Grams")         ? std::to_string(-last_down_newton_ / 9.80665 * 1000.0)
                : has("F and Enter") ? "f"
                                     : "";
    }
    std::optional<std::string> next_line() override {
        if (moves_ > 0) {
            page_.units[0].position_m[0] = 0.001 * (--moves_ % 7);
            return {};
        }
        return std::exchange(line_, std::nullopt);
    }
    bool input_ended() override { return false; }
    bool interrupted() override { return false; }
    void force_begins() override {}
    void force_ended() noexcept override {
        pushed_after_end = pushed_after_end || page_.units[0].force_on;
    }
    Request request() override {
        last_down_newton_ = page_.units[0].newton[2];
        most_newton = std::max(most_newton, std::abs(last_down_newton_));
        return wish;
    }

  private:
    Page& page_;
    std::optional<std::string> line_{};
    int moves_{0};
    double last_down_newton_{0.0};
};

CheckOptions quick(const TemporaryFolder& folder) {
    CheckOptions options;
    options.connection = options_for();
    options.record = folder / "check.json";
    options.times.calls = milliseconds(5);
    options.times.ramp = milliseconds(50);
    options.times.hold = milliseconds(50);
    options.times.short_hold = milliseconds(20);
    return options;
}

Json step_in(const TemporaryFolder& folder, const std::string& name) {
    const Json record = Json::parse(std::ifstream(folder / "check.json"));
    for (const Json& step : record["steps"])
        if (step["step"] == name) return step["measured"];
    FAIL("no step " << name);
    return {};
}

}  // namespace

TEST_CASE("the check measures what is not known of an arm, and keeps it in a record",
          "[forcedimension]") {
    const TemporaryFolder folder;
    Page& page = page_with_omega();
    Person person(page);
    const CheckResult result = run_check(quick(folder), person);
    INFO(person.received);
    CHECK(result.fault.empty());
    CHECK(step_in(folder, "calls")["position"]["per_s"].get<double>() > 0.0);
    CHECK_THAT(step_in(folder, "moving")["step_mm_p05"].get<double>(), WithinAbs(1.0, 1e-9));
    CHECK(person.received.find("right is +y, up is +z, towards you is +x: as dibhr") !=
          std::string::npos);
    const Json silence = step_in(folder, "silence");
    CHECK(silence["15_ms"]["force_on"] == true);
    CHECK(silence["25_ms"]["force_on"] == false);
    CHECK(silence["25_ms"]["cause"] == 3);
    CHECK_THAT(step_in(folder, "force")["3_newton"]["newton"].get<double>(), WithinAbs(3.0, 0.01));
    CHECK(person.most_newton <= 4.0 + 1e-9);
    CHECK_FALSE(person.pushed_after_end);
    CHECK_FALSE(page.units[0].force_on);
    CHECK_FALSE(page.units[0].open);
    CHECK(page.wrong_calls == 0);
}

TEST_CASE("any key ends a force of the check at once", "[forcedimension]") {
    const TemporaryFolder folder;
    Page& page = page_with_omega();
    Person person(page);
    person.wish = GENERATE(CheckConsole::Request::release, CheckConsole::Request::quit);
    (void)run_check(quick(folder), person);
    CHECK(person.most_newton == 0.0);
    CHECK_FALSE(page.units[0].force_on);
    CHECK(page.wrong_calls == 0);
}

TEST_CASE("an arm that does not know its position is not checked, and does not move",
          "[forcedimension]") {
    const TemporaryFolder folder;
    Page& page = page_with_omega();
    page.units[0].initialised = false;
    Person person(page);
    CHECK_THROWS_AS(run_check(quick(folder), person), DeviceError);
    CHECK(page.units[0].initialisations == 0);
    CHECK_FALSE(page.units[0].open);
}
