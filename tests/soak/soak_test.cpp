// The real window for a long time: a hand that touches, seeks, other files, parameters changed by
// clicks all over the panels, recordings begun and ended, everything at random. Afterwards every
// recording is checked and replayed.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "app/settings/assets_path.hpp"
#include "core/session/session.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/open_dialog.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

/// A whole number from the environment, else `otherwise`.
std::uint64_t number_from(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

struct Area {
    int left, top, width, height;
};
constexpr Area kRelief{150, 120, 700, 560};
constexpr Area kPanels{1000, 60, 260, 680};
constexpr Area kTimeLine{20, 780, 500, 1};  // and the buttons beside it

/// What a person might do next, as events of a keyboard and a mouse.
class RandomPerson {
  public:
    explicit RandomPerson(std::uint64_t seed) : random_(seed) {}

    /// So many things, and among them a recording begun or ended.
    std::string some(int count) {
        std::string events;
        const int toggled = below(count);
        for (int k = 0; k < count; ++k) {
            events += next() + ' ';
            if (k == toggled) events += "key ctrl+r ";
        }
        return events;
    }

    /// From now on the panels are left alone: memory that a fingertip or a cleaning needs is no
    /// leak.
    void leave_panels() { at_panels_ = false; }

    std::string any_of(const std::vector<std::string>& words) {
        return words[static_cast<std::size_t>(below(static_cast<int>(words.size())))];
    }

  private:
    std::string next() {
        const int what = below(11);
        switch (at_panels_ || (what != 6 && what != 7) ? what : 10) {
            case 0:
                return "key " + any_of({"Left", "Right", "Home", "period", "comma"});
            case 1:
                return click(kTimeLine);
            case 2:
                return "key " + any_of({"bracketleft", "bracketright"});
            case 3:
                return "key space key space";
            case 4:
                return "key m";
            case 5:
                return "key " + any_of({"r", "v", "f", "c"});
            case 6:
                return drag(kPanels, 80, 0);  // a slider, if there is one
            case 7:
                return click(kPanels) + " key Escape";
            case 8:
                return turn();
            default:
                return drag(kRelief, 160, 90);  // a stroke
        }
    }

    /// 0 .. count - 1.
    int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
    std::string go_into(const Area& area) {
        const std::string x = std::to_string(area.left + below(area.width));
        return "mousemove " + x + ' ' + std::to_string(area.top + below(area.height));
    }
    std::string click(const Area& area) { return go_into(area) + " click 1"; }
    /// From there up to so many pixels on, in ten steps, pressed.
    std::string drag(const Area& from, int across, int down) {
        std::string events = go_into(from) + " mousedown 1";
        const std::string dx = std::to_string((below(2 * across + 1) - across) / 10);
        const std::string dy = std::to_string((below(2 * down + 1) - down) / 10);
        for (int k = 0; k < 10; ++k) events += " mousemove_relative " + dx + ' ' + dy;
        return events + " mouseup 1";
    }
    std::string turn() {
        return go_into(kRelief) + " mousedown 3 mousemove_relative 40 15 mouseup 3 key r";
    }

    std::mt19937_64 random_;
    bool at_panels_{true};
};

/// Closes whatever is over the relief, and opens another file.
void open_file(const WindowProgram& viewer, const std::string& name) {
    do viewer.act("key Escape");
    while (viewer.seen().dialog || viewer.seen().help || !viewer.seen().message.str().empty());
    viewer.act("key ctrl+o");
    open_by_name(viewer, name);
    viewer.wait_until([&name](const Seen& now) {
        return now.surface && !now.dialog && now.file.str().ends_with(name);
    });
}

/// The sample and two films, all opened by names without a letter that would end the program.
void lay_out_files(const TemporaryFolder& folder) {
    const SampleFiles sample = sample_files();
    fs::create_symlink(sample.colour, folder / "0_rgb.mp4");
    fs::create_symlink(sample.depth, folder / "0_depth.mp4");
    const std::string film = "ffmpeg -nostdin -v error -y -f lavfi -i testsrc2=r=30:d=2:s=";
    for (const auto& [name, size] : {std::pair{"1", "160x120"}, std::pair{"2", "321x241"}}) {
        run_shell(folder, film + size + " -c:v ffv1 " + name + "_rgb.mkv");
        run_shell(folder, film + size + ",format=gray -c:v ffv1 " + name + "_depth.mkv");
    }
}

std::vector<fs::path> recordings_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".dibhr") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// No force above the limit of then, and none that changes faster than the safety stage lets it.
void check_forces(const Session& session) {
    constexpr double kRoundOff = 1e-9;
    const SafetyLimits standard;
    double limit_newton = standard.max_force_newton;
    Vec3 last(0.0);
    Session::Ticks ticks(session);
    int above = 0;
    int too_fast = 0;
    for (TickRecord tick; ticks.next(tick);) {
        const SessionParameters* parameters = session.parameters_of(tick.settings);
        REQUIRE(parameters != nullptr);
        const double wanted_newton = parameters->limits.max_force_newton;
        limit_newton = tick.gliding ? std::max(limit_newton, wanted_newton) : wanted_newton;
        const Vec3 sent = tick.sent_newton;
        above += glm::length(sent) > limit_newton + kRoundOff ? 1 : 0;
        const double most_newton =
            standard.max_change_newton_per_ms * std::min(1e3 * tick.dt_s, 3.0) + kRoundOff;
        const bool may_jump = sent == Vec3(0.0) || tick.tick == 0;
        too_fast += !may_jump && glm::length(sent - last) > most_newton ? 1 : 0;
        last = sent;
    }
    CHECK(above == 0);
    CHECK(too_fast == 0);
}

void check_recording(const TemporaryFolder& folder, const fs::path& file) {
    CAPTURE(file.filename().string());
    const Session session(file);
    session.check();
    CHECK(session.fact("complete") == "1");
    CHECK(session.missing() == 0);
    const ProgramResult info = run_dibhr(folder, {"info", file.string()});
    CHECK(info.exit_code == 0);
    CHECK(info.errors == "");
    if (session.rows() == 0) return;
    check_forces(session);
    const ProgramResult exported =
        run_dibhr(folder, {"export", file.string(), "--csv", "ticks.csv"});
    CHECK(exported.exit_code == 0);
    const std::string rows = read_text(folder / "ticks.csv");
    CHECK(std::count(rows.begin(), rows.end(), '\n') == session.rows() + 1);
    require_same_bits(folder, file);
}

/// Of the memory at the ends of rounds. The least of a third of them, because how fast and how far
/// ahead a video plays changes what it takes; what is never given back raises that, too.
double growth_of(const std::vector<double>& resident_mb) {
    const auto third = static_cast<std::ptrdiff_t>(resident_mb.size() / 3);
    const double early = *std::min_element(resident_mb.begin(), resident_mb.begin() + third);
    const double late = *std::min_element(resident_mb.end() - third, resident_mb.end());
    return late / early - 1.0;
}

}  // namespace

TEST_CASE("a long session of everything at random leaves sound recordings, and no memory behind",
          "[soak]") {
    const seconds duration(number_from("DIBHR_SOAK_SECONDS", 30));
    const std::uint64_t seed = number_from("DIBHR_SOAK_SEED", std::random_device{}());
    const bool is_long = duration >= seconds(300);
    const seconds warm_up = is_long ? seconds(60) : duration / 2;
    constexpr int kActionsInRound = 8;
    constexpr std::size_t kFewestRounds = 3;  // as many thirds are compared
    std::cerr << "soak: " << duration.count() << " s, seed " << seed << '\n';

    const Desk desk;
    const TemporaryFolder folder;
    lay_out_files(folder);
    RandomPerson person(seed);
    WindowProgram viewer =
        desk.start_viewer(folder, {"0_rgb.mp4", "--device", "mouse", "--size", "1280x800"});
    viewer.wait_for_surface();
    std::vector<double> resident_mb;
    const Clock::time_point begin = Clock::now();
    while (Clock::now() < begin + duration || resident_mb.size() < kFewestRounds) {
        const bool counts = Clock::now() >= begin + warm_up;
        if (counts && !is_long) person.leave_panels();  // with few rounds one change is a third
        open_file(viewer, person.any_of({"1_rgb.mkv", "2_rgb.mkv"}));
        viewer.act(person.some(kActionsInRound / 2));
        open_file(viewer, "0_rgb.mp4");
        viewer.act(person.some(kActionsInRound / 2));
        if (!counts) continue;
        resident_mb.push_back(static_cast<double>(viewer.resident_bytes()) / 1e6);
        std::cerr << "soak: " << resident_mb.back() << " MB\n";
    }
    desk.press("key ctrl+q");
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt") == "");

    const double growth = growth_of(resident_mb);
    std::cerr << "soak: " << resident_mb.size() << " rounds, memory " << resident_mb.front()
              << " MB, grown by " << 100.0 * growth << " %\n";
    CHECK(growth < (is_long ? 0.02 : 0.15));

    const std::vector<fs::path> recordings = recordings_in(folder.path());
    CHECK_FALSE(recordings.empty());
    for (const fs::path& file : recordings) check_recording(folder, file);
    std::cerr << "soak: " << recordings.size() << " recordings, replayed\n";
}
