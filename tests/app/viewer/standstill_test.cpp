// The display, the window's thread or a disk stands still while a hand presses: the force goes off,
// and a signal still ends the program.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/haptics/safety.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/falcon_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Clock = std::chrono::steady_clock;

namespace {

constexpr double kLongest_s = 0.3;

double seconds_since(Clock::time_point moment) {
    return std::chrono::duration<double>(Clock::now() - moment).count();
}

/// SIGTERM ends it within a second, with one line that says what hung and where the recording is,
/// which is whole.
void check_end_by_signal(Process& viewer, const TemporaryFolder& folder,
                         const std::string& hung_while) {
    const auto asked = Clock::now();
    viewer.send(SIGTERM);
    CHECK(viewer.wait() == 1);
    const double taken_s = seconds_since(asked);
    WARN("SIGTERM to exit: " << taken_s << " s");
    CHECK(taken_s < 1.2);  // 1 s, and the same
    const std::string errors = read_text(folder / "errors.txt");
    CHECK(contains(errors, "asked to end, but hung while " + hung_while));
    CHECK(contains(errors, "the recording up to now is in hand.dibhr"));
    CHECK(std::count(errors.begin(), errors.end(), '\n') == 1);
    CHECK(run_dibhr(folder, {"info", "hand.dibhr"}).exit_code == 0);
    CHECK(glm::length(read_session(folder / "hand.dibhr").back().sent_newton) < 1e-12);
    require_same_bits(folder, folder / "hand.dibhr");
}

/// By the clock: on a busy machine ticks are fewer.
double seconds_of_standstills(const std::vector<Row>& rows) {
    double total_s = 0.0;
    for (std::size_t k = 1; k < rows.size(); ++k)
        if (rows[k - 1].cut == static_cast<int>(SafetyCut::standstill))
            total_s += rows[k].t_s - rows[k - 1].t_s;
    return total_s;
}

/// A disk whose files with `part` in their path stand still, on demand.
class Stall {
  public:
    explicit Stall(std::string part)
        : part_(std::move(part)),
          lock_(::open(file().c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600)) {}
    ~Stall() { ::close(lock_); }
    Stall(const Stall&) = delete;
    Stall& operator=(const Stall&) = delete;

    [[nodiscard]] std::vector<std::string> environment() const {
        return {"LD_PRELOAD=" STALLING_DISK, "STALL_PATH=" + part_, "STALL_WHILE=" + file()};
    }
    void begin() const { REQUIRE(::flock(lock_, LOCK_EX) == 0); }
    void end() const { REQUIRE(::flock(lock_, LOCK_UN) == 0); }

  private:
    [[nodiscard]] std::string file() const { return (folder_ / "lock").string(); }

    TemporaryFolder folder_{};
    std::string part_;
    int lock_;
};

}  // namespace

TEST_CASE("a display that stops takes the force off, and SIGTERM ends the program all the same",
          "[ways out]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"});
    at.press_in();
    const auto stopped = Clock::now();
    at.desk.stop();
    const double off_s = at.seconds_to_zero(stopped);
    WARN("display stopped to zero force: " << off_s << " s");
    CHECK(off_s < kLongest_s);
    check_end_by_signal(at.viewer, at.folder, "drawing");
}

TEST_CASE("an X server that dies leaves the Falcon without force within 100 ms", "[ways out]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"});
    at.press_in();
    const auto killed = Clock::now();
    at.desk.kill();
    CHECK(at.viewer.wait() == 1);
    const double off_s = at.seconds_to_zero(killed);
    WARN("X server killed to zero force: " << off_s << " s");
    CHECK(off_s < 0.1);
    require_same_bits(at.folder, at.folder / "hand.dibhr");
}

TEST_CASE("a display that goes on gives the force back, and what was recorded replays",
          "[ways out]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"});
    at.press_in();
    at.desk.stop();
    CHECK(at.seconds_to_zero(Clock::now()) < kLongest_s);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    CHECK(glm::length(at.falcon.vector("motor_newton")) < 1e-6);
    at.desk.resume();
    at.wait_for_force();
    CHECK(seconds_of_standstills(at.finish()) > 0.4);
    require_same_bits(at.folder, at.folder / "hand.dibhr");
}

TEST_CASE("a window's thread that loops for ever holds no force, nor the program", "[ways out]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"}, {}, {"DIBHR_TEST_HANG_AFTER_S=8"});
    at.press_in();
    at.wait_for_lasting_zero();
    check_end_by_signal(at.viewer, at.folder, "drawing");
    CHECK(seconds_of_standstills(read_session(at.folder / "hand.dibhr")) > 0.2);
}

TEST_CASE("a file that is opened from a disk that stands still does not hold up the end",
          "[ways out]") {
    const Stall stall("z_color");
    const Desk desk;
    const TemporaryFolder folder;
    run_shell(
        folder,
        "for name in a z; do for kind in color depth; do ffmpeg -nostdin -v error -y -f lavfi "
        "-i color=gray:s=64x48:r=10:d=2 -c:v ffv1 ${name}_$kind.mkv; done; done");
    std::vector<std::string> host = stall.environment();
    host.insert(host.begin(), "env");
    Process viewer = desk.start_viewer(
        folder, {"a_color.mkv", "--device", "mouse", "--size", "320x240", "--screenshot", "a.png"},
        host);
    desk.act("search --sync --onlyvisible --name dibhr sleep 0.6");
    stall.begin();
    desk.act("search --name dibhr key ctrl+Next sleep 1");
    const auto asked = Clock::now();
    desk.act("search --name dibhr key q");
    CHECK(viewer.wait() == 0);
    CHECK(seconds_since(asked) < 2.0);
    CHECK(read_text(folder / "errors.txt").empty());
    CHECK(std::filesystem::exists(folder / "a.png"));
}

TEST_CASE("a clip on a disk that stands still does not hold up the end for ever", "[ways out]") {
    const Stall stall("all.mp4");
    const Desk desk;
    const TemporaryFolder folder;
    std::vector<std::string> host = stall.environment();
    host.insert(host.begin(), "env");
    Process viewer = desk.start_viewer(
        folder, {"--device", "mouse", "--size", "320x240", "--clip", "all.mp4"}, host);
    desk.act("search --sync --onlyvisible --name dibhr sleep 2");
    stall.begin();
    desk.act("search --name dibhr sleep 0.5");
    const auto killed = Clock::now();
    desk.kill();
    CHECK(viewer.wait() == 1);
    CHECK(seconds_since(killed) < 9.0);
    CHECK(
        contains(read_text(folder / "errors.txt"),
                 "all.mp4: the clip is not finished after 5 s, what there is of it is beside it"));
}

TEST_CASE("a second signal ends a program that hangs at once", "[ways out]") {
    const Desk desk;
    const TemporaryFolder folder;
    Process viewer = desk.start_viewer(folder, {"--device", "mouse", "--record", "hand.dibhr"},
                                       {"env", "DIBHR_TEST_HANG_AFTER_S=0"});
    FalconOnUsb::wait_until([&] { return std::filesystem::exists(folder / "hand.dibhr"); });
    std::this_thread::sleep_for(std::chrono::seconds(2));
    const auto asked = Clock::now();
    viewer.interrupt();
    viewer.send(SIGHUP);  // of the same wish
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    viewer.interrupt();
    CHECK(viewer.wait() == 1);
    CHECK(seconds_since(asked) < 0.55);
    CHECK(contains(read_text(folder / "errors.txt"), "asked twice to end"));
}

TEST_CASE("a disk under the recording that stops takes the force off until it goes on",
          "[ways out]") {
    const Stall stall("hand.dibhr");
    FalconScene at(kHomedFalcon, {"--device", "falcon"}, {}, stall.environment());
    at.press_in();
    const auto stopped = Clock::now();
    stall.begin();
    const double off_s = at.seconds_to_zero(stopped);
    WARN("disk of the recording stopped to zero force: " << off_s << " s");
    CHECK(off_s < kLongest_s + 0.12);  // it writes ten times a second
    stall.end();
    at.wait_for_force();
    CHECK(seconds_of_standstills(at.finish()) > 0.02);
    require_same_bits(at.folder, at.folder / "hand.dibhr");
}

TEST_CASE("a disk under the video that stops takes the force off, and a signal ends the program",
          "[ways out]") {
    const Stall stall("sample/depth.mp4");
    const Desk desk;
    const TemporaryFolder folder;
    std::vector<std::string> host =
        stall.environment();  // with a Falcon's bus it would be bypassed
    host.insert(host.begin(), "env");
    Process viewer =
        desk.start_viewer(folder, {"--device", "mouse", "--record", "hand.dibhr"}, host);
    desk.act("search --sync --onlyvisible --name dibhr mousemove 330 400 sleep 0.7 mousedown 1");
    desk.act("sleep 1");
    stall.begin();
    std::this_thread::sleep_for(std::chrono::seconds(2));  // what was read ahead is played first
    check_end_by_signal(viewer, folder, "closing the window");
    const std::vector<Row> rows = read_session(folder / "hand.dibhr");
    CHECK(seconds_of_standstills(rows) > 0.5);
    // Up to the signal, which also makes the hand not ready.
    std::size_t at = rows.size();
    while (at > 0 && !rows[at - 1].ready) --at;
    REQUIRE(at > 300);
    int late = 0;  // which is told first, and happens on a busy machine
    for (std::size_t k = at - 300; k < at; ++k) {
        const bool is_late = rows[k].t_s - rows[k - 1].t_s > SafetyLimits{}.max_tick_s;
        late += is_late ? 1 : 0;
        CHECK(rows[k].cut ==
              static_cast<int>(is_late ? SafetyCut::late_tick : SafetyCut::standstill));
        CHECK(rows[k].contact);
        CHECK(glm::length(rows[k].spring_newton) > 0.01);
        CHECK(glm::length(rows[k].sent_newton) < 1e-12);
    }
    CHECK(late < 10);
}
