// A window in which nothing changes draws nothing; it is drawn again once something does.
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/falcon_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr::test;

namespace {

/// Of the window's loop: at rest a second or more, in which all that changes by itself does.
constexpr std::uint64_t kTurns = 30;
constexpr int kRate = 20;  ///< frames of the film in a second

/// Ten seconds of film that moves, and of one that does not, as sources of ffmpeg.
const std::string kMoving = "testsrc=s=64x48:r=" + std::to_string(kRate) + ":d=10";
const std::string kStill = "testsrc=s=64x48:r=" + std::to_string(kRate) + ":d=0.05,loop=199:1";
/// The same with many columns.
const std::string kWideStill =
    "testsrc=s=1280x96:r=" + std::to_string(kRate) + ":d=0.05,loop=199:1";

/// Film, opened in a small window.
struct FilmWindow {
    const Desk desk{};
    const TemporaryFolder folder{};
    WindowProgram viewer;

    explicit FilmWindow(const std::vector<std::string>& options, const std::string& film = kMoving,
                        const std::string& settings = {})
        : viewer(start(options, film, settings)) {
        viewer.wait_for_surface();
    }
    [[nodiscard]] WindowProgram start(const std::vector<std::string>& options,
                                      const std::string& film, const std::string& settings) const {
        run_shell(folder, "ffmpeg -nostdin -v error -f lavfi -i " + film +
                              " -c:v ffv1 film_color.mkv -c:v ffv1 -pix_fmt gray film_depth.mkv");
        std::filesystem::create_directories(folder / "config/dibhr");
        write_text(folder / "config/dibhr/settings.toml", settings);
        std::vector<std::string> arguments{"film_color.mkv", "--raw-depth", "--device",
                                           "mouse",          "--size",      "640x480"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return desk.start_viewer(folder, arguments);
    }
    /// Does so with the window of the viewer.
    void change_window(const std::string& how) const {
        run_shell("export DISPLAY=" + desk.display() + "; xdotool " + how +
                  " $(xdotool search --class dibhr | tail -1)");
    }
    /// A part of the relief over which nothing is drawn, row by row.
    [[nodiscard]] std::vector<std::string> relief() const {
        constexpr std::size_t kLeft = 80, kRight = 320, kTop = 60, kBottom = 380, kColumns = 1280;
        const std::string whole = desk.picture();
        std::vector<std::string> rows;
        for (std::size_t y = kTop; y < kBottom; ++y)
            rows.push_back(whole.substr(3 * (y * kColumns + kLeft), 3 * (kRight - kLeft)));
        return rows;
    }
    /// Its picture once nothing changes any more.
    [[nodiscard]] std::vector<std::string> relief_at_rest() const;
    void quit() {
        // A window that was unmapped has the keyboard only where the pointer is.
        desk.press("mousemove 150 300 key q");
        REQUIRE(viewer.wait() == 0);
    }
};

/// How many pictures are drawn in so many turns of the window.
std::uint64_t pictures_in(const WindowProgram& viewer, std::uint64_t turns) {
    const Seen begin = viewer.seen();
    viewer.wait_until([&](const Seen& now) { return now.turn >= begin.turn + turns; });
    return viewer.seen().picture - begin.picture;
}

/// Until all that was done before has settled.
void wait_for_rest(const WindowProgram& viewer, std::uint64_t turns = kTurns) {
    REQUIRE(eventually([&] { return pictures_in(viewer, turns) == 0; }));
}

std::vector<std::string> FilmWindow::relief_at_rest() const {
    wait_for_rest(viewer);
    return relief();
}

/// A window at rest that is drawn when `act` is done, and then rests again.
template <typename Act>
void check_drawn_by(const WindowProgram& viewer, const std::string& what, const Act& act) {
    INFO("drawn by " << what);
    const std::uint64_t before = viewer.seen().picture;
    act();
    viewer.wait_until([before](const Seen& now) { return now.picture > before; });
    wait_for_rest(viewer);
}

}  // namespace

TEST_CASE("a paused window draws nothing while its loop goes on, until something changes in it",
          "[rest]") {
    FilmWindow film({"--pause"});
    wait_for_rest(film.viewer);
    const std::uint64_t ticks = film.viewer.seen().ticks;
    CHECK(pictures_in(film.viewer, kTurns) == 0);
    CHECK(film.viewer.seen().ticks > ticks);
    check_drawn_by(film.viewer, "a key", [&] { film.desk.press("key k"); });
    check_drawn_by(film.viewer, "the pointer", [&] { film.desk.press("mousemove 150 300"); });
    check_drawn_by(film.viewer, "a frame", [&] { film.desk.press("key period"); });
    CHECK(film.viewer.seen().drawn_frame == 1);
    check_drawn_by(film.viewer, "a seek", [&] { film.desk.press("key Right"); });
    CHECK(film.viewer.seen().drawn_frame == 5 * kRate + 1);

    constexpr std::uint64_t kNotice = 110;  // turns at rest: longer than a notice is there
    wait_for_rest(film.viewer, kNotice);
    const std::string before = film.desk.picture();
    {
        WindowProgram other = film.desk.start(film.folder, {}, {OTHER_WINDOW});
        REQUIRE(eventually([&] { return film.desk.picture() != before; }));
        other.send(SIGTERM);
        REQUIRE(other.wait() == 0);
    }
    CHECK(eventually([&] { return film.desk.picture() == before; }));
    film.quit();
}

TEST_CASE("a window that is not mapped draws nothing; its video waits, and goes on with it",
          "[rest]") {
    FilmWindow film({});
    film.viewer.wait_until([](const Seen& now) { return now.playing; });
    film.change_window("windowunmap");
    film.viewer.wait_until([](const Seen& now) { return !now.playing; });
    const Seen hidden = film.viewer.seen();
    CHECK(pictures_in(film.viewer, kTurns) == 0);
    CHECK(film.viewer.seen().ticks > hidden.ticks);
    film.change_window("windowmap");
    film.viewer.wait_until(
        [&](const Seen& now) { return now.playing && now.picture > hidden.picture; });
    film.quit();
}

TEST_CASE("software draws a video that runs once a frame", "[rest]") {
    FilmWindow film({});
    const Seen begin = film.viewer.seen();
    film.viewer.wait_until([&](const Seen& now) { return now.media_s > begin.media_s + 4.0; });
    const Seen end = film.viewer.seen();
    const double frames = kRate * (end.media_s - begin.media_s);
    constexpr double kSettling = 5.0;  // of what stands over the relief, and at both ends
    const auto pictures = static_cast<double>(end.picture - begin.picture);
    CHECK(pictures < frames + kSettling);
    CHECK(pictures > frames / 4.0);  // a busy machine does not draw all
    film.quit();
}

TEST_CASE(
    "software draws a large video that runs coarsely, and where it stops as if it had never run",
    "[rest]") {
    std::vector<std::string> coarse;
    {
        FilmWindow film({"--pause"}, kWideStill, "[look]\ncoarse = true\n");
        coarse = film.relief_at_rest();
        film.quit();
    }
    FilmWindow film({"--pause"}, kWideStill);
    const std::vector<std::string> fine = film.relief_at_rest();
    CHECK(fine != coarse);
    film.desk.press("mousemove 10 10 key space");
    CHECK(eventually([&] { return film.relief() == coarse; }));
    film.desk.press("key space key Home");
    film.viewer.wait_until([](const Seen& now) { return !now.playing && now.media_s == 0.0; });
    CHECK(film.relief_at_rest() == fine);
    film.quit();
}

TEST_CASE(
    "a resting window leaves a resting hand its force, is drawn when the hand moves, and when it "
    "hangs the force goes",
    "[rest]") {
    constexpr double kLasting = 200.0;  // packets, one after the other
    // Longer than a window may be silent that leaves a force on the hand.
    constexpr std::uint64_t kManyBeats = 12;
    // The limit of the force is what a busy machine does not change.
    FalconScene at({.records = false,
                    .settings = "[device]\nmax-force = 1.0\n[window]\npanels-visible = false\n"});
    wait_for_rest(at.viewer);
    check_drawn_by(at.viewer, "a hand that moves", [&] {
        at.falcon.move_hand({0.0, 0.0, 125.0}, 0.2);
    });
    at.press_in();
    CHECK(eventually([&] {
        return pictures_in(at.viewer, kManyBeats) == 0 && at.viewer.seen().sent_newton > 0.9;
    }));
    at.falcon.wait_for_forces(kLasting);
    at.viewer.hang();
    at.falcon.wait_for_zeros(kLasting);
    at.viewer.go_on();
    at.wait_for_force();
    at.desk.press("key q");
    CHECK(at.viewer.wait() == 0);
}
