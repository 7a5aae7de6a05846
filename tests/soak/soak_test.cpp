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
#include <thread>
#include <vector>

#include <glm/geometric.hpp>

#include "app/settings/assets_path.hpp"
#include "core/session/session.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
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

/// What a person might do next, as a chain of xdotool's commands.
class RandomPerson {
  public:
    explicit RandomPerson(std::uint64_t seed) : random_(seed) {}

    /// So many things, and among them a recording begun or ended.
    std::string some(int count) {
        std::string commands;
        const int toggled = below(count);
        for (int k = 0; k < count; ++k) {
            commands += next() + " sleep 0.1 ";
            if (k == toggled) commands += "key ctrl+r sleep 0.3 ";
        }
        return commands;
    }

    std::string any_of(const std::vector<std::string>& words) {
        return words[static_cast<std::size_t>(below(static_cast<int>(words.size())))];
    }

  private:
    std::string next() {
        switch (below(11)) {
            case 0:
                return "key " + any_of({"Left", "Right", "Home", "period", "comma"}) + " sleep 0.3";
            case 1:
                return click(kTimeLine);
            case 2:
                return "key " + any_of({"bracketleft", "bracketright"}) + " sleep 0.2";
            case 3:
                return "key space sleep 0.4 key space sleep 0.2";
            case 4:
                return "key m sleep 0.1";
            case 5:
                return "key " + any_of({"r", "v", "f", "c"}) + " sleep 0.2";
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
        return "mousemove " + x + " " + std::to_string(area.top + below(area.height)) +
               " sleep 0.1 ";
    }
    std::string click(const Area& area) {
        return go_into(area) + "mousedown 1 sleep 0.1 mouseup 1 sleep 0.2";
    }
    /// From there up to so many pixels on, in ten steps, pressed.
    std::string drag(const Area& from, int across, int down) {
        std::string commands = go_into(from) + "mousedown 1 sleep 0.2 ";
        const std::string dx = std::to_string((below(2 * across + 1) - across) / 10);
        const std::string dy = std::to_string((below(2 * down + 1) - down) / 10);
        for (int k = 0; k < 10; ++k) {
            commands += "mousemove_relative -- " + dx + " " + dy + " sleep 0.03 ";
        }
        return commands + "mouseup 1 sleep 0.1";
    }
    std::string turn() {
        return go_into(kRelief) + "mousedown 3 sleep 0.1 mousemove_relative -- 40 15 sleep 0.1 " +
               "mouseup 3 sleep 0.1 key r sleep 0.1";
    }

    std::mt19937_64 random_;
};

/// xdotool types to its last word, so that the key is another chain.
void open_file(const Desk& desk, const std::string& name) {
    desk.act("key Escape sleep 0.2 key ctrl+o sleep 1 key ctrl+a sleep 0.1 type " + name);
    desk.act("key Return sleep 1.5");
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
    const seconds warm_up = is_long ? seconds(60) : duration / 4;
    constexpr int kActionsInRound = 8;
    std::cerr << "soak: " << duration.count() << " s, seed " << seed << '\n';

    const Desk desk;
    const TemporaryFolder folder;
    lay_out_files(folder);
    RandomPerson person(seed);
    Process viewer = desk.start_viewer(
        folder, {"0_rgb.mp4", "--device", "mouse", "--size", "1280x800", "--seconds", "100000"});
    desk.act("search --sync --onlyvisible --name dibhr sleep 2");
    std::vector<double> resident_mb;
    const Clock::time_point begin = Clock::now();
    while (Clock::now() < begin + duration) {
        open_file(desk, person.any_of({"1_rgb.mkv", "2_rgb.mkv"}));
        desk.act(person.some(kActionsInRound / 2));
        open_file(desk, "0_rgb.mp4");
        desk.act(person.some(kActionsInRound / 2));
        if (Clock::now() < begin + warm_up) continue;
        resident_mb.push_back(static_cast<double>(viewer.resident_bytes()) / 1e6);
        std::cerr << "soak: " << resident_mb.back() << " MB\n";
    }
    desk.act("key ctrl+q");
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt") == "");

    REQUIRE(resident_mb.size() >= 3);
    const double growth = growth_of(resident_mb);
    std::cerr << "soak: " << resident_mb.size() << " rounds, memory " << resident_mb.front()
              << " MB, grown by " << 100.0 * growth << " %\n";
    CHECK(growth < (is_long ? 0.02 : 0.15));

    const std::vector<fs::path> recordings = recordings_in(folder.path());
    CHECK_FALSE(recordings.empty());
    for (const fs::path& file : recordings) check_recording(folder, file);
    std::cerr << "soak: " << recordings.size() << " recordings, replayed\n";
}
