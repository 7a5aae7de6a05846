// `dibhr touch`, the loop and a replay run one tick: the same goals over the same video give the
// same bits.
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/output.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/replay/frames.hpp"
#include "core/replay/session_replay.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "core/video/motion/motion_request.hpp"
#include "core/video/playing/depth_timeline.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/sidecar.hpp"
#include "device/goal_stream.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// Color.mkv and depth.mkv, 0.3 s of a bright square that goes to the right by 8 px a frame, over a
/// plane far below. Made once.
const TemporaryFolder& sliding_square() {
    static const TemporaryFolder made;
    if (!names_in(made.path()).empty()) return made;
    run_shell(made,
              "ffmpeg -nostdin -v error -f lavfi -i 'color=gray:s=80x80:d=0.04,noise=alls=90,"
              "gblur=sigma=1.5' -frames:v 1 square.png && "
              "ffmpeg -nostdin -v error -f lavfi -i color=0x303030:s=320x160:r=30:d=0.3 -loop 1 "
              "-framerate 30 -t 0.3 -i square.png -filter_complex "
              "'overlay=x=60+8*n:y=40' -pix_fmt yuv444p -c:v ffv1 color.mkv && "
              "ffmpeg -nostdin -v error -f lavfi -i color=0x101010:s=320x160:r=30:d=0.3 -f lavfi "
              "-i color=0xd0d0d0:s=80x80:r=30:d=0.3 -filter_complex "
              "'overlay=x=60+8*n:y=40,format=gray' -c:v ffv1 depth.mkv");
    return made;
}

/// A hand that goes in and out of the square and beyond its edges while the video is repeated
/// twice. Its ticks are not all of the same length, and some have the time of the one before.
std::string restless_goals() {
    std::ostringstream text;
    text << std::setprecision(17) << "t,x,y,z\n";
    double t_s = 0.0;
    for (int k = 0; k < 600; ++k) {
        if (k % 100 != 0) t_s += 0.001 + 1e-4 * (k % 7);
        text << t_s << ',' << 135.0 + 25.0 * std::sin(9.0 * t_s) << ','
             << 80.0 + 20.0 * std::sin(5.0 * t_s) << ',' << 203.0 + 14.0 * std::cos(15.0 * t_s)
             << '\n';
    }
    return text.str();
}

/// Looped.dibhr: the goals through the loop, over the frames that `dibhr touch` has.
void record_loop(const TemporaryFolder& folder, const TouchParameters& parameters,
                 const std::filesystem::path& colour, const std::filesystem::path& depth,
                 const DepthRequest& request = {}) {
    const std::vector<TimedGoal> goals = read_goals(folder / "goals.csv");
    GoalStream hand("goals", goals);
    TripleBuffer<FrameWindow> frames;
    TripleBuffer<HapticSettings> settings;
    TripleBuffer<HapticState> state;
    const auto strips = std::make_unique<StripRing>();
    const auto ticks = std::make_unique<TickRing>();
    HapticTick tick({hand, frames, settings, state, *strips, *ticks});
    Recorder recorder(folder / "looped.dibhr", *ticks, {});
    auto media = open_media(colour, depth, request);
    const auto meaning = media->description().meaning;
    recorder.media(1, colour, depth, meaning ? toml_of(meaning->statement()) : std::string());
    recorder.parameters({.version = 1, .touch = parameters, .limits = {}, .bump = {}});
    settings.publish({.parameters = parameters, .recording = true, .version = 1});
    DepthTimeline video(std::move(media), DepthTimeline::Wanted::all,
                        {.preset = CleaningPreset::raw},
                        motion_request(parameters.carry, InBetweens::automatic));
    FrameWindow window;
    std::chrono::steady_clock::time_point begin{};
    double last_s = goals.front().t_s;
    for (const TimedGoal& goal : goals) {
        if (video.advance_to(goal.t_s)) ++window.discontinuity;
        const DepthBlend now = video.now();
        window.frames[0] = *now.from;
        window.frames[1] = *now.to;
        window.frames[0].media = window.frames[1].media = 1;
        window.count = now.from == now.to ? 1 : 2;
        window.clock = {{}, goal.t_s, 0.0};
        frames.publish(window);
        const double step_s = goal.t_s - last_s;
        begin += std::chrono::milliseconds(1);
        tick.run({begin, step_s > 0.0 ? step_s : 0.001, {}, false}, 0);
        last_s = goal.t_s;
    }
    REQUIRE(recorder.finish().failure.empty());
}

/// A row of `dibhr touch` but for the last cell, the time of its update.
std::string without_update_time(const std::string& row) {
    return row.substr(0, row.rfind(','));
}

}  // namespace

TEST_CASE("the same goals over the same video give the same bits by touch, by loop and replayed",
          "[touch][replay]") {
    const Algorithm algorithm = GENERATE(from_range(all_algorithms()));
    CAPTURE(name_of(algorithm));
    const TemporaryFolder folder;
    write_text(folder / "goals.csv", restless_goals());
    const ProgramResult touched = run_dibhr(
        folder,
        {"touch", "--raw-depth", "--video", "--depth", (sliding_square() / "depth.mkv").string(),
         "--color", (sliding_square() / "color.mkv").string(), "--goals", "goals.csv", "--carry",
         "on", "--friction", "0.6", "--damping", "3", "--algorithm", name_of(algorithm)});
    INFO(touched.errors);
    REQUIRE(touched.exit_code == 0);
    const std::vector<std::string> rows = split(touched.output, '\n');

    TouchParameters parameters{.algorithm = algorithm, .friction = {0.6, 0.6}, .carry = true};
    parameters.coupling.damping_newton_s_per_m = 3.0;
    record_loop(folder, parameters, sliding_square() / "color.mkv", sliding_square() / "depth.mkv");
    const Session session(folder / "looped.dibhr");
    SessionFrames frames(session, {});
    SessionReplay replay(session, frames, {{}});
    const std::vector<TimedGoal> goals = read_goals(folder / "goals.csv");
    REQUIRE(rows.size() == goals.size() + 2);  // the header, and nothing behind the last row
    int contacts = 0;
    int carried = 0;
    for (std::size_t k = 0; k < goals.size(); ++k) {
        CAPTURE(k);
        REQUIRE(replay.next());
        REQUIRE(same_bits(replay.touch(0), replay.recorded()));
        std::string replayed;
        append_row(replayed, {goals[k].t_s, replay.touch(0), 0});
        REQUIRE(without_update_time(replayed) == without_update_time(rows[k + 1]));
        contacts += replay.recorded().contact ? 1 : 0;
        carried += replay.touch(0).carried != Vec3(0.0) ? 1 : 0;
    }
    CHECK_FALSE(replay.next());
    CHECK(contacts > 100);  // else the test proves little
    CHECK(contacts < 550);
    CHECK(carried > 50);
}

TEST_CASE("a session over pictures that took a video's times is replayed at these times",
          "[touch][replay]") {
    const TemporaryFolder folder;
    write_text(folder / "goals.csv", restless_goals());
    run_shell(folder, "mkdir depth && ffmpeg -nostdin -v error -i '" +
                          (sliding_square() / "depth.mkv").string() +
                          "' depth/%03d.png && ffmpeg -nostdin -v error -r 60 -i '" +
                          (sliding_square() / "color.mkv").string() + "' -r 60 -c:v ffv1 rgb.mkv");
    const auto open = [&] {
        return open_media(folder / "rgb.mkv", folder / "depth", {.find_out = true});
    };
    CHECK(open()->description().meaning->times.value == DepthTimes::paired);
    CHECK(open()->description().duration_s < 0.2);  // 0.3 s of 30 a second
    record_loop(folder, {}, folder / "rgb.mkv", folder / "depth", {.find_out = true});
    const Session session(folder / "looped.dibhr");
    SessionFrames frames(session, {});
    SessionReplay replay(session, frames, {{}});
    int replayed = 0;
    while (replay.next()) {
        REQUIRE(same_bits(replay.touch(0), replay.recorded()));
        ++replayed;
    }
    CHECK(replayed == 600);
}
