// The guided check of a simulated Inverse3, with a person who follows it.
#include "device/inverse3/check/check.hpp"

#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/files/json.hpp"
#include "tests/device/inverse3/service_desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::inverse3;
using Catch::Matchers::WithinAbs;

/// Moves the grip, feels the pull, and reads a scale.
class Person final : public CheckGuide {
  public:
    explicit Person(simulated::Service& service) : service_(service) {}

    std::function<Wish()> wish_under_force{[] { return Wish::none; }};
    /// Answers instead; nothing: as usual.
    std::function<std::optional<std::string>(const std::string&)> instead{
        [](const std::string&) { return std::nullopt; }};
    bool entry_freezes{false};  ///< of a device whose cable is out
    std::string heard{};
    double most_newton{0.0};         ///< felt in the last push
    Vec3 last_newton{0.0};           ///< there, at its end
    double after_force_newton{0.0};  ///< felt when a push had ended, at most

    void say(const std::string& text) override { heard += text + "\n"; }
    void show(const std::string& state) override { heard += state + "\n"; }
    void ask(const std::string& question) override {
        heard += question + "\n";
        line_ = instead(question);
        if (line_) return;
        if (question.find("Pull the USB cable") != std::string::npos) {
            began_ = simulated::Clock::now();
            moves_ = true;
            pull_cable();
        } else if (question.find("Move the grip") != std::string::npos) {
            began_ = simulated::Clock::now();
            service_.with([](simulated::Scene& scene) {
                scene.hand_m = [](double t_s) {
                    return Vec3{0.1 * std::sin(9.0 * t_s), -0.15 + 0.05 * std::cos(7.0 * t_s),
                                0.18 + 0.08 * std::sin(5.0 * t_s)};
                };
            });
            moves_ = true;
        } else if (question.find("Did the grip pull") != std::string::npos) {
            line_ = last_newton.x < -0.4 ? "y" : "n";
        } else if (question.find("Grams") != std::string::npos) {
            line_ = std::to_string(-last_newton.z / 9.80665 * 1000.0);
        } else {
            line_ = question.find("F and Enter") != std::string::npos ? "f" : "";
        }
    }
    std::optional<std::string> next_line() override {
        if (moves_) {
            if (simulated::Clock::now() - began_ < milliseconds(1500)) return {};
            moves_ = false;
            service_.with([this](simulated::Scene& scene) {
                scene.hand_m = nullptr;
                if (unplugged_) scene.arms = {*unplugged_};
            });
            return "";
        }
        return std::exchange(line_, std::nullopt);
    }
    bool input_ended() override { return false; }
    bool interrupted() override { return false; }
    void force_begins() override { most_newton = 0.0; }
    void force_ended() noexcept override {
        after_force_newton = std::max(after_force_newton, glm::length(felt()));
    }
    Wish wish() override {
        last_newton = felt();
        most_newton = std::max(most_newton, glm::length(last_newton));
        return wish_under_force();
    }

  private:
    /// Of a grip that is moved until then.
    void pull_cable() {
        const auto begin = simulated::Clock::now();
        service_.with([this, begin](simulated::Scene& scene) {
            unplugged_ = scene.arms.front();
            if (!entry_freezes) {
                scene.arms.clear();
                return;
            }
            scene.hand_m = [begin](double) {
                const std::chrono::duration<double> since = simulated::Clock::now() - begin;
                return Vec3{0.1 * std::min(since.count(), 0.3), -0.15, 0.18};
            };
        });
    }
    Vec3 felt() {
        return service_.with([](simulated::Scene& scene) {
            scene.forget_old_forces(simulated::Clock::now());
            return scene.arms.empty() ? Vec3{0.0} : scene.arms.front().force_newton;
        });
    }

    simulated::Service& service_;
    std::optional<std::string> line_{};
    std::optional<simulated::Arm> unplugged_{};
    simulated::Clock::time_point began_{};
    bool moves_{false};
};

CheckOptions quick(const simulated::Service& service, const test::TemporaryFolder& folder) {
    CheckOptions options;
    options.connection = options_for(service);
    options.record = folder / "check.json";
    options.facts = {{"program", "dibhr test"}};
    options.times.rate = milliseconds(200);
    options.times.ramp = milliseconds(100);
    options.times.hold = milliseconds(200);
    options.times.dialect = milliseconds(100);
    options.times.frozen = milliseconds(500);
    options.times.silences = {milliseconds(5), milliseconds(30), milliseconds(120)};
    return options;
}

Json record_in(const test::TemporaryFolder& folder) {
    return Json::parse(std::ifstream(folder / "check.json"));
}

Json step_in(const Json& record, const std::string& name) {
    for (const Json& step : record["steps"]) {
        if (step["step"] == name) return step;
    }
    FAIL("no step " << name);
    return {};
}

bool says(const Json& value, const std::string& part) {
    return value.is_string() && value.get<std::string>().find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("the check measures what is not known of an Inverse3, and keeps it in a record",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene;
    scene.manners.takes = GENERATE(simulated::Takes::vector, simulated::Takes::values);
    scene.manners.force_held = milliseconds(60);
    const bool vector = scene.manners.takes == simulated::Takes::vector;
    simulated::Service service(scene);
    Person person(service);
    const CheckResult result = run_check(quick(service, folder), person);
    INFO(person.heard);
    CHECK(result.fault.empty());
    const Json record = record_in(folder);
    CHECK(record["format"] == "dibhr inverse3 check");
    CHECK(record["device_id"] == "049D");
    CHECK(record["program"] == "dibhr test");
    for (const Json& step : record["steps"]) CHECK(step["end"] == "done");
    const Json& found = record["findings"];
    CHECK(says(found["service"], "3.5.0, 1 device(s)"));
    CHECK(says(found["rate"], "a second"));
    CHECK(says(found["step"], "mm"));
    CHECK(says(found["workspace"], "200 x 100 x 160 mm"));
    CHECK(says(found["dialect"], vector ? "vector is felt and told back; values is not felt"
                                        : "vector is not felt; values is felt and told back"));
    CHECK(says(found["silence"], "gone after 120 ms at most"));
    CHECK(says(found["force"], "1.00 N of 1, 2.00 N of 2, 3.00 N of 3"));
    CHECK(says(found["in-use"], "another program"));
    CHECK(says(found["unplugged"], "it goes"));
    CHECK(record["settings"]["dialect"] == (vector ? "\"vector\"" : "\"values\""));
    CHECK(person.heard.find("[inverse3]") != std::string::npos);
    CHECK_THAT(person.after_force_newton, WithinAbs(0.0, 1e-12));
    CHECK(service.too_many_in_flight() == 0);
}

TEST_CASE("the check tells a frozen entry from one that goes, and whom in_use means",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service;
    Person person(service);
    person.entry_freezes = true;
    person.wish_under_force = [&] {  // a service that counts us as a user of the device
        service.with([](simulated::Scene& scene) { scene.arms[0].in_use = true; });
        return CheckGuide::Wish::none;
    };
    const CheckResult result = run_check(quick(service, folder), person);
    INFO(person.heard);
    CHECK(result.fault.empty());
    const Json record = record_in(folder);
    CHECK(says(record["findings"]["in-use"], "us, too"));
    CHECK(says(record["findings"]["unplugged"], "it stays, frozen"));
}

TEST_CASE("a person who lets go, or quits, is without force at once", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service;
    Person person(service);
    const auto wish = GENERATE(CheckGuide::Wish::let_go, CheckGuide::Wish::quit);
    person.wish_under_force = [&] {
        return person.most_newton > 0.3 ? wish : CheckGuide::Wish::none;
    };
    const CheckResult result = run_check(quick(service, folder), person);
    CHECK(result.fault.empty());
    CHECK_THAT(person.after_force_newton, WithinAbs(0.0, 1e-12));
    if (wish == CheckGuide::Wish::quit) {
        CHECK(record_in(folder)["steps"].back()["end"] == "not begun");
    }
}

TEST_CASE("no force begins by Enter alone", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service;
    Person person(service);
    const bool at_step = GENERATE(true, false);  // else at the force itself
    std::map<std::string, int> enters;
    person.instead = [&](const std::string& question) -> std::optional<std::string> {
        if (question.find("F and Enter") == std::string::npos) return {};
        if (!at_step && question.find("begin with force") != std::string::npos) {
            const bool pulls_at_once =
                person.heard.rfind("Force on a kitchen scale") == std::string::npos;
            return pulls_at_once ? "s" : "f";
        }
        return ++enters[question] % 3 == 0 ? "s" : "";
    };
    CHECK(run_check(quick(service, folder), person).fault.empty());
    CHECK_FALSE(enters.empty());
    CHECK(person.heard.find("No force without an F") != std::string::npos);
    for (const simulated::Heard& one : service.heard()) {
        REQUIRE(glm::length(one.force_newton) < 1e-12);
    }
}

TEST_CASE("a key in a silence is answered by a zero force within 25 ms", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene;
    scene.manners.force_held = milliseconds(0);
    simulated::Service service(scene);
    Person person(service);
    person.instead = [&](const std::string& question) -> std::optional<std::string> {
        const bool is_silence = person.heard.rfind("The force after the last message") >
                                person.heard.rfind("How a force is spelled") + 1;
        if (question.find("begin with force") != std::string::npos && !is_silence) return "s";
        return {};
    };
    CheckOptions options = quick(service, folder);
    options.times.silences = {milliseconds(1000)};
    std::optional<simulated::Clock::time_point> key;
    person.wish_under_force = [&] {
        const auto last = service.heard().back().at;
        const bool silent = simulated::Clock::now() - last > milliseconds(200);
        if (silent && !key) key = simulated::Clock::now();
        return key ? CheckGuide::Wish::let_go : CheckGuide::Wish::none;
    };
    CHECK(run_check(options, person).fault.empty());
    REQUIRE(key);
    const auto heard = service.heard();
    const auto next = std::find_if(heard.begin(), heard.end(),
                                   [&](const simulated::Heard& one) { return one.at > *key; });
    REQUIRE(next != heard.end());
    CHECK(next->drives);
    CHECK_THAT(glm::length(next->force_newton), WithinAbs(0.0, 1e-12));
    CHECK(next->at - *key < milliseconds(25));
    CHECK(step_in(record_in(folder), "silence")["end"] == "let go");
}

TEST_CASE("the step of the workspace waits for its Enter, and tells when it waits no longer",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service;
    Person person(service);
    person.wish_under_force = [] { return CheckGuide::Wish::quit; };
    CheckOptions options = quick(service, folder);
    const bool waits = GENERATE(true, false);  // the person takes 1.5 s
    if (!waits) options.times.moving = milliseconds(300);
    CHECK(run_check(options, person).fault.empty());
    CHECK((person.heard.find("It went on by itself") == std::string::npos) == waits);
    const Json measured = step_in(record_in(folder), "moving")["measured"];
    CHECK(measured["ended_by_enter"] == waits);
}

TEST_CASE("an Inverse3 that goes in the middle of the check ends it with a reason",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service;
    Person person(service);
    person.wish_under_force = [&] {
        if (person.most_newton > 0.3) {
            service.with([](simulated::Scene& scene) { scene.arms[0].powered = false; });
        }
        return CheckGuide::Wish::none;
    };
    CheckOptions options = quick(service, folder);
    options.times.dialect = milliseconds(300);
    // Of the dialect a complaint is a finding; what follows fails.
    const CheckResult result = run_check(options, person);
    CHECK(result.fault.find("lost its calibration or its power") != std::string::npos);
}

TEST_CASE("without a usable Inverse3 the check does not begin", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene;
    scene.arms[0].calibrated = false;
    simulated::Service service(scene);
    Person person(service);
    CHECK_THROWS_AS(run_check(quick(service, folder), person), DeviceError);
    service.with([](simulated::Scene& there) { there.arms.clear(); });
    CHECK_THROWS_AS(run_check(quick(service, folder), person), DeviceError);
    CHECK(service.heard().empty());
}
