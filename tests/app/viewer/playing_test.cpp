// Keys that move a video, typed into the real window; the recording shows where it went.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/settings/file_memory.hpp"
#include "core/haptics/safety.hpp"
#include "core/session/session.hpp"
#include "core/video/sources/media.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

namespace fs = std::filesystem;
using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kFrame_s = 0.1;

/// 100 seconds of film, which all tests read and none changes.
const TemporaryFolder& long_films() {
    static const TemporaryFolder folder;
    static const bool made = [] {
        const std::string film =
            "ffmpeg -nostdin -v error -f lavfi -i color=gray:s=64x48:r=10:d=100";
        run_shell(folder, film + " -c:v ffv1 long_color.mkv");
        run_shell(folder, film + ",format=gray -c:v ffv1 long_depth.mkv");
        return true;
    }();
    static_cast<void>(made);
    return folder;
}

/// A window over a long film, and what is recorded in it.
class FilmWindow {
  public:
    explicit FilmWindow(std::vector<std::string> options, const std::string& settings = {})
        : FilmWindow(long_films() / "long_color.mkv", std::make_shared<TemporaryFolder>(),
                     raw(std::move(options)), settings) {}

    /// With the files saved in `home`.
    FilmWindow(const fs::path& film, std::shared_ptr<TemporaryFolder> home,
               std::vector<std::string> options, const std::string& settings = {})
        : home_(std::move(home)),
          session_(new_session_file(*home_)),
          viewer_(start(film, std::move(options), settings)) {
        viewer_.wait_for_surface();
    }

    [[nodiscard]] const TemporaryFolder& home() const { return *home_; }
    [[nodiscard]] Seen seen() const { return viewer_.seen(); }
    void act(const std::string& events) const { viewer_.act(events); }
    template <typename Condition>
    void wait_until(const Condition& is_so) const {
        viewer_.wait_until(is_so);
    }
    void let_ticks_pass(std::uint64_t ticks) const { wait_for_ticks(viewer_, ticks); }

    /// Keys, one after the other as quickly as a hand can, between two pictures.
    void press_at_once(const std::vector<std::string>& keys) const {
        viewer_.send(SIGSTOP);
        for (const std::string& key : keys) {
            desk_.press("key " + key);
            // GLFW takes a press in the same millisecond for the one before.
            std::this_thread::sleep_for(std::chrono::milliseconds(25));
        }
        viewer_.send(SIGCONT);
    }

    /// Waits until the frame of that moment is drawn and touched.
    void comes_to(double media_s, double within_s = 1.5 * kFrame_s) const {
        const auto is_there = [=](const Seen& now) {
            return now.surface && std::abs(now.drawn_s - media_s) <= within_s &&
                   std::abs(now.media_s - media_s) <= within_s;
        };
        INFO("waits for " << media_s << " s");
        viewer_.wait_until(is_there);
        // A drawn frame was published to the ticks before.
        const std::uint64_t ticks = seen().ticks + 2;
        viewer_.wait_until(
            [&](const Seen& now) { return is_there(now) && now.touchable && now.ticks >= ticks; });
    }

    /// Waits until the video has looped so often.
    void wait_for_laps(int laps) const {
        double before_s = seen().media_s;
        viewer_.wait_until([&](const Seen& now) {
            if (now.media_s < before_s - 3.0 * kFrame_s) --laps;
            before_s = now.media_s;
            return laps <= 0;
        });
    }

    /// Ends the window; returns its recording.
    [[nodiscard]] std::vector<Row> end() {
        desk_.press("key q");
        REQUIRE(viewer_.wait() == 0);
        return read_session(session_);
    }
    [[nodiscard]] std::vector<SessionMark> marks() const { return Session(session_).marks(); }
    [[nodiscard]] std::vector<std::string> touched_depths() const {
        std::vector<std::string> files;
        const Session session(session_);
        for (const SessionSource& source : session.sources())
            files.push_back(source.depth.file.filename().string());
        files.erase(std::unique(files.begin(), files.end()), files.end());
        return files;
    }

  private:
    static std::vector<std::string> raw(std::vector<std::string> options) {
        options.emplace_back("--raw-depth");
        return options;
    }
    static fs::path new_session_file(const TemporaryFolder& home) {
        for (int number = 1;; ++number) {
            const fs::path session = home / ("hand" + std::to_string(number) + ".dibhr");
            if (!fs::exists(session)) return session;
        }
    }
    WindowProgram start(const fs::path& film, std::vector<std::string> options,
                        const std::string& settings) const {
        if (!settings.empty()) {
            fs::create_directories(*home_ / "config/dibhr");
            write_text(*home_ / "config/dibhr/settings.toml", settings);
        }
        options.insert(options.begin(), {film.string(), "--device", "mouse", "--record",
                                         session_.string(), "--size", "640x480"});
        return desk_.start_viewer(*home_, options);
    }

    Desk desk_{};
    std::shared_ptr<TemporaryFolder> home_;
    fs::path session_;
    WindowProgram viewer_;
};

/// Checks that these moments of the video were touched, in this order.
void check_touched(const std::vector<Row>& rows, const std::vector<double>& wanted_s) {
    auto row = rows.begin();
    for (const double media_s : wanted_s) {
        CAPTURE(media_s);
        row = std::find_if(row, rows.end(), [media_s](const Row& one) {
            return one.surface && std::abs(one.video_s - media_s) <= 1.5 * kFrame_s;
        });
        REQUIRE(row != rows.end());
    }
}

/// Rows from one time of the ticks to another.
std::vector<Row> rows_between(const std::vector<Row>& rows, double from_s, double to_s) {
    std::vector<Row> some;
    for (const Row& row : rows)
        if (row.t_s >= from_s && row.t_s < to_s && row.surface) some.push_back(row);
    return some;
}

/// How fast the video goes on in most of the ticks in which it does.
double speed_in(const std::vector<Row>& rows) {
    std::vector<double> speeds;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const double moved_s = rows[k].video_s - rows[k - 1].video_s;
        if (moved_s > 0.0) speeds.push_back(moved_s / (rows[k].t_s - rows[k - 1].t_s));
    }
    REQUIRE(speeds.size() > 20);
    const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
    std::nth_element(speeds.begin(), middle, speeds.end());
    return *middle;
}

/// Checks that playing loops at least once and never leaves the part.
void check_laps(const std::vector<Row>& rows, double from_s, double to_s) {
    REQUIRE(rows.size() > 100);
    double least_s = rows.front().video_s, most_s = rows.front().video_s;
    int laps = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        least_s = std::min(least_s, rows[k].video_s);
        most_s = std::max(most_s, rows[k].video_s);
        if (rows[k].video_s < rows[k - 1].video_s - 3.0 * kFrame_s) ++laps;
    }
    CHECK(least_s >= from_s - kFrame_s);
    CHECK(most_s <= to_s + kFrame_s);
    CHECK(laps > 0);
}

/// Where each press met the relief.
std::vector<Vec3> pressed_places(const std::vector<Row>& rows) {
    std::vector<Vec3> places;
    bool met = false;
    for (const Row& row : rows) {
        if (row.pressed && row.contact && !met) places.push_back(row.proxy);
        met = row.pressed && (met || row.contact);
    }
    return places;
}

/// Presses where the pointer is, when the hand has come there.
void press_and_release(const FilmWindow& film) {
    film.let_ticks_pass(kTicksToRest);
    film.act("mousedown 1");
    film.wait_until([](const Seen& now) { return now.contact; });
    film.act("mouseup 1");
    film.wait_until([](const Seen& now) { return !now.contact; });
}

/// Three films in a folder of it.
std::shared_ptr<TemporaryFolder> home_with_films() {
    auto home = std::make_shared<TemporaryFolder>();
    fs::create_directory(*home / "films");
    for (const std::string of : {"_color.mkv", "_depth.mkv"}) {
        for (const std::string name : {"films/long", "films/other", "films/still"})
            fs::copy_file(long_films() / ("long" + of), *home / (name + of));
    }
    return home;
}

/// By its button.
void open_dialog(const FilmWindow& film) {
    film.act("mousemove 387 93 click 1");
    film.wait_until([](const Seen& now) { return now.dialog && now.dialog_entries == 3; });
}

}  // namespace

TEST_CASE(
    "arrows seek by 5, 1 and 60 seconds, Home and End to the start and the last second, and every "
    "press counts, also of many between two pictures",
    "[playing]") {
    FilmWindow film({"--start", "42", "--pause"});
    film.comes_to(42.0);
    std::vector<double> wanted{42.0};
    const auto goes_to = [&](double media_s) {
        film.comes_to(media_s);
        wanted.push_back(media_s);
    };
    const std::vector<std::pair<std::string, double>> presses{
        {"Home", 0.0},        {"Up", 60.0},   {"Right", 65.0}, {"shift+Right", 66.0},
        {"shift+Left", 65.0}, {"Left", 60.0}, {"Down", 0.0}};
    for (const auto& [key, media_s] : presses) {
        film.act("key " + key);
        goes_to(media_s);
    }
    film.press_at_once({"Right", "Up", "Right", "Right"});
    goes_to(75.0);
    for (int k = 0; k < 5; ++k) {
        film.press_at_once({"shift+Left"});
        goes_to(wanted.back() - 1.0);
    }
    film.act("key End");
    goes_to(99.0);
    CHECK_FALSE(film.seen().playing);
    check_touched(film.end(), wanted);
}

TEST_CASE("own keys move the video, and are lost to what had them", "[playing]") {
    FilmWindow film({},
                    "[keys]\nplay-or-pause = [\"F5\", \"Z\"]\nseek-forward-far = \"L\"\n"
                    "go-to-end = \"Shift+L\"\nseek-forward = \"Home\"\ngo-to-start = \"Ctrl+G\"\n");
    REQUIRE(film.seen().playing);
    film.act("key F5");
    CHECK_FALSE(film.seen().playing);
    film.act("key z");
    CHECK(film.seen().playing);
    film.act("key z");
    CHECK_FALSE(film.seen().playing);
    double at_s = 0.0;
    const auto seeks = [&](const std::string& key, double media_s) {
        film.act("key " + key);
        film.comes_to(media_s);
        at_s = film.seen().media_s;
    };
    const auto does_nothing = [&](const std::string& key) {
        CAPTURE(key);
        film.act("key " + key);
        CHECK_FALSE(film.seen().playing);
        CHECK(film.seen().media_s == at_s);
    };
    seeks("ctrl+g", 0.0);
    does_nothing("space");
    seeks("l", 60.0);
    does_nothing("Up");
    seeks("Home", 65.0);
    does_nothing("End");
    seeks("shift+l", 99.0);
    seeks("ctrl+g", 0.0);
    check_touched(film.end(), {0.0, 60.0, 65.0, 99.0, 0.0});
}

TEST_CASE(
    "options and keys say what part is played again and again, and how fast; a key plays all again",
    "[playing]") {
    FilmWindow film({"--start", "10", "--end", "11", "--loop", "on", "--speed", "4"});
    film.wait_for_laps(2);
    film.act("key m");
    const double all_from_s = film.seen().media_s;
    film.act("key a");
    CHECK(film.seen().part_to_s < 0.0);
    film.wait_until([](const Seen& now) { return now.drawn_s > 13.0; });
    film.act("key a");
    const double from_s = film.seen().part_from_s;
    CHECK(from_s > all_from_s);
    film.wait_until([=](const Seen& now) { return now.media_s > from_s + 1.0; });
    film.act("key a");
    const double to_s = film.seen().part_to_s;
    CHECK(film.seen().part_from_s == from_s);
    CHECK(to_s > from_s + 1.0);
    film.wait_for_laps(1);
    film.act("key m");
    film.wait_for_laps(2);
    film.act("key m key a");
    film.wait_until([=](const Seen& now) { return now.drawn_s > to_s + 1.0; });
    film.act("key BackSpace");
    CHECK(film.seen().speed == 1.0);
    film.act("key m");
    film.let_ticks_pass(400);
    film.act("key m key Prior");
    CHECK(film.seen().speed == 2.0);
    film.act("key m");
    film.let_ticks_pass(400);
    film.act("key m");

    std::vector<Row> rows = film.end();
    std::vector<double> at_s;
    for (const SessionMark& mark : film.marks()) at_s.push_back(mark.t_s);
    REQUIRE(at_s.size() == 7);
    // It is opened at its very beginning, and sought to the part at once.
    const auto first = std::find_if(rows.begin(), rows.end(), [](const Row& row) {
        return row.surface && row.video_s >= 10.0 - kFrame_s;
    });
    REQUIRE(first != rows.end());
    const std::vector<Row> asked = rows_between(rows, first->t_s, at_s[0]);
    check_laps(asked, 10.0, 11.0);
    CHECK_THAT(speed_in(asked), WithinAbs(4.0, 0.01));
    check_laps(rows_between(rows, at_s[1], at_s[2]), from_s, to_s);
    CHECK_THAT(speed_in(rows_between(rows, at_s[3], at_s[4])), WithinAbs(1.0, 0.01));
    CHECK_THAT(speed_in(rows_between(rows, at_s[5], at_s[6])), WithinAbs(2.0, 0.01));
}

TEST_CASE(
    "options say that a part is played once, on the whole screen, whose size is not kept; after it "
    "the film is played to its own end",
    "[playing]") {
    FilmWindow film({"--start", "10", "--end", "11", "--loop", "off", "--speed", "4",
                     "--full-screen", "--screenshot", "last.png"});
    const auto stands_still = [](const Seen& now) { return now.surface && !now.playing; };
    film.wait_until(stands_still);
    film.comes_to(11.0);
    CHECK(film.seen().columns == 1280);
    CHECK(film.seen().rows == 800);
    film.act("key a key End");
    CHECK(film.seen().part_to_s < 0.0);
    film.comes_to(99.0);
    film.act("key space");
    film.wait_until(stands_still);
    film.comes_to(100.0 - kFrame_s, 0.5 * kFrame_s);

    std::vector<Row> rows = film.end();
    std::erase_if(rows, [](const Row& row) {
        return !row.surface || row.video_s < 10.0 - kFrame_s || row.video_s > 95.0;
    });
    REQUIRE(rows.size() > 100);
    const auto earlier = [](const Row& a, const Row& b) { return a.video_s < b.video_s; };
    CHECK(std::is_sorted(rows.begin(), rows.end(), earlier));
    CHECK(rows.back().video_s <= 11.0 + kFrame_s);
    const MediaDescription picture = describe_media(film.home() / "last.png");
    CHECK(picture.colour_columns == 1280);
    CHECK(picture.colour_rows == 800);
    run_shell("! grep -rqE '1280|800' '" + film.home().path().string() +
              "' --include=settings.toml");
}

TEST_CASE(
    "a copied view is taken again: the hand then touches where it did; with the panels hidden the "
    "force switch stays, and the time line comes to the pointer",
    "[playing]") {
    FilmWindow film({"--start", "20", "--pause"});
    film.comes_to(20.0);
    film.act("mousemove 200 260 key ctrl+c");
    press_and_release(film);
    film.act("click 4 click 4 click 4 click 4");
    press_and_release(film);
    film.act("key ctrl+v");
    press_and_release(film);

    film.act("key Tab");
    CHECK_FALSE(film.seen().panels);
    // The switch in the corner, where nothing else is.
    film.act("mousemove 590 460 click 1");
    CHECK_FALSE(film.seen().force_enabled);
    film.wait_until([](const Seen& now) { return now.cut == static_cast<int>(SafetyCut::off); });
    film.act("click 1");
    CHECK(film.seen().force_enabled);
    film.wait_until([](const Seen& now) { return now.cut != static_cast<int>(SafetyCut::off); });
    // The line, a little right of its middle.
    film.act("mousemove 200 452 click 1");
    film.wait_until([](const Seen& now) { return now.drawn_s > 21.0 && now.touchable; });
    CHECK(film.seen().drawn_s < 95.0);

    const std::vector<Row> rows = film.end();
    const std::vector<Vec3> touched = pressed_places(rows);
    REQUIRE(touched.size() == 3);
    CHECK(glm::length(touched[1] - touched[0]) > 2.0);
    CHECK(glm::length(touched[2] - touched[0]) < 0.5);
    CHECK(rows.back().video_s > 21.0);
}

TEST_CASE(
    "while E explains an update the video stands still, its step keys step the explanation, "
    "and the hand is felt on",
    "[playing]") {
    FilmWindow film({"--start", "20", "--friction", "0"});
    film.wait_until([](const Seen& now) { return now.drawn_s >= 20.0; });
    film.act("mousemove 200 250");
    film.let_ticks_pass(kTicksToRest);
    film.act("mousedown 1");
    film.wait_until([](const Seen& now) { return now.contact; });
    film.let_ticks_pass(kTicksToRest);
    film.act("key e");
    film.wait_until([](const Seen& now) { return now.explained && !now.playing; });
    film.let_ticks_pass(kTicksToRest);
    const double still_s = film.seen().media_s;
    film.act("mousemove 300 250");
    film.let_ticks_pass(kTicksToRest);
    film.act("key period");
    CHECK(film.seen().explained_steps == 1);
    film.act("key period");
    CHECK(film.seen().explained_steps == 2);
    CHECK(film.seen().media_s == still_s);
    film.act("key e");
    CHECK_FALSE(film.seen().explained);
    CHECK_FALSE(film.seen().playing);
    film.act("key period");  // paused between two frames, it steps to the next one
    film.wait_until([=](const Seen& now) { return now.drawn_s > still_s && now.touchable; });
    CHECK(film.seen().drawn_s <= still_s + 1.01 * kFrame_s);

    const std::vector<Row> rows = film.end();
    const auto in_still = [&](const Row& row) {
        return row.surface && row.contact && std::abs(row.video_s - still_s) < 1e-6;
    };
    const auto first = std::find_if(rows.begin(), rows.end(), in_still);
    const auto last = std::find_if(rows.rbegin(), rows.rend(), in_still);
    REQUIRE(first != rows.end());
    REQUIRE(last != rows.rend());
    CHECK(last->proxy.x > first->proxy.x + 2.0);
}

TEST_CASE(
    "another recording is opened with the pointer alone, and the next one of the folder by key",
    "[playing]") {
    const auto home = home_with_films();
    FilmWindow film(*home / "films/long_color.mkv", home, {});
    std::uint32_t shown = film.seen().drawn_media;
    const auto shows = [&](const std::string& name) {
        film.wait_until([&](const Seen& now) {
            return now.drawn_media != shown && now.touchable && now.file.str().ends_with(name);
        });
        shown = film.seen().drawn_media;
        film.let_ticks_pass(20);
    };
    open_dialog(film);
    film.act("mousemove 140 153 click 1 mousemove 540 426 click 1");  // the second one, Open
    CHECK_FALSE(film.seen().dialog);
    shows("other_color.mkv");
    film.act("key ctrl+Next");
    shows("still_color.mkv");
    static_cast<void>(film.end());
    CHECK(film.touched_depths() ==
          std::vector<std::string>{"long_depth.mkv", "other_depth.mkv", "still_depth.mkv"});
}

// Two clicks are a double click within 0.3 s.
TEST_CASE("a double click opens what the Open dialog lists", "[playing][realtime]") {
    const auto home = home_with_films();
    FilmWindow film(*home / "films/long_color.mkv", home, {"--no-sync"});
    open_dialog(film);
    film.act("mousemove 140 153 click 1 click 1");
    CHECK_FALSE(film.seen().dialog);
    film.wait_until(
        [](const Seen& now) { return now.surface && now.file.str().ends_with("other_color.mkv"); });
    static_cast<void>(film.end());
}

TEST_CASE(
    "a file is found again as it was left: relief and view, and, where it is wished, the moment",
    "[playing]") {
    const auto home = std::make_shared<TemporaryFolder>();
    const fs::path film_file = *home / "slope_color.mkv";
    fs::copy_file(long_films() / "long_color.mkv", film_file);
    run_shell(*home,
              "ffmpeg -nostdin -v error -f lavfi -i \"color=gray:s=64x48:r=10:d=100,"
              "format=gray,geq=lum='40+3*X'\" -c:v ffv1 slope_depth.mkv");
    keep_memory(*home / "state/dibhr/files", film_file, {.relief_px = 30.0});
    const auto touched = [](FilmWindow& film) {
        film.act("mousemove 200 260");
        press_and_release(film);
        const std::vector<Vec3> places = pressed_places(film.end());
        REQUIRE(places.size() == 1);
        return places.front();
    };
    Vec3 zoomed{0.0};
    {
        FilmWindow film(film_file, home, {"--start", "50", "--pause"});
        film.comes_to(50.0);
        film.act("mousemove 200 260 click 4 click 4 click 4 click 4");
        zoomed = touched(film);
    }
    {
        FilmWindow film(film_file, home, {"--pause", "--resume", "on", "--relief", "80"});
        film.comes_to(50.0);
        CHECK(std::abs(touched(film).z - zoomed.z) > 10.0);
    }
    FilmWindow film(film_file, home, {"--pause"});
    film.comes_to(0.0);
    CHECK(glm::length(touched(film) - zoomed) < 0.5);  // 80 was not saved
}

TEST_CASE("a window that stays shows what cannot be opened, and opens something else",
          "[playing]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", 64, 48, 120);
    CHECK(run_dibhr(folder, {"no_depth.png", "--device", "mouse"}).exit_code == 1);
    WindowProgram viewer =
        desk.start_viewer(folder, {"no_depth.png", "--stay", "--device", "mouse", "--size",
                                   "640x480", "--screenshot-name", "seen-{file}"});
    viewer.wait_until([](const Seen& now) { return contains(now.message.str(), "no_depth.png"); });
    viewer.act("key Escape");
    CHECK(viewer.seen().message.str().empty());
    // Keys that need a picture have none.
    for (const std::string key : {"e", "g", "n", "k", "i", "d", "a", "period", "Home", "F"})
        viewer.act("key " + key);
    viewer.act("key n key g mousemove 200 300 mousedown 1 mouseup 1");
    CHECK_FALSE(viewer.seen().open);
    viewer.act("key ctrl+o type cup");
    viewer.wait_until([](const Seen& now) { return now.dialog && now.dialog_entries == 1; });
    viewer.act("key Return");
    viewer.wait_for_surface();
    viewer.act("key s");
    CHECK(eventually([&] { return fs::exists(folder / "seen-cup_depth.png"); }));
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}
