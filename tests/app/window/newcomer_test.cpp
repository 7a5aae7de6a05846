// A newcomer's first quarter of an hour in the real window: with pointer and keys alone, and
// without settings that somebody else wrote.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/session/session.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/sound_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
namespace fs = std::filesystem;

namespace {

constexpr double kFrame_s = 0.05;
constexpr int kStill = 2000;  // bytes of a picture: more have changed when something happened

std::string click(int x, int y) {
    return "mousemove " + std::to_string(x) + " " + std::to_string(y) +
           " sleep 0.4 mousedown 1 sleep 0.2 mouseup 1 ";
}

/// To its end, whatever it holds.
const std::string kScrollPanels = "mousemove 1110 640 sleep 0.2 click --repeat 30 --delay 20 5 ";
// Where the buttons stand: the first one in the panels as they are at first, by a few pixels higher
// or lower with the fonts, the others at their end.
const std::string kBark = click(1063, 424);
const std::string kReplayIt = click(1026, 680);
const std::string kReport = click(1182, 680);
const std::string kFrictionToZero =
    "mousemove 1121 414 sleep 0.3 mousedown 1 sleep 0.3 mousemove 1090 414 sleep 0.3 "
    "mousemove 1040 414 sleep 0.3 mouseup 1 ";
const std::string kOpenLastOfFolder =
    "key Escape key ctrl+o sleep 0.8 key --repeat 12 --delay 30 Down sleep 0.3 key Return ";
const std::string kPress = "mousemove 300 420 sleep 0.6 mousedown 1 sleep 0.4 ";

std::string drag(int way_px) {
    std::string commands;
    for (int step = 0; step < 50; ++step)
        commands += "mousemove_relative -- " + std::to_string(way_px) + " 0 sleep 0.012 ";
    return commands;
}

class Newcomer {
  public:
    Newcomer() : viewer_(desk_.start_viewer(folder_, {"--device", "mouse"}, sounding_into_file())) {
        desk_.act("search --sync --onlyvisible --name dibhr sleep 0.5");
    }

    void act(const std::string& commands) const { desk_.act(commands); }

    /// Does it, again when a busy machine did not take it: it does no harm twice.
    template <typename Condition>
    void act_until(const std::string& commands, const Condition& is_so) const {
        constexpr int kTries = 4;
        bool done = false;
        for (int k = 0; k < kTries && !done; ++k) {
            act(commands);
            done = eventually(is_so, std::chrono::seconds(8));
        }
        INFO(commands);
        REQUIRE(done);
    }

    [[nodiscard]] bool holds(const std::string& file, const std::string& part) const {
        return read_text(folder_ / file).find(part) != std::string::npos;
    }
    [[nodiscard]] std::ptrdiff_t heard() const {
        const std::vector<bool> tenths = heard_tenths(samples_of(folder_ / "sound.raw"));
        return std::count(tenths.begin(), tenths.end(), true);
    }

    /// Files of that ending that the window wrote.
    [[nodiscard]] std::vector<std::string> made(const std::string& ending) const {
        std::vector<std::string> names = names_in(folder_.path());
        std::erase_if(names, [&ending](const std::string& name) {
            return !name.starts_with("dibhr-") || !name.ends_with(ending);
        });
        return names;
    }

    /// What the relief looks like now: RGB.
    [[nodiscard]] std::string picture() const {
        act("key shift+F12");
        REQUIRE(eventually([this] { return made(".png").size() == 1; }));
        run_shell(folder_,
                  "ffmpeg -nostdin -v error -i dibhr-*.png -f rawvideo -pix_fmt rgb24 rgb");
        std::string rgb = read_text(folder_ / "rgb");
        run_shell(folder_, "rm dibhr-*.png rgb");
        return rgb;
    }

    /// Waits until it looks otherwise than then.
    void see_change_from(const std::string& before) const {
        REQUIRE(eventually([&] { return changed(before, picture()) > kStill; }));
    }

    static std::ptrdiff_t changed(const std::string& before, const std::string& after) {
        REQUIRE(before.size() == after.size());
        std::ptrdiff_t bytes = 0;
        for (std::size_t k = 0; k < before.size(); ++k) {
            constexpr int kSeen = 24;
            const int by =
                static_cast<unsigned char>(after[k]) - static_cast<unsigned char>(before[k]);
            if (std::abs(by) > kSeen) ++bytes;
        }
        return bytes;
    }

    int quit() {
        act("key ctrl+q");
        return viewer_.wait();
    }

    [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

  private:
    Desk desk_{};
    TemporaryFolder folder_{};
    Process viewer_;
};

/// Waves that rise slowly, six seconds of them.
void make_waves(const TemporaryFolder& folder) {
    const std::string quiet = "ffmpeg -nostdin -v error -y -f lavfi -i ";
    run_shell(folder, quiet + "testsrc2=s=160x120:r=20:d=6 -c:v ffv1 wave_color.mkv");
    run_shell(folder,
              quiet +
                  "\"nullsrc=s=160x120:r=20:d=6,format=gray,geq=lum='110+40*sin(X/12)+2*T'\" "
                  "-c:v ffv1 wave_depth.mkv");
}

/// Of a part of a video, not of all of it.
std::ptrdiff_t laps_of_a_part(const std::vector<Row>& rows) {
    std::ptrdiff_t laps = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const double back_s = rows[k - 1].video_s - rows[k].video_s;
        if (rows[k].surface && rows[k - 1].surface && back_s > 0.3 && back_s < 4.0) ++laps;
    }
    return laps;
}

/// From where it was paused, between two frames, to the second frame after it. On a busy machine
/// the first one may not have been held for long.
bool shows_two_steps(const std::vector<double>& held) {
    constexpr double kRounding_s = 1e-6;
    const auto is_frame = [](double moment_s) {
        return std::abs(std::remainder(moment_s, kFrame_s)) < kRounding_s;
    };
    for (const double from : held) {
        for (const double to : held) {
            const double way_s = to - from;
            if (is_frame(to) && way_s > kFrame_s - kRounding_s &&
                way_s < 2.0 * kFrame_s + kRounding_s)
                return true;
        }
    }
    return false;
}

void check_session(const fs::path& file) {
    const Session session(file);
    session.check();
    CHECK(session.fact("complete") == "1");
    CHECK(session.fact("material") == "bark");
    CHECK(fs::path(session.fact("colour")).filename() == "wave_color.mkv");
    CHECK(session.missing() == 0);
    const std::vector<Row> rows = read_session(file);
    CHECK(rows.size() > 4000);
    CHECK(std::count_if(rows.begin(), rows.end(), [](const Row& row) {
              return row.contact && glm::length(row.sent_newton) > 0.2;
          }) > 500);
    CHECK(shows_two_steps(held_moments(rows)));
    CHECK(laps_of_a_part(rows) >= 1);
}

}  // namespace

TEST_CASE(
    "a newcomer touches the sample, opens a recording, records, reports, replays without friction, "
    "has an update explained and saves a clip",
    "[newcomer]") {
    Newcomer newcomer;
    const TemporaryFolder& folder = newcomer.folder();
    newcomer.see_change_from(newcomer.picture());  // the sample plays by itself

    newcomer.act_until(
        kBark, [&] { return newcomer.holds("config/dibhr/settings.toml", "material = 'bark'"); });
    // What moves in the video may have come against the hand before it moves itself.
    const std::ptrdiff_t before = newcomer.heard();
    newcomer.act_until(kPress + drag(3) + drag(-3) + "mouseup 1 ",
                       [&] { return newcomer.heard() >= before + 5; });

    make_waves(folder);
    newcomer.act_until(kOpenLastOfFolder,
                       [&] { return newcomer.holds("state/dibhr/recent", "wave_color.mkv"); });

    newcomer.act(kPress + "key ctrl+r sleep 0.5 " + drag(4));
    newcomer.act(
        "key space sleep 0.7 key period sleep 0.7 key period sleep 0.7 key space sleep 0.5 "
        "key a sleep 1 key a sleep 2.5 " +
        drag(-3));
    newcomer.act(drag(2) + "key ctrl+r sleep 0.5 mouseup 1");
    REQUIRE(newcomer.made(".dibhr").size() == 1);
    const std::string session = newcomer.made(".dibhr").front();
    REQUIRE(eventually([&] { return !fs::exists(folder / (session + "-wal")); }));

    const fs::path report = folder / (fs::path(session).stem().string() + "-report");
    newcomer.act_until(kScrollPanels + kReport, [&] { return fs::exists(report / "report.html"); });
    newcomer.act_until(kScrollPanels + kReplayIt,
                       [&] { return newcomer.holds("state/dibhr/recent", session); });

    // Near its end the hand drags. It stands still there, and is computed again without friction.
    newcomer.act("sleep 0.5 key space sleep 0.3 key End sleep 1.5 " + kScrollPanels +
                 "mousemove 860 60 sleep 1");
    const std::string as_recorded = newcomer.picture();
    CHECK(Newcomer::changed(as_recorded, newcomer.picture()) < kStill);
    newcomer.act(kFrictionToZero + "mousemove 860 60");
    newcomer.see_change_from(as_recorded);

    newcomer.act("sleep 1.5");
    const std::string without_friction = newcomer.picture();
    newcomer.act("key e");
    newcomer.see_change_from(without_friction);
    newcomer.act("key period sleep 0.3 key period sleep 0.3 key e sleep 0.5 key Home key space");

    newcomer.act("key F9");
    const auto begin = std::chrono::steady_clock::now();
    newcomer.act("sleep 2 key F9");
    const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - begin;
    REQUIRE(eventually([&] { return newcomer.made(".mp4").size() == 1; }));
    CHECK(newcomer.quit() == 0);

    check_session(folder / session);
    const ProgramResult info = run_dibhr(folder, {"info", session});
    CHECK(info.exit_code == 0);
    CHECK(contains(info.output, "dibhr session"));
    CHECK(contains(read_text(report / "report.html"), "</html>"));
    CHECK(fs::exists(report / "heat-map.png"));
    run_shell(folder, "ffprobe -v error -of default=nw=1:nk=1 -show_entries format=duration '" +
                          newcomer.made(".mp4").front() + "' > length");
    CHECK_THAT(std::stod(read_text(folder / "length")), WithinAbs(lasted.count(), 0.7));
    CHECK(read_text(folder / "errors.txt").find("dibhr:") == std::string::npos);
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        CAPTURE(name);
        CHECK(name.find(".part") == std::string::npos);
        CHECK_FALSE(name.ends_with("-wal"));
        CHECK_FALSE(name.ends_with("-shm"));
    }
}
