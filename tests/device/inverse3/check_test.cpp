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
#include "device/hand/check/numbers.hpp"
#include "tests/device/inverse3/service_desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::inverse3;
using Catch::Matchers::WithinAbs;

/// Moves the grip, feels the pull, and reads a scale.
class Person final : public CheckConsole {
  public:
    explicit Person(simulated::Service& service) : service_(service) {}

    std::function<Request()> wish_under_force{[] { return Request::none; }};
    /// Answers instead; nothing: as usual.
    std::function<std::optional<std::string>(const std::string&)> instead{
        [](const std::string&) { return std::nullopt; }};
    std::function<Vec3(double)> motion{[](double t_s) {
        return Vec3{0.1 * std::sin(9.0 * t_s), -0.15 + 0.05 * std::cos(7.0 * t_s),
                    0.18 + 0.08 * std::sin(5.0 * t_s)};
    }};
    bool moves_after{true};     ///< the grip, once it is plugged in again
    bool entry_freezes{false};  ///< of a device whose cable is out
    std::string received{};
    double most_newton{0.0};         ///< felt in the last push
    Vec3 last_newton{0.0};           ///< there, at its end
    double after_force_newton{0.0};  ///< felt when a push had ended, at most

    void print(const std::string& text) override { received += text + "\n"; }
    void show(const std::string& state) override { received += state + "\n"; }
    void ask(const std::string& question) override {
        received += question + "\n";
        line_ = instead(question);
        if (line_) return;
        if (question.find("pull the USB cable") != std::string::npos) {
            began_ = simulated::Clock::now() - milliseconds(1000);  // Enter after 0.5 s
            moves_ = true;
            pull_cable();
        } else if (question.find("plug the USB cable") != std::string::npos) {
            began_ = simulated::Clock::now();
            moves_ = replugs_ = true;
        } else if (question.find("Move the grip") != std::string::npos) {
            began_ = simulated::Clock::now();
            service_.with([this](simulated::Scene& scene) { scene.hand_m = motion; });
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
            const auto since = simulated::Clock::now() - began_;
            if (replugs_ && since > milliseconds(800)) plug_in_again();
            if (since < milliseconds(1500)) return {};
            moves_ = false;
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
    Request request() override {
        last_newton = felt();
        most_newton = std::max(most_newton, glm::length(last_newton));
        return wish_under_force();
    }

  private:
    void plug_in_again() {
        replugs_ = false;
        service_.with([this](simulated::Scene& scene) {
            scene.arms = {*unplugged_};
            scene.hand_m = nullptr;
            if (moves_after) scene.hand_m = motion;
        });
    }
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
    bool replugs_{false};
};

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Only the step of this title is done.
std::function<std::optional<std::string>(const std::string&)> only(const std::string& title,
                                                                   Person& person) {
    return [&person, title](const std::string& question) -> std::optional<std::string> {
        if (!holds(question, "= go on") && !holds(question, "begin with force")) return {};
        const std::size_t step = person.received.rfind(" of 8: ");
        const bool wanted = person.received.find(" of 8: " + title + "\n", step) == step;
        if (!wanted) return "s";
        return {};
    };
}

/// The names of members that the legend does not explain, under their step.
void find_unexplained(const Json& value, const Json& legend, std::string& unexplained) {
    if (value.is_array()) {
        for (const Json& one : value) find_unexplained(one, legend, unexplained);
    }
    if (!value.is_object()) return;
    for (const auto& [name, member] : value.items()) {
        if (!legend.contains(name)) unexplained += " " + name;
        // What the service or the machine says in its own words.
        if (name == "inventory" || name == "introduced" || name == "version_answer" ||
            name == "kept" || name == "machine" || name == "findings" || name == "settings" ||
            name == "legend" || name == "measured") {
            continue;
        }
        find_unexplained(member, legend, unexplained);
    }
}

CheckOptions quick(const simulated::Service& service, const test::TemporaryFolder& folder) {
    CheckOptions options;
    options.connection = options_for(service);
    options.record = folder / "check.json";
    options.facts = {{"program", "dibhr test"}};
    options.times.rate = milliseconds(200);
    options.times.ramp = milliseconds(100);
    options.times.hold = milliseconds(200);
    options.times.dialect = milliseconds(100);
    options.times.closing_hold = milliseconds(100);
    options.times.closings = {milliseconds(0), milliseconds(120)};
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
    simulated::Scene scene = usual_scene();
    scene.behaviour.accepts =
        GENERATE(simulated::AcceptedDialect::vector, simulated::AcceptedDialect::values);
    scene.behaviour.force_held = milliseconds(60);
    const bool vector = scene.behaviour.accepts == simulated::AcceptedDialect::vector;
    simulated::Service service(scene);
    Person person(service);
    const CheckResult result = run_check(quick(service, folder), person);
    INFO(person.received);
    CHECK(result.fault == "");
    const Json record = record_in(folder);
    CHECK(record["format"] == "dibhr inverse3 check");
    CHECK(record["device_id"] == "049D");
    CHECK(record["program"] == "dibhr test");
    CHECK(record["simulated"] == true);
    CHECK(record["service_port"] == service.port());
    CHECK(record["dialect_setting"] == "automatic");
    CHECK(record["preset_asked"] == "defaults");
    CHECK(record["preset"] == "defaults");
    CHECK(record["basis"] == "XYZ");
    CHECK(record["machine"]["cpus"].get<int>() > 0);
    CHECK(record["begun_local"].get<std::string>().size() ==
          std::string("2026-11-26T07:22:48+0000").size());
    std::string unexplained;
    find_unexplained(record, record["legend"]["record"], unexplained);
    for (const Json& step : record["steps"]) {
        const std::string name = step["step"];
        find_unexplained(step["measured"], record["legend"][name], unexplained);
    }
    CHECK(unexplained == "");
    for (const Json& step : record["steps"]) CHECK(step["end"] == "done");
    const Json& found = record["findings"];
    CHECK(says(found["service"], "3.5.0, 1 device(s)"));
    CHECK(says(found["rate"], "a second"));
    CHECK(says(found["step"], "mm"));
    CHECK(says(found["workspace"], "200 x 100 x 160 mm"));
    CHECK(says(found["dialect"],
               vector ? "vector is felt and confirmed by the service; values is not felt"
                      : "vector is not felt; values is felt and confirmed by the service"));
    CHECK(says(found["silence"], "still there after "));
    CHECK(says(found["silence"], "gone after "));
    CHECK(says(found["closed"], "gone after "));
    CHECK(says(found["force"], "1.00 N of 1 (100 %), 2.00 N of 2 (100 %), 3.00 N of 3 (100 %)"));
    CHECK(says(found["force"], "4.00 N of 4 (100 %)"));
    CHECK(says(found["in-use"], "another program"));
    CHECK(says(found["unplugged"], "it goes"));
    CHECK(record["settings"]["dialect"] == (vector ? "\"vector\"" : "\"values\""));
    CHECK(person.received.find("[inverse3]") != std::string::npos);
    CHECK_THAT(person.after_force_newton, WithinAbs(0.0, 1e-12));
    CHECK(service.too_many_in_flight() == 0);
}

TEST_CASE("the check tells a frozen entry from one that goes, and whom in_use means",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    person.entry_freezes = true;
    person.wish_under_force = [&] {  // a service that counts us as a user of the device
        service.with([](simulated::Scene& scene) { scene.arms[0].in_use = true; });
        return CheckConsole::Request::none;
    };
    const CheckResult result = run_check(quick(service, folder), person);
    INFO(person.received);
    CHECK(result.fault == "");
    const Json record = record_in(folder);
    CHECK(says(record["findings"]["in-use"], "us, too"));
    CHECK(says(record["findings"]["unplugged"], "it stays, frozen"));
}

TEST_CASE("a person who lets go, or quits, is without force at once", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    const auto request = GENERATE(CheckConsole::Request::release, CheckConsole::Request::quit);
    person.wish_under_force = [&] {
        return person.most_newton > 0.3 ? request : CheckConsole::Request::none;
    };
    const CheckResult result = run_check(quick(service, folder), person);
    CHECK(result.fault == "");
    CHECK_THAT(person.after_force_newton, WithinAbs(0.0, 1e-12));
    if (request == CheckConsole::Request::quit) {
        CHECK(record_in(folder)["steps"].back()["end"] == "not begun");
    }
}

TEST_CASE("no force begins by Enter alone", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    const bool at_step = GENERATE(true, false);  // else at the force itself
    std::map<std::string, int> enters;
    person.instead = [&](const std::string& question) -> std::optional<std::string> {
        if (question.find("F and Enter") == std::string::npos) return {};
        if (!at_step && question.find("begin with force") != std::string::npos) {
            const bool pulls_at_once =
                person.received.rfind("Force on a kitchen scale") == std::string::npos;
            return pulls_at_once ? "s" : "f";
        }
        return ++enters[question] % 3 == 0 ? "s" : "";
    };
    CHECK(run_check(quick(service, folder), person).fault == "");
    CHECK_FALSE(enters.empty());
    CHECK(person.received.find("There is no force until you type F") != std::string::npos);
    for (const simulated::ReceivedMessage& one : service.received()) {
        REQUIRE(glm::length(one.force_newton) < 1e-12);
    }
}

TEST_CASE("a key in a silence is answered by a zero force within 10 ms", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene = usual_scene();
    scene.behaviour.force_held = milliseconds(0);
    simulated::Service service(scene);
    Person person(service);
    person.instead = [&](const std::string& question) -> std::optional<std::string> {
        const bool is_silence = person.received.rfind("The force after the last message") >
                                person.received.rfind("The format of a force") + 1;
        if (question.find("begin with force") != std::string::npos && !is_silence) return "s";
        return {};
    };
    CheckOptions options = quick(service, folder);
    options.times.silences = {milliseconds(1000)};
    std::optional<simulated::Clock::time_point> key;
    person.wish_under_force = [&] {
        const auto last = service.received().back().at;
        const bool silent = simulated::Clock::now() - last > milliseconds(200);
        if (silent && !key) key = simulated::Clock::now();
        return key ? CheckConsole::Request::release : CheckConsole::Request::none;
    };
    CHECK(run_check(options, person).fault == "");
    REQUIRE(key);
    const auto received = service.received();
    const auto next =
        std::find_if(received.begin(), received.end(),
                     [&](const simulated::ReceivedMessage& one) { return one.at > *key; });
    REQUIRE(next != received.end());
    CHECK(next->drives);
    CHECK_THAT(glm::length(next->force_newton), WithinAbs(0.0, 1e-12));
    CHECK(next->at - *key < milliseconds(10));
    CHECK(step_in(record_in(folder), "silence")["end"] == "let go");
}

TEST_CASE("the step of the workspace waits for its Enter, and tells when it waits no longer",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    person.wish_under_force = [] { return CheckConsole::Request::quit; };
    CheckOptions options = quick(service, folder);
    const bool waits = GENERATE(true, false);  // the person takes 1.5 s
    if (!waits) options.times.moving = milliseconds(300);
    CHECK(run_check(options, person).fault == "");
    CHECK((person.received.find("It went on by itself") == std::string::npos) == waits);
    const Json measured = step_in(record_in(folder), "moving")["measured"];
    CHECK(measured["ended_by_enter"] == waits);
}

TEST_CASE("only what is felt is proposed for the settings, and y or n is asked for until it comes",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene = usual_scene();
    scene.behaviour.accepts = simulated::AcceptedDialect::both;
    simulated::Service service(scene);
    Person person(service);
    const auto usual = only("The format of a force", person);
    const bool values_felt = GENERATE(true, false);
    int asked = 0;
    person.instead = [&](const std::string& question) -> std::optional<std::string> {
        if (!holds(question, "Did the grip pull")) return usual(question);
        if (asked++ == 0) return "";
        if (holds(question, "vector")) return "N";
        return values_felt ? "Y" : "n";
    };
    CHECK(run_check(quick(service, folder), person).fault == "");
    CHECK(asked >= 3);
    const Json record = record_in(folder);
    const std::string found = record["findings"]["dialect"];
    CHECK(holds(found, "vector is confirmed by the service but not felt"));
    if (values_felt) {
        CHECK(record["settings"]["dialect"] == "\"values\"");
    } else {
        CHECK_FALSE(record["settings"].contains("dialect"));
        CHECK(holds(found, "no line for the settings file"));
    }
    const Json part = step_in(record, "dialect")["measured"]["vector"];
    CHECK(part["told_back"] == true);
    CHECK(part["felt"] == false);
    CHECK_THAT(part["told_newton"]["x"].get<double>(), WithinAbs(-0.5, 1e-9));
}

TEST_CASE("a force that a person lets go of is not recorded as one that was held",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    const std::string title =
        GENERATE(as<std::string>(), "The format of a force", "The force after the last message",
                 "The force when its connection ends", "Force on a kitchen scale");
    const auto usual = only(title, person);
    person.instead = [&](const std::string& question) -> std::optional<std::string> {
        if (holds(question, "4 N")) return "s";
        return usual(question);
    };
    person.wish_under_force = [&] {
        const bool strong = person.last_newton.x < -0.49 || person.last_newton.z < -1.99;
        return strong ? CheckConsole::Request::release : CheckConsole::Request::none;
    };
    CHECK(run_check(quick(service, folder), person).fault == "");
    CHECK_THAT(person.after_force_newton, WithinAbs(0.0, 1e-12));
    const Json record = record_in(folder);
    if (title != "Force on a kitchen scale") {
        int release = 0;
        for (const Json& step : record["steps"]) release += step["end"] == "let go" ? 1 : 0;
        CHECK(release == 1);
        CHECK(record["findings"]["dialect"].is_null());
        return;
    }
    const Json pushes = step_in(record, "force")["measured"]["pushes"];
    REQUIRE(pushes.size() == 3);
    CHECK(pushes[0]["let_go"] == false);
    CHECK_THAT(pushes[0]["share"].get<double>(), WithinAbs(1.0, 0.01));
    CHECK_THAT(pushes[0]["told_newton"]["z"].get<double>(), WithinAbs(-1.0, 1e-9));
    CHECK_THAT(pushes[0]["position_end_mm"]["z"].get<double>(), WithinAbs(180.0, 1e-9));
    CHECK(pushes[1]["let_go"] == true);
    CHECK(record["findings"]["force"] == "1.00 N of 1 (100 %)");
}

TEST_CASE("the preset is set as the viewer sets it, and all that the service says is kept as JSON",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene = usual_scene();
    scene.arms[0].preset = "led_front";
    scene.behaviour.inventory_at_once = GENERATE(true, false);
    simulated::Service service(scene);
    Person person(service);
    person.instead = only("What the service says", person);
    CHECK(run_check(quick(service, folder), person).fault == "");
    const Json measured = step_in(record_in(folder), "service")["measured"];
    CHECK(measured["inventory_sent_at_once"] == scene.behaviour.inventory_at_once);
    CHECK(measured["inventory"]["inverse3"][0]["config"]["preset"] == "led_front");
    CHECK(measured["preset_before"] == "led_front");
    CHECK(measured["preset"] == "defaults");
    CHECK(measured["type"] == "inverse3");
    CHECK(measured["handedness"] == "right");
    CHECK(measured["kept"]["049D"]["gravity compensation"]["enabled"] == true);
    CHECK(measured["kept"]["049D"]["force scale"] == "not answered");
}

TEST_CASE("rate and steps of the position are those of the motion, whatever the hand rests",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    person.instead = only("Steps and workspace", person);
    person.motion = [](double t_s) {  // in the first half of a second 200 a second by 0.05 mm
        const double second = std::floor(t_s);
        const double steps = 100.0 * second + std::floor(200.0 * std::min(t_s - second, 0.5));
        return Vec3{5e-5 * steps, -0.15, 0.18 + 1e-12 * t_s};
    };
    CHECK(run_check(quick(service, folder), person).fault == "");
    const Json measured = step_in(record_in(folder), "moving")["measured"];
    CHECK_THAT(measured["new_positions_per_s"].get<double>(), WithinAbs(200.0, 20.0));
    CHECK_THAT(measured["smallest_step_mm"].get<double>(), WithinAbs(0.05, 1e-4));
    CHECK(measured["steps"]["z"]["count"] == 0);
    CHECK(measured["moving_s"].get<double>() < 1.2);
}

TEST_CASE("a grip that nobody moved leaves its questions open", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    person.instead = only("Steps and workspace", person);
    person.motion = [](double) { return Vec3{0.0, -0.15, 0.18}; };
    CHECK(run_check(quick(service, folder), person).fault == "");
    const Json record = record_in(folder);
    CHECK(record["findings"]["step"].is_null());
    CHECK(record["findings"]["workspace"].is_null());
    CHECK(step_in(record, "moving")["measured"]["positions"].get<int>() > 0);
}

TEST_CASE("a silence is recorded as long as it was", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene = usual_scene();
    scene.behaviour.force_held = milliseconds(60);
    simulated::Service service(scene);
    Person person(service);
    person.instead = only("The force after the last message", person);
    CHECK(run_check(quick(service, folder), person).fault == "");
    const Json measured = step_in(record_in(folder), "silence")["measured"];
    for (const Json& line : measured["silences"]) {
        CHECK(line["gap_ms"].get<double>() >= line["silence_ms"].get<double>());
        CHECK_THAT(line["force_before_newton"].get<double>(), WithinAbs(0.5, 1e-9));
    }
    CHECK(measured["still_there_after_ms"].get<double>() >= 5.0);
    CHECK(measured["gone_after_ms"].get<double>() >= 60.0);  // as long as it is held
}

TEST_CASE("a force whose connection ended without a zero is read, and taken off, by the next one",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene = usual_scene();
    scene.behaviour.force_held = milliseconds(0);  // for ever
    scene.behaviour.inventory_at_once = GENERATE(true, false);
    simulated::Service service(scene);
    Person person(service);
    person.instead = only("The force when its connection ends", person);
    const bool quits = GENERATE(false, true);
    const auto connections = service.connections();
    person.wish_under_force = [&] {  // while there is none, its force still acts
        const bool closed =
            service.received().size() > 20 &&
            simulated::Clock::now() - service.received().back().at > milliseconds(50);
        return quits && closed ? CheckConsole::Request::quit : CheckConsole::Request::none;
    };
    CHECK(run_check(quick(service, folder), person).fault == "");
    CHECK(service.connections() > connections + 2);
    CHECK_THAT(person.after_force_newton, WithinAbs(0.0, 1e-12));
    const Json step = step_in(record_in(folder), "closing");
    CHECK(step["end"] == (quits ? "quit" : "done"));
    if (quits) return;
    for (const Json& line : step["measured"]["closings"]) {
        CHECK(line["gap_ms"].get<double>() >= line["closed_ms"].get<double>());
        CHECK(line["told_unasked"] == scene.behaviour.inventory_at_once);
        CHECK_THAT(line["force_newton"].get<double>(), WithinAbs(0.5, 1e-9));
    }
}

TEST_CASE("a hand that rests after plugging in is no frozen entry", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    person.instead = only("Unplugged and plugged in again", person);
    person.moves_after = false;
    CheckOptions options = quick(service, folder);
    options.times.frozen = milliseconds(100);
    CHECK(run_check(options, person).fault == "");
    const Json measured = step_in(record_in(folder), "unplugged")["measured"];
    CHECK(measured["said_out"] == true);
    CHECK(measured["gone_s"].get<double>() > 1.0);
    CHECK(measured["gone_after_enter_s"].get<double>() < 0.0);
    CHECK(measured["frozen_s"].get<double>() < 0.1);
}

TEST_CASE("many values are told in few numbers that are theirs", "[inverse3_check]") {
    Sample sample;
    Histogram histogram;
    for (int k = 0; k < 1'000'000; ++k) {
        sample.add(k % 100);
        histogram.add(k % 100);
    }
    CHECK(sample.count() == 1'000'000);
    CHECK_THAT(sample.quantile(0.5), WithinAbs(50.0, 3.0));
    CHECK_THAT(sample.most(), WithinAbs(99.0, 0.0));
    CHECK(sample.different() <= 100);
    std::size_t counted = 0;
    for (const Json& bin : histogram.as_json()) {
        const auto count = bin["count"].get<std::size_t>();
        counted += count;
        if (bin["up_to_ms"] == 2.0) CHECK(count == 10'000);
        if (bin["up_to_ms"] == 5.0) CHECK(count == 30'000);
    }
    CHECK(counted == 1'000'000);
    CHECK_THAT(Sample().quantile(0.5), WithinAbs(0.0, 0.0));
}

TEST_CASE("an Inverse3 that goes in the middle of the check ends it with a reason",
          "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Service service(usual_scene());
    Person person(service);
    person.wish_under_force = [&] {
        if (person.most_newton > 0.3) {
            service.with([](simulated::Scene& scene) { scene.arms[0].powered = false; });
        }
        return CheckConsole::Request::none;
    };
    CheckOptions options = quick(service, folder);
    options.times.dialect = milliseconds(300);
    // Of the dialect a complaint is a finding; what follows fails.
    const CheckResult result = run_check(options, person);
    CHECK(result.fault.find("lost its calibration or its power") != std::string::npos);
}

TEST_CASE("without a usable Inverse3 the check does not begin", "[inverse3_check]") {
    const test::TemporaryFolder folder;
    simulated::Scene scene = usual_scene();
    scene.arms[0].calibrated = false;
    simulated::Service service(scene);
    Person person(service);
    CHECK_THROWS_AS(run_check(quick(service, folder), person), DeviceError);
    service.with([](simulated::Scene& there) { there.arms.clear(); });
    CHECK_THROWS_AS(run_check(quick(service, folder), person), DeviceError);
    CHECK(service.received().empty());
}
