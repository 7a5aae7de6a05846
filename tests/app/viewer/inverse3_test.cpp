// The whole program touches its sample with a simulated Inverse3, whose service is a real one on a
// real socket.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <iostream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/haptics/safety.hpp"
#include "device/inverse3/simulated/hand_script.hpp"
#include "device/inverse3/simulated/service.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/strokes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using namespace dibhr::inverse3::simulated;
using Catch::Matchers::WithinAbs;

namespace {

using namespace std::chrono_literals;
using Words = std::vector<std::string>;
using TickRows = std::vector<Row>;

constexpr const char* kMeet = "search --sync --onlyvisible --name dibhr sleep 0.1 ";

/// Of 99 ticks in 100. Without other load it is about 2 ms; a busy machine adds to it.
constexpr double kOldestPose_ms = 4.0;

double number_in_session(const std::filesystem::path& session, const std::string& key) {
    const std::filesystem::path told = session.parent_path() / "fact.txt";
    run_shell("sqlite3 '" + session.string() + "' \"SELECT value FROM session WHERE key = '" + key +
              "'\" > '" + told.string() + "'");
    const std::string text = read_text(told);
    REQUIRE_FALSE(text.empty());
    return std::stod(text);
}

/// The program on its display, recording, and the service that it finds.
class Inverse3Scene {
  public:
    explicit Inverse3Scene(Words arguments, Scene scene = scene_with_grip())
        : service(std::move(scene)), script(service), viewer(start(std::move(arguments))) {
        desk.act(kMeet);
    }

    TickRows finish() {
        desk.act(std::string(kMeet) + "key q");
        REQUIRE(viewer.wait() == 0);
        CHECK(read_text(folder / "errors.txt").empty());
        CHECK(service.too_many_in_flight() == 0);
        CHECK(service.not_understood() == 0);
        return read_session(folder / "hand.dibhr");
    }
    void tell(const std::string& line) { CHECK(script.obey(line).empty()); }
    /// The hand goes there, mm from the middle of its box: right, forward, up.
    void move_hand(Vec3 to_mm, double seconds) {
        tell("hand " + std::to_string(to_mm.x) + ' ' + std::to_string(to_mm.y) + ' ' +
             std::to_string(to_mm.z) + ' ' + std::to_string(seconds));
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    }
    [[nodiscard]] Vec3 felt_newton() {
        return service.with([](Scene& scene) {
            scene.forget_old_forces(Clock::now());
            return scene.arms.empty() ? Vec3{0.0} : scene.arms.front().force_newton;
        });
    }
    void wait_for_force() {
        CHECK(eventually([this] { return glm::length(felt_newton()) > 0.5; }));
    }
    void wait_for_zero() {
        CHECK(eventually([this] { return glm::length(felt_newton()) < 1e-12; }));
    }

    static Scene scene_with_grip() {
        Scene scene;
        scene.grips = {Grip{}};
        scene.arms[0].position_m.y -= 0.03;  // before the relief
        return scene;
    }

    const Desk desk{};
    const TemporaryFolder folder{};
    Service service;
    HandScript script;
    Process viewer;

  private:
    Process start(Words arguments) {
        std::filesystem::create_directories(folder / "config/dibhr");
        write_text(folder / "config/dibhr/settings.toml",
                   "[inverse3]\nport = " + std::to_string(service.port()) +
                       "\nolder-port = " + std::to_string(service.older_port()) + "\n");
        arguments.insert(arguments.end(), {"--record", "hand.dibhr", "--seconds", "60"});
        return desk.start_viewer(folder, arguments);
    }
};

}  // namespace

TEST_CASE(
    "the program rests, presses and slides with an Inverse3; its forces are those of dibhr "
    "touch, and the session replays to the same bits",
    "[inverse3][window]") {
    // `touch` has no hand that could swing.
    Inverse3Scene at({"--device", "inverse3", "--stability", "off"});
    at.desk.act("key Home sleep 0.3");            // ten seconds of video to touch
    for (int stroke = 0; stroke < 3; ++stroke) {  // a busy machine passes frames over in some
        at.move_hand({0.0, -3.0, 0.0}, 0.5);
        std::this_thread::sleep_for(300ms);
        at.move_hand({0.0, 7.0, 0.0}, 0.4);
        at.wait_for_force();
        std::this_thread::sleep_for(800ms);
        at.move_hand({14.0, 7.0, 0.0}, 1.0);
        at.move_hand({14.0, -30.0, 0.0}, 0.3);
    }
    const TickRows rows = at.finish();
    run_shell("sqlite3 '" + (at.folder / "hand.dibhr").string() +
              "' \"SELECT value FROM session WHERE key = 'inverse3-id'\" | grep -qx 049D");
    run_shell("sqlite3 '" + (at.folder / "hand.dibhr").string() +
              "' \"SELECT value FROM session WHERE key = 'device'\" | grep -qx 'Haply Inverse3 "
              "049D'");
    CHECK(strongest(rows) <= SafetyLimits{}.max_force_newton + 1e-9);
    const TouchedAgain again = touched_again(rows);
    CHECK(again.contacts > 800);
    CHECK(again.held_back > 100);
    CHECK_THAT(again.worst_newton, WithinAbs(0.0, 1e-12));
    require_same_bits(at.folder, at.folder / "hand.dibhr");
    // The last word to the service is that there is no force.
    const auto heard = at.service.heard();
    const auto last =
        std::find_if(heard.rbegin(), heard.rend(), [](const Heard& one) { return one.drives; });
    REQUIRE(last != heard.rend());
    CHECK_THAT(glm::length(last->force_newton), WithinAbs(0.0, 1e-12));
}

TEST_CASE("with auto the mouse touches until an Inverse3 is ready, while it is gone, and no longer",
          "[inverse3][window]") {
    Scene none;
    none.arms.clear();
    Inverse3Scene at({"--device", "auto", "--log-file", "told.log"}, none);
    at.desk.act("mousemove 330 400 sleep 0.5");
    at.tell("plug");
    at.move_hand({0.0, -30.0, 0.0}, 0.1);
    at.move_hand({0.0, 10.0, 0.0}, 0.3);
    at.wait_for_force();
    at.tell("calibrated off");
    at.wait_for_zero();
    std::this_thread::sleep_for(300ms);
    at.tell("calibrated on");
    at.wait_for_force();
    at.tell("unplug");
    std::this_thread::sleep_for(300ms);
    const TickRows rows = at.finish();

    const auto first =
        std::find_if(rows.begin(), rows.end(), [](const Row& row) { return row.surface; });
    REQUIRE(first != rows.end());
    CHECK(first->stand_in);
    CHECK(rows.back().stand_in);
    const std::string told = read_text(at.folder / "told.log");
    CHECK(contains(told, "device: the Inverse3 049D is not calibrated"));
    CHECK(contains(told, "device: the Inverse3 049D was unplugged"));
    const auto changes = [&] {
        std::size_t count = 0;
        for (std::size_t k = 1; k < rows.size(); ++k) {
            if (rows[k].stand_in == rows[k - 1].stand_in) continue;
            ++count;
            CHECK_THAT(glm::length(rows[k].sent_newton), WithinAbs(0.0, 1e-12));
        }
        return count;
    }();
    CHECK(changes >= 4);
}

TEST_CASE("the grip's buttons record and take the force off", "[inverse3][window]") {
    Inverse3Scene at({"--device", "inverse3"});
    const auto press = [&](const std::string& button) {
        at.tell("button " + button + " down");
        std::this_thread::sleep_for(150ms);
        at.tell("button " + button + " up");
        std::this_thread::sleep_for(350ms);
    };
    at.move_hand({0.0, 10.0, 0.0}, 0.3);
    at.wait_for_force();
    press("B");
    at.wait_for_zero();
    press("C");  // the recording on the command line ends
    press("C");  // and a new one begins
    press("C");
    const TickRows rows = at.finish();
    CHECK(rows.back().cut == static_cast<int>(SafetyCut::off));
    std::size_t recordings = 0;
    for (const auto& entry : std::filesystem::directory_iterator(at.folder.path())) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("dibhr-") && name.ends_with(".dibhr")) ++recordings;
    }
    CHECK(recordings == 1);
}

TEST_CASE("poses stay young while the program decodes, draws and records", "[inverse3][alone]") {
    Scene scene = Inverse3Scene::scene_with_grip();
    scene.manners.tick = GENERATE(1000us, 250us);
    std::vector<double> most_ms;  // a busy machine keeps threads from running now and then
    while (most_ms.size() < 3 && (most_ms.empty() || most_ms.back() > kOldestPose_ms)) {
        Inverse3Scene at({"--device", "inverse3"}, scene);
        at.move_hand({0.0, 8.0, 0.0}, 0.3);
        at.wait_for_force();
        std::this_thread::sleep_for(4s);
        (void)at.finish();
        const auto age_ms = [&](const char* part) {
            return number_in_session(at.folder / "hand.dibhr",
                                     std::string("inverse3-pose-age-") + part + "-ms");
        };
        std::cout << "tick of the service " << scene.manners.tick.count()
                  << " us: age of the pose p50 " << age_ms("half") << ", p99 " << age_ms("most")
                  << ", worst " << age_ms("worst") << " ms\n";
        CHECK(age_ms("half") > 0.0);
        most_ms.push_back(age_ms("most"));
    }
    CHECK(most_ms.back() <= kOldestPose_ms);
}
