// Replay: a recorded session gives its own bits again, and other parameters give other forces.
#include "core/replay/session_replay.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/replay/frames.hpp"
#include "core/session/recorder.hpp"
#include "core/video/cleaning/surface_version.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comma_locale.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// All actions of a person: four algorithms, other numbers, force off, a pause without a
/// surface, a lifted hand, a device that pushes back, a force that meets its limit.
void record_exploration(const SessionFolder& folder, MovingSurface& surface) {
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, {});
    Exploration hand(surface);
    recorder.media(1, "colour.mp4", "depth.mp4");
    recorder.parameters(hand.parameters);
    const auto go_on = [&](int ticks) {
        for (int k = 0; k < ticks; ++k) push(*ring, hand.next());
    };
    const auto change = [&](auto set) {
        ++hand.parameters.version;
        set(hand.parameters);
        recorder.parameters(hand.parameters);
    };
    go_on(1500);
    for (const Algorithm algorithm : all_algorithms()) {
        change([&](SessionParameters& p) { p.touch.algorithm = algorithm; });
        go_on(700);
    }
    change([](SessionParameters& p) { p.touch.coupling.damping_newton_s_per_m = 3.0; });
    go_on(500);
    change([](SessionParameters& p) { p.touch.coupling.damping_cutoff_hz = 50.0; });
    go_on(500);
    change([](SessionParameters& p) { p.touch.coupling.stiffness_newton_per_mm = 5.0; });
    go_on(500);
    hand.releases_contact = true;
    go_on(300);
    hand.surface = false;
    go_on(50);
    hand.surface = true;
    go_on(300);
    change([](SessionParameters& p) { p.force_enabled = false; });
    go_on(100);
    change([](SessionParameters& p) { p.force_enabled = true; });
    hand.own_force_newton = {0.1, -0.2, 1.0 / 3.0};
    go_on(900);
}

/// One flat picture for every requested frame; stores of which video each one was.
class AskedFrames final : public RecordedFrames {
  public:
    std::vector<std::uint32_t> media{};

    [[nodiscard]] Frame frame(const FrameSource& source, double media_s) override {
        media.push_back(source.media);
        return {.depth = image_, .media_s = media_s};
    }
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters&) override {
        return nullptr;
    }

  private:
    std::shared_ptr<const DepthImage> image_{
        std::make_shared<DepthImage>(DepthImage{4, 4, 255.0, std::vector<float>(16, 100.0F)})};
};

}  // namespace

TEST_CASE("a session replays to the same proxies and forces, bit for bit", "[replay]") {
    const SessionFolder folder;
    MovingSurface surface;
    record_exploration(folder, surface);
    const Session session(folder.file());
    SessionReplay replay(session, surface, {{}, {}});
    std::int64_t ticks = 0;
    std::int64_t in_contact = 0;
    std::int64_t limited = 0;
    while (replay.next()) {
        const TickRecord& recorded = replay.recorded();
        CAPTURE(recorded.tick);
        REQUIRE(same_bits(replay.touch(0), recorded));
        REQUIRE(same_bits(replay.touch(1), recorded));
        ++ticks;
        in_contact += recorded.contact ? 1 : 0;
        limited += recorded.sent_newton[2] != recorded.spring_newton[2] ? 1 : 0;
    }
    CHECK(ticks == session.rows());
    CHECK(ticks == 7450);
    CHECK(in_contact > 4000);  // or this would prove little
    CHECK(limited > 500);
}

TEST_CASE("a session is recorded and replayed to the same bits whatever the program's locale is",
          "[replay]") {
    const CommaLocale locale;
    const SessionFolder folder;
    MovingSurface surface;
    record_exploration(folder, surface);
    const Session session(folder.file());
    SessionReplay replay(session, surface, {{}});
    while (replay.next()) REQUIRE(same_bits(replay.touch(0), replay.recorded()));
    CHECK(late_ticks(session.reader()) == 0);
}

TEST_CASE("a run with another friction gives other proxies, beside one that is as recorded",
          "[replay]") {
    const SessionFolder folder;
    MovingSurface surface;
    record_exploration(folder, surface);
    const Session session(folder.file());
    const auto slippery = [](TouchParameters& touch) { touch.friction = {0.0, 0.0}; };
    SessionReplay replay(session, surface, {{}, slippery});
    std::int64_t other = 0;
    while (replay.next()) {
        REQUIRE(same_bits(replay.touch(0), replay.recorded()));
        if (!same_bits(replay.touch(1), replay.recorded())) ++other;
    }
    CHECK(other > 3000);
}

TEST_CASE("who replays a session whose surfaces were cleaned otherwise is told", "[replay]") {
    const SessionFolder folder;
    const auto warning = [&](SessionFacts facts, std::optional<CleaningPreset> cleaning = {}) {
        std::filesystem::remove(folder.file());
        {
            const auto ring = std::make_unique<TickRing>();
            const Recorder recorder(folder.file(), *ring, facts);
        }
        const SessionFrames frames(Session(folder.file()), {.cleaning = cleaning});
        return frames.warning();
    };
    const std::string now = std::to_string(kSurfaceVersion);
    CHECK(contains(warning({{"remove-spikes", "yes"}}), "earlier dibhr"));
    CHECK(contains(warning({{"fill-holes", "yes"}, {"surface-version", "1"}}), "earlier"));
    CHECK(warning({{"fill-holes", "yes"}, {"surface-version", now}}).empty());
    CHECK(warning({{"fill-holes", "no"}, {"remove-spikes", "no"}}).empty());
    CHECK(warning({{"remove-spikes", "yes"}}, CleaningPreset::raw).empty());
    CHECK(contains(warning({{"cleaning", "auto"}, {"surface-version", "1"}}), "earlier"));
    CHECK(warning({{"cleaning", "raw"}, {"surface-version", "1"}}).empty());
}

TEST_CASE("who replays a session whose motion was found otherwise is told, however it is cleaned",
          "[replay]") {
    const auto warning = [](const std::string& version, const auto& set) {
        const SessionFolder folder;
        MovingSurface surface;
        {
            const auto ring = std::make_unique<TickRing>();
            Recorder recorder(folder.file(), *ring, {{"surface-version", version}});
            Exploration hand(surface);
            recorder.media(1, "colour.mp4", "depth.mp4");
            TickRecord tick = hand.next();
            set(tick.frames.source);
            push(*ring, tick);
        }
        return version_warning(Session(folder.file()), false);
    };
    const std::string now = std::to_string(kSurfaceVersion);
    const auto carried = [](FrameSource& source) { source.motion = true; };
    const auto between = [](FrameSource& source) { source.in_betweens = true; };
    const auto neither = [](FrameSource&) {};
    CHECK(contains(warning("4", carried), "motion was found by an earlier dibhr"));
    CHECK(contains(warning("4", between), "motion was found by an earlier dibhr"));
    CHECK(warning("4", neither).empty());
    CHECK(warning(now, carried).empty());
}

TEST_CASE("a session without its parameters can be read, but says why it is not replayed",
          "[replay]") {
    const SessionFolder folder;
    MovingSurface surface;
    {
        const auto ring = std::make_unique<TickRing>();
        const Recorder recorder(folder.file(), *ring, {});
        Exploration hand(surface);
        for (int k = 0; k < 10; ++k) push(*ring, hand.next());
    }
    const Session session(folder.file());
    CHECK(session.rows() == 10);
    SessionReplay replay(session, surface, {{}});
    CHECK_THROWS_AS(replay.next(), InputError);
}

TEST_CASE("a renderer that was reset is as a new one", "[replay]") {
    MovingSurface surface;
    const auto image = surface.frame({}, 0.0).depth;
    const DepthSurface ground(*image, *image, 0.0, {});
    const Vec3 goal{40.0, 30.0, 60.0};
    TouchRenderer used;
    TouchParameters other;
    other.algorithm = Algorithm::god_object;
    for (int k = 0; k < 700; ++k) {
        used.update(ground, goal + Vec3{0.01 * k, 0.0, 0.0}, other, {}, {});
    }
    used.reset();
    TouchRenderer fresh;
    for (int k = 0; k < 700; ++k) {
        const Vec3 place = goal + Vec3{0.0, 0.02 * k, 20.0 - 0.1 * k};
        const Touch& again = used.update(ground, place, {}, {}, {});
        const Touch& first = fresh.update(ground, place, {}, {}, {});
        REQUIRE(again.proxy.position == first.proxy.position);
        REQUIRE(again.proxy.active == first.proxy.active);
        REQUIRE(again.sent_force_newton == first.sent_force_newton);
    }
}

TEST_CASE("the frame that was blended into is none of the next video, whatever its time is",
          "[replay]") {
    const SessionFolder folder;
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {});
        recorder.media(1, "colour.mp4", "depth.mp4");
        recorder.media(2, "other-colour.mp4", "other-depth.mp4");
        recorder.parameters({.version = 1, .touch = {}, .limits = {}, .bump = {}});
        for (std::int64_t number = 0; number < 4; ++number) {
            TickRecord tick = tick_record(number);
            tick.surface = true;
            tick.dt_s = 0.001;
            tick.settings = 1;
            tick.frames = {{.media = number < 2 ? 1U : 2U},
                           number,
                           number + 1,
                           0.1 * static_cast<double>(number),
                           0.1 * static_cast<double>(number + 1),
                           0.1};
            push(*ring, tick);
        }
    }
    const Session session(folder.file());
    AskedFrames frames;
    SessionReplay replay(session, frames, {{}});
    while (replay.next()) continue;
    CHECK(frames.media == std::vector<std::uint32_t>{1, 1, 1, 2, 2, 2});
}
