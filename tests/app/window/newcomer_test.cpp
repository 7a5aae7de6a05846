// A newcomer's first quarter of an hour in the real window: with pointer and keys only, and with
// default settings.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
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
namespace fs = std::filesystem;

namespace {

constexpr double kFrame_s = 0.05;
constexpr double kNear_s = 1e-6;
constexpr int kStill = 2000;  // bytes of a picture: if more differ, the picture has changed
constexpr double kRounding_s = 0.002;
constexpr std::uint64_t kHeldTicks = 320;  // of a moment: more than held_moments() requires

// The places of the buttons: the first one in the panels as at the start, some pixels higher or
// lower with other fonts; the others at the panels' end.
constexpr const char* kBark = "mousemove 1063 437 click 1";
constexpr const char* kReplayIt = "mousemove 1026 680 click 1";
constexpr const char* kReport = "mousemove 1182 680 click 1";
constexpr const char* kFrictionToZero =
    "mousemove 1121 414 mousedown 1 mousemove 1090 414 mousemove 1040 414 mouseup 1";
constexpr const char* kPress = "mousemove 300 420 mousedown 1";

class Newcomer {
  public:
    Newcomer() : viewer_(desk_.start_viewer(folder_, {"--device", "mouse"}, sounding_into_file())) {
        viewer_.wait_for_surface();
    }

    void act(const std::string& events) const { viewer_.act(events); }
    [[nodiscard]] Seen seen() const { return viewer_.seen(); }
    void wait_until(const std::function<bool(const Seen&)>& is_so) const {
        viewer_.wait_until(is_so);
    }
    /// With the pointer over the relief.
    void drag(int way_px) const {
        constexpr int kSteps = 3;
        for (int step = 0; step < kSteps; ++step)
            act("mousemove_relative " + std::to_string(way_px / kSteps) + " 0");
    }
    void wait_for_rows(std::uint64_t more) const {
        const std::uint64_t rows = seen().recorded_rows;
        wait_until([wanted = rows + more](const Seen& now) { return now.recorded_rows >= wanted; });
    }
    /// Steps the paused video to its next frame.
    void step() const {
        const double still_s = seen().media_s;
        act("key period");
        wait_until([still_s](const Seen& now) {
            return now.touchable && now.media_s > still_s &&
                   std::abs(now.drawn_s - now.media_s) < kNear_s;
        });
        wait_for_rows(kHeldTicks);
    }
    /// To their end, whatever their length.
    void scroll_panels() const {
        act("mousemove 1110 640");
        for (int k = 0; k < 10; ++k) desk_.press("click 5 click 5 click 5");
        viewer_.wait_for_turn();
        viewer_.wait_for_turn();
    }

    [[nodiscard]] bool holds(const std::string& file, const std::string& part) const {
        return read_text(folder_ / file).find(part) != std::string::npos;
    }
    [[nodiscard]] std::ptrdiff_t heard() const {
        const std::vector<bool> tenths = heard_tenths(samples_of(folder_ / "sound.raw"));
        return std::count(tenths.begin(), tenths.end(), true);
    }

    /// The files with that extension that the window wrote.
    [[nodiscard]] std::vector<std::string> made(const std::string& ending) const {
        std::vector<std::string> names = names_in(folder_.path());
        std::erase_if(names, [&ending](const std::string& name) {
            return !name.starts_with("dibhr-") || !name.ends_with(ending);
        });
        return names;
    }

    /// The picture of the relief, from below the corner of notices to above the time line: RGB.
    [[nodiscard]] std::string picture() const {
        constexpr std::size_t kDisplay = 1280;
        constexpr std::size_t kRelief = 930;
        const std::string all = desk_.picture();
        std::string relief;
        for (std::size_t y = 40; y < 700; ++y) relief += all.substr(3 * kDisplay * y, 3 * kRelief);
        return relief;
    }

    /// Waits until the picture differs from that one.
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
        desk_.press("key ctrl+q");
        return viewer_.wait();
    }

    [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

  private:
    Desk desk_{};
    TemporaryFolder folder_{};
    WindowProgram viewer_;
};

/// Waves that rise slowly, three seconds of them.
void make_waves(const TemporaryFolder& folder) {
    run_shell(folder,
              "ffmpeg -nostdin -v error -y -f lavfi -i testsrc2=s=160x120:r=20:d=3 -f lavfi -i "
              "\"nullsrc=s=160x120:r=20:d=3,format=gray,geq=lum='110+40*sin(X/12)+2*T'\" "
              "-map 0 -c:v ffv1 wave_color.mkv -map 1 -c:v ffv1 wave_depth.mkv");
}

/// Of a part of a video.
std::ptrdiff_t laps_of_a_part(const std::vector<Row>& rows) {
    std::ptrdiff_t laps = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const double back_s = rows[k - 1].video_s - rows[k].video_s;
        if (rows[k].surface && rows[k - 1].surface && back_s > 0.3 && back_s < 2.0) ++laps;
    }
    return laps;
}

/// From where it was paused, between two frames, to the next frame and to the one after it.
bool shows_two_steps(const std::vector<double>& held) {
    const auto is_frame = [](double moment_s) {
        return std::abs(std::remainder(moment_s, kFrame_s)) < kNear_s;
    };
    for (std::size_t k = 2; k < held.size(); ++k) {
        const double first_s = held[k - 1] - held[k - 2];
        const double second_s = held[k] - held[k - 1];
        if (is_frame(held[k - 1]) && is_frame(held[k]) && first_s > 0.0 &&
            first_s < kFrame_s + kNear_s && std::abs(second_s - kFrame_s) < kNear_s)
            return true;
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
    CHECK(rows.size() > 1500);
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

    newcomer.act(kBark);
    // Something in the video may have touched the hand before the hand moves.
    const std::ptrdiff_t before = newcomer.heard();
    newcomer.act(kPress);
    newcomer.wait_until([](const Seen& now) { return now.contact; });
    REQUIRE(eventually([&] {
        newcomer.drag(50);
        newcomer.drag(-50);
        return newcomer.heard() >= before + 5;
    }));
    newcomer.act("mouseup 1 key s");
    CHECK(eventually([&] { return newcomer.made(".png").size() == 1; }));

    make_waves(folder);
    newcomer.act("key ctrl+o");
    newcomer.wait_until([](const Seen& now) {
        return now.dialog_typing && !now.dialog_reads && now.dialog_entries > 0;
    });
    for (std::uint64_t k = newcomer.seen().dialog_entries; k > 0; --k) newcomer.act("key Down");
    newcomer.act("key Return");  // opens the folder's last entry
    newcomer.wait_until(
        [](const Seen& now) { return now.surface && now.file.str().ends_with("wave_color.mkv"); });

    newcomer.act(kPress + std::string(" key ctrl+r"));
    newcomer.wait_until([](const Seen& now) { return now.contact && now.records; });
    newcomer.drag(100);
    newcomer.act("key space");
    newcomer.wait_until([](const Seen& now) { return !now.playing; });
    newcomer.wait_for_rows(kHeldTicks);
    newcomer.step();
    newcomer.step();
    newcomer.act("key Home key space key a");
    const double part_s = newcomer.seen().media_s;
    newcomer.wait_until([part_s](const Seen& now) { return now.media_s > part_s + 0.5; });
    newcomer.act("key a");
    newcomer.wait_until([part_s](const Seen& now) { return now.media_s < part_s + 0.3; });
    newcomer.drag(-75);
    newcomer.drag(50);
    newcomer.act("key ctrl+r mouseup 1");
    newcomer.wait_until([](const Seen& now) { return !now.records; });
    REQUIRE(newcomer.made(".dibhr").size() == 1);
    const std::string session = newcomer.made(".dibhr").front();
    REQUIRE(eventually([&] { return !fs::exists(folder / (session + "-wal")); }));

    const fs::path report = folder / (fs::path(session).stem().string() + "-report");
    newcomer.scroll_panels();
    newcomer.act(kReport);
    CHECK(eventually([&] { return fs::exists(report / "report.html"); }));
    newcomer.scroll_panels();
    newcomer.act(kReplayIt);
    newcomer.wait_until([](const Seen& now) { return now.replays && now.surface; });

    // In the last second the hand drags. The replay pauses there, and is computed again without
    // friction.
    newcomer.act("key space key End");
    newcomer.wait_until(
        [](const Seen& now) { return !now.playing && now.media_s > now.duration_s - 1.01; });
    newcomer.scroll_panels();
    newcomer.act("mousemove 860 60");
    const std::string as_recorded = newcomer.picture();
    newcomer.act("mousemove 861 60");
    CHECK(Newcomer::changed(as_recorded, newcomer.picture()) < kStill);
    newcomer.act(kFrictionToZero + std::string(" mousemove 860 60"));
    newcomer.see_change_from(as_recorded);

    const std::string without_friction = newcomer.picture();
    newcomer.act("key e");
    newcomer.wait_until([](const Seen& now) { return now.explained; });
    newcomer.see_change_from(without_friction);
    const std::int64_t explained = newcomer.seen().tick;
    CHECK(eventually([&] {
        newcomer.act("key period");  // after an update's last step, to the next update
        return newcomer.seen().explained_steps > 0 || newcomer.seen().tick > explained + 1;
    }));
    newcomer.act("key e key Home key space");

    newcomer.act("key F9");
    newcomer.wait_until([](const Seen& now) { return now.clip && now.clip_s > 0.5; });
    const double clip_s = newcomer.seen().clip_s;
    newcomer.act("key F9");
    newcomer.wait_until([](const Seen& now) { return !now.clip; });
    REQUIRE(newcomer.made(".mp4").size() == 1);
    CHECK(newcomer.quit() == 0);
    CHECK(newcomer.holds("config/dibhr/settings.toml", "material = 'bark'"));
    CHECK(newcomer.holds("state/dibhr/recent", "wave_color.mkv"));
    CHECK(newcomer.holds("state/dibhr/recent", session));

    check_session(folder / session);
    const ProgramResult info = run_dibhr(folder, {"info", session});
    CHECK(info.exit_code == 0);
    CHECK(contains(info.output, "dibhr session"));
    CHECK(contains(read_text(report / "report.html"), "</html>"));
    CHECK(fs::exists(report / "heat-map.png"));
    run_shell(folder, "ffprobe -v error -of default=nw=1:nk=1 -show_entries format=duration '" +
                          newcomer.made(".mp4").front() + "' > length");
    CHECK(std::stod(read_text(folder / "length")) > clip_s - kRounding_s);
    CHECK(read_text(folder / "errors.txt").find("dibhr:") == std::string::npos);
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        CAPTURE(name);
        CHECK(name.find(".part") == std::string::npos);
        CHECK_FALSE(name.ends_with("-wal"));
        CHECK_FALSE(name.ends_with("-shm"));
    }
}
