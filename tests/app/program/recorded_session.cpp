// Records a session without a window.
#include "tests/app/program/recorded_session.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "core/loop/haptic_tick.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session_file.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/playing/playback.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/sidecar.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::test {

namespace {

using std::chrono::steady_clock;

class ScriptedHand final : public Device {
  public:
    ScriptedHand(double columns, double rows, bool jumps)
        : columns_(columns), rows_(rows), jumps_(jumps) {}
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return specification_;
    }
    HandReading read(const HandContext& context) noexcept override {
        t_s_ += context.dt_s;
        if (jumps_) {
            const double x = std::fmod(t_s_, 0.2) < 0.1 ? 5.0 : columns_ - 6.0;
            const double y = 0.5 * rows_;
            return {.goal_in_grid = {x, y, context.surface.elevation_at(x, y) - 20.0}};
        }
        const double x = columns_ * (0.5 + 0.45 * std::sin(0.9 * t_s_));
        const double y = rows_ * (0.5 + 0.45 * std::sin(1.3 * t_s_ + 1.0));
        const double height_px = 4.0 + 12.0 * std::cos(7.0 * t_s_);
        return {.goal_in_grid = {x, y, context.surface.elevation_at(x, y) + height_px}};
    }
    void send(Vec3) noexcept override {}

  private:
    DeviceSpecification specification_{};
    double columns_;
    double rows_;
    bool jumps_;
    double t_s_{0.0};
};

}  // namespace

void record_session(const std::filesystem::path& file, const RecordedSession& wanted) {
    auto media = open_media(wanted.colour, wanted.depth, {.find_out = wanted.finds_out});
    const MediaDescription description = media->description();
    ScriptedHand hand(description.depth_columns, description.depth_rows, wanted.jumps);

    const steady_clock::time_point begin = steady_clock::now();
    Playback playback;
    playback.set_cleaning(wanted.cleaning);
    playback.open(std::make_unique<FrameReader>(std::move(media), 1), begin);

    TripleBuffer<FrameWindow> frames;
    TripleBuffer<HapticSettings> settings;
    TripleBuffer<HapticState> state;
    const auto strips = std::make_unique<StripRing>();
    const auto ticks = std::make_unique<TickRing>();
    HapticTick tick({hand, frames, settings, state, *strips, *ticks});

    SessionFacts facts = library_versions();
    facts["device"] = "a scripted hand";
    Recorder recorder(file, *ticks, facts);
    recorder.media(1, wanted.colour, wanted.depth,
                   description.meaning ? toml_of(description.meaning->statement()) : std::string{});
    HapticSettings handed{.parameters = wanted.parameters, .recording = true};
    if (!wanted.bump.empty()) {
        handed.bump = std::make_shared<const BumpMap>(read_bump_map(wanted.bump));
    }
    const auto hand_over = [&] {
        ++handed.version;
        recorder.parameters({.version = handed.version,
                             .touch = handed.parameters,
                             .limits = handed.limits,
                             .force_enabled = handed.force_enabled,
                             .bump = {wanted.bump}});
        settings.publish(handed);
    };
    const auto count = std::llround(wanted.seconds * 1e3);
    std::int64_t in_contact = 0;
    for (std::int64_t k = 0; k < count; ++k) {
        if (k == count / 2) handed.parameters.friction = {0.3, 0.2};
        if (k % (count / 2) == 0) hand_over();
        const auto now = begin + std::chrono::milliseconds(k);
        bool changed = playback.advance(now) || k == 0;
        while (playback.needs_frame() && playback.read_ahead(now)) {
            playback.on_frame_read(now);
            changed = true;
        }
        const bool surface = k < count - wanted.ticks_without_surface;
        if (changed && surface) frames.publish(playback.window());
        if (k == count - wanted.ticks_without_surface) frames.publish({});
        while (ticks->size() == ticks->room()) std::this_thread::yield();
        tick.run({now, 0.001, {}, false}, 0);
        in_contact += state.front().touch.proxy.contact ? 1 : 0;
    }
    const RecorderStatus status = recorder.finish();
    // Or a replay would prove little; the first contact is a third of a second on.
    REQUIRE((wanted.seconds < 1.0 || in_contact > count / 5));
    REQUIRE(status.failure.empty());
    REQUIRE(status.dropped == 0);
    REQUIRE(status.rows == static_cast<std::uint64_t>(count));
}

void write_moving_hand(const std::filesystem::path& file, int ticks, int depth_rows) {
    SessionFile session(file, {{"depth-columns", "640"},
                               {"depth-rows", std::to_string(depth_rows)},
                               {"depth", "depth.mp4"}});
    session.begin();
    for (int k = 0; k < ticks; ++k) {
        TickRecord tick;
        tick.tick = k;
        tick.t_s = 0.001 * k;
        tick.frames.from_frame = k / 33;
        tick.contact = true;
        tick.goal = {250.0 + 0.1 * k, 400.0, 90.0};
        session.add(tick);
    }
    session.commit();
    session.merge_log();
}

}  // namespace dibhr::test
