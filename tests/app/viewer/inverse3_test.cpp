// The whole program touches with a simulated Inverse3, whose service is a real one on a real
// socket.
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iostream>
#include <string>
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

constexpr auto kPatience = 60s;  // only reached by a failure

/// The value of a fact of the session; the test fails without it.
std::string fact(const std::filesystem::path& session, const std::string& key) {
    const std::filesystem::path told = session.parent_path() / "fact.txt";
    run_shell("sqlite3 '" + session.string() + "' \"SELECT value FROM session WHERE key = '" + key +
              "'\" > '" + told.string() + "'");
    const std::string text = read_text(told);
    CAPTURE(key);
    REQUIRE_FALSE(text.empty());
    return text.substr(0, text.find('\n'));
}

double age_ms(const std::filesystem::path& session, const std::string& part) {
    return std::stod(fact(session, "inverse3-pose-age-" + part + "-ms"));
}

/// Threads that begin in its life have a priority above every program's, where that is allowed: a
/// loaded machine slows the program, not the service, which it would take for one that is too slow.
class ServiceWork {
  public:
    ServiceWork() noexcept {
        const sched_param above{::sched_get_priority_max(SCHED_FIFO) - 1};
        ::sched_setscheduler(0, SCHED_FIFO, &above);
    }
    ~ServiceWork() {
        const sched_param none{0};
        ::sched_setscheduler(0, SCHED_OTHER, &none);
    }
    ServiceWork(const ServiceWork&) = delete;
    ServiceWork& operator=(const ServiceWork&) = delete;
};

/// The program on its display, recording, and the service that it finds.
class Inverse3Scene {
  public:
    /// `settings`: added to the settings file.
    explicit Inverse3Scene(Words arguments, Scene scene = scene_with_grip(),
                           const std::string& settings = {})
        : service(serving(std::move(scene))),
          script(service),
          viewer(start(std::move(arguments), settings)) {
        viewer.wait_for_surface();
    }

    TickRows finish() {
        desk.press("key q");
        REQUIRE(viewer.wait() == 0);
        CHECK(read_text(folder / "errors.txt").empty());
        CHECK(service.too_many_in_flight() == 0);
        CHECK(service.not_understood() == 0);
        return rows();
    }
    /// The ticks recorded up to now.
    [[nodiscard]] TickRows rows() const { return read_session(folder / "hand.dibhr"); }
    void tell(const std::string& line) { CHECK(script.run_line(line).empty()); }
    /// The hand goes there, mm from the middle of its box: right, forward, up; and has arrived.
    void move_hand(Vec3 to_mm, double seconds) {
        tell("hand " + std::to_string(to_mm.x) + ' ' + std::to_string(to_mm.y) + ' ' +
             std::to_string(to_mm.z) + ' ' + std::to_string(seconds));
        const double arrives_s = service.seconds() + seconds;
        wait_until([&] { return service.seconds() > arrives_s; });
    }
    [[nodiscard]] Vec3 felt_newton() {
        return service.with([](Scene& scene) {
            scene.forget_old_forces(Clock::now());
            return scene.arms.empty() ? Vec3{0.0} : scene.arms.front().force_newton;
        });
    }
    void wait_for_force(double newton = 0.6) {
        wait_until([this, newton] { return glm::length(felt_newton()) > newton; });
    }
    void wait_for_zero() {
        wait_until([this] { return glm::length(felt_newton()) < 1e-12; });
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
    WindowProgram viewer;

  private:
    static Service serving(Scene scene) {
        const ServiceWork above_the_program;
        return Service(std::move(scene));
    }
    template <typename Condition>
    static void wait_until(const Condition& is_so) {
        REQUIRE(eventually(is_so, kPatience));
    }
    WindowProgram start(Words arguments, const std::string& settings) {
        std::filesystem::create_directories(folder / "config/dibhr");
        write_text(folder / "config/dibhr/settings.toml",
                   "[inverse3]\nport = " + std::to_string(service.port()) +
                       "\nolder-port = " + std::to_string(service.older_port()) + "\n" + settings);
        arguments.insert(arguments.end(), {"--record", "hand.dibhr", "--size", "320x240"});
        return desk.start_viewer(folder, arguments);
    }
};

bool is_firm(const Row& row) {
    return glm::length(row.sent_newton) > 0.5;
}

}  // namespace

TEST_CASE(
    "the program rests, presses and slides with an Inverse3; its forces are those of dibhr "
    "touch, and the session replays to the same bits",
    "[inverse3][window]") {
    // `touch` has no hand that could swing, nor a service of which it is felt that it is slow, as
    // it is on a busy machine. The sample plays slowly: few frames come late.
    Inverse3Scene at(
        {"--device", "inverse3", "--stability", "off", "--speed", "0.25", "--stiffness", "0.2"});
    const auto is_enough = [](const Stroked& so_far) {
        return so_far.contacts > 800 && so_far.held_back > 100;
    };
    Stroked so_far;
    for (int strokes = 0; strokes < 20 && !is_enough(so_far); ++strokes) {
        at.move_hand({0.0, -3.0, 0.0}, 0.2);
        at.move_hand({0.0, 7.0, 0.0}, 0.2);
        at.wait_for_force();
        at.move_hand({14.0, 7.0, 0.0}, 0.8);
        at.move_hand({14.0, -30.0, 0.0}, 0.2);
        so_far = stroked(at.rows());
    }
    CHECK(is_enough(so_far));
    const TickRows rows = at.finish();
    const std::filesystem::path session = at.folder / "hand.dibhr";
    CHECK(fact(session, "inverse3-id") == "049D");
    CHECK(fact(session, "device") == "Haply Inverse3 049D");
    CHECK(age_ms(session, "half") > 0.0);
    CHECK(age_ms(session, "half") <= age_ms(session, "most"));
    CHECK(age_ms(session, "most") <= age_ms(session, "worst"));
    CHECK(strongest(rows) <= SafetyLimits{}.max_force_newton + 1e-9);
    CHECK_THAT(worst_touched_again(rows), WithinAbs(0.0, 1e-12));
    require_same_bits(at.folder, session);
    // The last message to the service has zero force.
    const auto received = at.service.received();
    const auto last = std::find_if(received.rbegin(), received.rend(),
                                   [](const ReceivedMessage& one) { return one.drives; });
    REQUIRE(last != received.rend());
    CHECK_THAT(glm::length(last->force_newton), WithinAbs(0.0, 1e-12));
}

TEST_CASE("a greater force of a settings file of others is felt when a person agrees to it",
          "[inverse3][window]") {
    Inverse3Scene at({"--device", "inverse3", "--pause"}, Inverse3Scene::scene_with_grip(),
                     "[device]\nmax-force = 8.0\n[window]\npanels-visible = false\n");
    at.move_hand({0.0, 40.0, 0.0}, 0.5);
    at.wait_for_force(3.9);
    CHECK(strongest(at.rows()) <= SafetyLimits{}.max_force_newton + 1e-9);
    at.viewer.act("mousemove 90 126 click 1");
    at.wait_for_force(6.0);
    at.desk.press("key q");
    CHECK(at.viewer.wait() == 0);
    CHECK(contains(read_text(at.folder / "errors.txt"), "asks for Max force [N] 8 in place of 4"));
}

TEST_CASE(
    "with auto the mouse touches until an Inverse3 is ready, while it is gone, and no longer; the "
    "grip's buttons record and take the force off",
    "[inverse3][window]") {
    Scene none = Inverse3Scene::scene_with_grip();
    none.arms.clear();
    Inverse3Scene at({"--device", "auto", "--log-file", "told.log", "--pause"}, none);
    const auto press = [&at](const std::string& button, unsigned bit, const auto& is_done) {
        at.tell("button " + button + " down");
        at.viewer.wait_until([&](const Seen& now) { return now.buttons == bit && is_done(now); });
        at.tell("button " + button + " up");
        at.viewer.wait_until([](const Seen& now) { return now.buttons == 0; });
    };
    const auto by_mouse = [](const Seen& now) { return now.mouse_fallback; };
    const auto by_device = [](const Seen& now) { return !now.mouse_fallback && now.ready; };
    const auto records = [](const Seen& now) { return now.records; };
    const auto rests = [](const Seen& now) { return !now.records; };

    at.viewer.wait_until(by_mouse);
    at.tell("plug");
    at.viewer.wait_until(by_device);
    at.move_hand({0.0, -30.0, 0.0}, 0.1);
    at.move_hand({0.0, 10.0, 0.0}, 0.2);
    at.wait_for_force();
    at.tell("calibrated off");
    at.viewer.wait_until(by_mouse);
    at.wait_for_zero();
    at.tell("calibrated on");
    at.viewer.wait_until(by_device);
    at.wait_for_force();
    at.tell("unplug");
    at.viewer.wait_until(by_mouse);
    at.tell("plug");
    at.viewer.wait_until(by_device);
    at.move_hand({0.0, -30.0, 0.0}, 0.1);
    at.move_hand({0.0, 10.0, 0.0}, 0.2);
    at.wait_for_force();
    press("B", 2, [](const Seen& now) { return !now.force_enabled; });
    at.wait_for_zero();
    press("C", 4, rests);  // the recording on the command line ends
    press("C", 4, records);
    press("C", 4, rests);
    const TickRows rows = at.finish();

    const auto first =
        std::find_if(rows.begin(), rows.end(), [](const Row& row) { return row.surface; });
    REQUIRE(first != rows.end());
    CHECK(first->mouse_fallback);
    const std::string told = read_text(at.folder / "told.log");
    CHECK(contains(told, "device: the Inverse3 049D is not calibrated"));
    CHECK(contains(told, "device: the Inverse3 049D was unplugged"));
    const auto changes = [&] {
        std::size_t count = 0;
        for (auto row = first + 1; row != rows.end(); ++row) {
            if (row->mouse_fallback == (row - 1)->mouse_fallback) continue;
            ++count;
            CHECK_THAT(glm::length(row->sent_newton), WithinAbs(0.0, 1e-12));
        }
        return count;
    }();
    CHECK(changes >= 5);
    CHECK(std::any_of(rows.begin(), rows.end(), is_firm));
    CHECK(rows.back().cut == static_cast<int>(SafetyCut::off));
    std::size_t recordings = 0;
    for (const auto& entry : std::filesystem::directory_iterator(at.folder.path())) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("dibhr-") && name.ends_with(".dibhr")) ++recordings;
    }
    CHECK(recordings == 1);
}

TEST_CASE("poses stay young while the program decodes, draws and records", "[inverse3][bench]") {
    constexpr double kOldest_ms = 2.0;  // of 99 ticks in 100, as measured
    Scene scene = Inverse3Scene::scene_with_grip();
    scene.behaviour.tick = GENERATE(1000us, 250us);
    Inverse3Scene at({"--device", "inverse3"}, scene);
    at.move_hand({0.0, 8.0, 0.0}, 0.3);
    at.wait_for_force();
    const auto before = at.viewer.seen().recorded_rows;
    at.viewer.wait_until([before](const Seen& now) { return now.recorded_rows > before + 4000; });
    (void)at.finish();
    const std::filesystem::path session = at.folder / "hand.dibhr";
    std::cout << "tick of the service " << scene.behaviour.tick.count()
              << " us: age of the pose p50 " << age_ms(session, "half") << ", p99 "
              << age_ms(session, "most") << ", worst " << age_ms(session, "worst") << " ms\n";
    CHECK(age_ms(session, "most") < 5.0 * kOldest_ms);
}
