// A session that holds the surface that was felt: it replays without its video, to the same bits.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/replay/frames.hpp"
#include "core/replay/session_replay.hpp"
#include "core/replay/stored_frames.hpp"
#include "core/session/recorder.hpp"
#include "core/session/surface_reader.hpp"
#include "core/video/sources/preview_picture.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

struct Made {
    SurfaceRecording how{SurfaceRecording::tiles};
    int ticks{3000};
    bool forgets{false};
    std::function<std::string(const Frame&)> picture{};
};

/// Records a hand, with a change of algorithm now and then.
RecorderStatus record(const SessionFolder& folder, MovingSurface& surface, const Made& made = {}) {
    FeltMovingSurface felt(surface);
    felt.forgets = made.forgets;
    felt.picture = made.picture;
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, {}, nullptr, std::chrono::steady_clock::now,
                      {&felt, made.how});
    Exploration hand(surface);
    recorder.media(1, "colour.mp4", "depth.mp4");
    recorder.parameters(hand.parameters);
    for (int k = 0; k < made.ticks; ++k) {
        if (k % 700 == 699) {
            ++hand.parameters.version;
            hand.parameters.touch.algorithm = all_algorithms()[hand.parameters.version % 4];
            recorder.parameters(hand.parameters);
        }
        push(*ring, hand.next());
    }
    return recorder.finish();
}

std::string error_of(const Session& session) {
    try {
        StoredFrames frames(session, {});
        SessionReplay replay(session, frames, {{}});
        while (replay.next()) continue;
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

ParameterChange runs_as(Algorithm algorithm, double friction) {
    return [=](TouchParameters& touch) {
        touch.algorithm = algorithm;
        touch.friction = {friction, friction};
    };
}

}  // namespace

TEST_CASE("a session that holds its surface replays to the same bits without the video",
          "[replay]") {
    const SessionFolder folder;
    MovingSurface surface;
    CHECK(record(folder, surface).missing_surfaces == 0);
    const Session session(folder.file());
    CHECK(session.fact("record-surface") == "tiles");
    const SessionSurfaces opened = open_surfaces(session, {});
    CHECK(opened.stored);
    CHECK(contains(opened.warning, "depth.mp4"));
    CHECK(opened.description.depth_columns == 96);
    SessionReplay replay(session, *opened.surfaces, {{}});
    std::int64_t in_contact = 0;
    while (replay.next()) {
        CAPTURE(replay.recorded().tick);
        REQUIRE(same_bits(replay.touch(0), replay.recorded()));
        REQUIRE_FALSE(replay.left_known(0));
        in_contact += replay.recorded().contact ? 1 : 0;
    }
    CHECK(in_contact > 1500);
}

TEST_CASE("without the video a window shows the stored picture that is nearest in time",
          "[replay]") {
    const SessionFolder folder;
    MovingSurface surface;
    std::set<double> pictured;
    const auto picture = [&pictured](const Frame& frame) -> std::string {
        const auto number = std::lround(frame.media_s / MovingSurface::kInterval_s);
        if (number % 10 != 0 || !pictured.insert(frame.media_s).second) return {};
        const auto grey = static_cast<std::uint8_t>(8 * number);  // of frames 0, 10 and 20
        Frame coloured = frame;
        coloured.colour = std::make_shared<ColourImage>(
            ColourImage{8, 8, std::vector<std::uint8_t>(std::size_t{3} * 8 * 8, grey)});
        return preview_of(coloured);
    };
    (void)record(folder, surface, {.ticks = 1500, .picture = picture});
    const Session session(folder.file());
    CHECK(SurfaceReader(session.reader()).preview_extent().count == 3);
    const SessionSurfaces opened = open_surfaces(session, {.colour = true});
    SessionReplay replay(session, *opened.surfaces, {});
    while (replay.next()) {
        if (!replay.recorded().surface) continue;
        const Frame& frame = replay.frames()->from;
        const auto number = static_cast<double>(frame.index);
        CAPTURE(frame.index);
        REQUIRE(frame.has_colour());
        CHECK(frame.colour->columns == 8);
        const double nearest = std::min(10.0 * std::round(number / 10.0), 20.0);
        CHECK(std::abs(frame.colour->rgb[0] / 8.0 - number) <= std::abs(nearest - number) + 0.3);
    }
    StoredFrames of_a_run(session, {});
    SessionReplay run(session, of_a_run, {});
    REQUIRE(run.next());
    CHECK_FALSE(run.frames()->from.has_colour());
}

TEST_CASE(
    "another algorithm gives over a stored surface what it gives over all of it, until it "
    "leaves what is stored, which is told",
    "[replay]") {
    const SessionFolder folder;
    MovingSurface surface;
    (void)record(folder, surface);
    const Session session(folder.file());
    StoredFrames stored(session, {});
    std::vector<ParameterChange> changes;
    for (const Algorithm algorithm : all_algorithms())
        for (const double friction : {0.0, 1.5}) changes.push_back(runs_as(algorithm, friction));
    SessionReplay whole(session, surface, changes);
    SessionReplay replay(session, stored, changes);
    std::vector<bool> left(changes.size());
    std::int64_t compared = 0;
    while (whole.next() && replay.next()) {
        for (std::size_t run = 0; run < changes.size(); ++run) {
            left[run] = left[run] || replay.left_known(run);
            if (left[run]) continue;
            ++compared;
            CAPTURE(run, replay.recorded().tick);
            REQUIRE(same_bits(replay.touch(run).proxy.position, whole.touch(run).proxy.position));
            REQUIRE(
                same_bits(replay.touch(run).sent_force_newton, whole.touch(run).sent_force_newton));
        }
    }
    CHECK(compared > 4000);
}

TEST_CASE("the Python of FORMAT.md reads the surface that a replay walks on, to the last bit",
          "[replay]") {
    const SessionFolder folder;
    MovingSurface surface;
    (void)record(folder, surface);
    const auto levels = folder / "levels.csv";
    const std::string script =
        "PYTHONDONTWRITEBYTECODE=1 python3 '" DIBHR_SOURCE_DIR "/core/session/read_session.py' '" +
        folder.file().string() + "' /dev/null '" + levels.string() + "' >/dev/null";
    REQUIRE(std::system(script.c_str()) == 0);
    std::ifstream rows(levels);
    std::string row;
    std::getline(rows, row);
    REQUIRE(row == "tick,i,j,level");

    const Session session(folder.file());
    SurfaceReader reader(session.reader());
    Session::Ticks ticks(session);
    int compared = 0;
    for (TickRecord tick; ticks.next(tick);) {
        REQUIRE(std::getline(rows, row));
        std::istringstream cells(row);
        std::int64_t number = 0;
        int i = 0;
        int j = 0;
        double level = 0.0;
        char comma = 0;
        cells >> number >> comma >> i >> comma >> j >> comma >> level;
        REQUIRE(cells);
        REQUIRE(number == tick.tick);
        const auto stored = reader.surface(tick.pair);
        REQUIRE(stored);
        const auto& images = stored->felt.images;
        const SurfaceShape shape;
        const DepthSurface felt(*images[0].levels, *images[1].levels, tick.blend, shape);
        CAPTURE(tick.tick, i, j, level);
        REQUIRE(same_bits(felt.elevation(i, j), shape.relief_px * level / 255.0));
        ++compared;
    }
    CHECK(compared == 3000);
}

TEST_CASE("where whole frames are recorded no update leaves them, and with off none is stored",
          "[replay]") {
    MovingSurface surface;
    {
        const SessionFolder folder;
        (void)record(folder, surface, {.how = SurfaceRecording::whole, .ticks = 500});
        const Session session(folder.file());
        StoredFrames stored(session, {});
        SessionReplay replay(session, stored, {runs_as(Algorithm::god_object, 2.0)});
        while (replay.next()) REQUIRE_FALSE(replay.left_known(0));
        SurfaceReader reader(session.reader());
        const auto read = reader.surface(1);
        REQUIRE(read);
        CHECK(read->felt.images.front().levels->levels == surface.frame({}, 0.0).depth->levels);
    }
    const SessionFolder folder;
    (void)record(folder, surface, {.how = SurfaceRecording::off, .ticks = 500});
    const Session session(folder.file());
    CHECK(session.fact("record-surface") == "off");
    CHECK_FALSE(SurfaceReader(session.reader()).any());
    CHECK(contains(error_of(session), "holds no surface"));
    CHECK_THROWS_AS(open_surfaces(session, {}), InputError);  // as before: the video is missing
}

TEST_CASE("a video that repeats is stored once", "[replay]") {
    MovingSurface surface;
    const auto tiles = [&](int ticks) {
        const SessionFolder folder;
        (void)record(folder, surface, {.how = SurfaceRecording::whole, .ticks = ticks});
        return answer(folder.file(), "SELECT count(*) FROM tile");
    };
    CHECK(tiles(1200) == tiles(2400));
}

TEST_CASE("a pair whose images were gone is counted, and a replay says what it lacks", "[replay]") {
    const SessionFolder folder;
    MovingSurface surface;
    CHECK(record(folder, surface, {.ticks = 300, .forgets = true}).missing_surfaces > 5);
    const Session session(folder.file());
    CHECK_FALSE(SurfaceReader(session.reader()).any());
    CHECK_FALSE(session.has_all_surfaces());
    CHECK(contains(session.warning(), folder.file().string() + ": lacks the surface of "));
}

TEST_CASE("a damaged surface is refused in one line that says so", "[replay]") {
    const std::vector<std::string> harms{
        "UPDATE tile SET code = x'07'",
        "UPDATE tile SET code = substr(code, 1, 5)",
        "UPDATE tile SET code = 'words'",
        "DELETE FROM tile",
        "DELETE FROM grid",
        "UPDATE grid SET columns = 1 << 40",
        "UPDATE grid SET columns = 17 WHERE id = 2",
        "UPDATE grid SET rows = -1",
        "UPDATE grid_tile SET place = 1 << 40 WHERE place = (SELECT max(place) FROM grid_tile)",
        "UPDATE surface SET levels = 999999",
        "UPDATE surface SET highest = NULL WHERE part = 1",
        "UPDATE surface SET unseen = 1, right = 1 WHERE part = 1",
        "DELETE FROM surface WHERE pair > 2",
    };
    for (const std::string& harm : harms) {
        const SessionFolder folder;
        MovingSurface surface;
        (void)record(folder, surface, {.ticks = 300});
        REQUIRE(change(folder.file(), harm));
        CAPTURE(harm);
        const std::string error = error_of(Session(folder.file()));
        CHECK(error.find('\n') == std::string::npos);
        if (harm.find("unseen") == std::string::npos)
            CHECK(contains(error, folder.file().string()));
    }
}
