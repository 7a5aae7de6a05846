// A hand that explores a moving surface, tick by tick as the haptic loop does it: something real to
// record and to replay.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/surface.hpp"
#include "core/haptics/touch.hpp"
#include "core/loop/recorded_run.hpp"
#include "core/replay/session_replay.hpp"
#include "core/session/felt_surface.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr::test {

/// Waves that wander over 96 x 64 pixels at 30 frames a second, one second long, again and again.
class MovingSurface final : public RecordedFrames {
  public:
    static constexpr int kFrames = 30;
    static constexpr double kInterval_s = 1.0 / 30.0;

    MovingSurface() {
        for (int frame = 0; frame < kFrames; ++frame) {
            auto image = std::make_shared<DepthImage>();
            image->columns = 96;
            image->rows = 64;
            for (int j = 0; j < image->rows; ++j) {
                for (int i = 0; i < image->columns; ++i) {
                    const double wave =
                        std::sin(0.2 * i + 6.28 * frame / kFrames) * std::cos(0.3 * j);
                    image->levels.push_back(static_cast<float>(std::round(100.0 + 20.0 * wave)));
                }
            }
            images_.push_back(std::move(image));
        }
    }

    [[nodiscard]] Frame frame(const FrameSource&, double media_s) override {
        return {.depth = images_.at(static_cast<std::size_t>(std::lround(media_s / kInterval_s))),
                .media_s = media_s};
    }
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters&) override {
        return nullptr;
    }

    /// The frames and the blend at a playback time.
    [[nodiscard]] static FramePair pair_at(double playback_s, double& blend) {
        const double position = playback_s / kInterval_s;
        const auto whole = static_cast<std::int64_t>(std::floor(position));
        blend = position - static_cast<double>(whole);
        const std::int64_t from = whole % kFrames;
        const std::int64_t to = (from + 1) % kFrames;
        return {{1, true, true, true},
                from,
                to,
                static_cast<double>(from) * kInterval_s,
                static_cast<double>(to) * kInterval_s,
                kInterval_s};
    }

  private:
    std::vector<std::shared_ptr<const DepthImage>> images_{};
};

/// The images of a MovingSurface, for a recorder.
class FeltMovingSurface final : public FeltSurfaces {
  public:
    explicit FeltMovingSurface(MovingSurface& surface) : surface_(surface) {}

    bool forgets{false};                                 ///< as if they were not in memory any more
    std::function<std::string(const Frame&)> picture{};  ///< of a first frame; null: none

    [[nodiscard]] std::string preview() override { return picture ? picture(from_) : ""; }

    [[nodiscard]] std::optional<FeltSurface> surface_of(const TickRecord& tick) override {
        if (forgets) return std::nullopt;
        const FramePair& pair = tick.frames;
        from_ = surface_.frame(pair.source, pair.from_s);
        to_ = surface_.frame(pair.source, pair.to_s);
        return FeltSurface{.images = {{from_.depth, {}}, {to_.depth, {}}}, .motion = {}};
    }
    [[nodiscard]] std::vector<SurfaceRead> read_by_others(const TickRecord& tick,
                                                          const SessionParameters& parameters,
                                                          const BumpMap* bump) override {
        std::vector<SurfaceRead> read;
        for (const Algorithm algorithm : all_algorithms()) {
            RecordedRun& run = runs_[static_cast<std::size_t>(algorithm)];
            TouchParameters touch = parameters.touch;
            touch.algorithm = algorithm;
            if (tick.surface) {
                run.run(tick, {&from_, &to_, tick.blend}, bump, touch, parameters);
                read.push_back(run.read());
            } else {
                run.pause();
            }
        }
        return read;
    }

  private:
    MovingSurface& surface_;
    Frame from_{}, to_{};
    std::array<RecordedRun, 4> runs_{};
};

/// Makes ticks one after the other: the hand's motion is invented, the forces are computed.
class Exploration {
  public:
    SessionParameters parameters{.version = 1, .touch = {}, .limits = {}, .bump = {}};
    double depth_px{30.0};  ///< how far the hand is below the waves' middle
    double tremor_px{0.0};  ///< up and down by so much
    Vec3 own_force_newton{0.0};
    bool releases_contact{false};  ///< in the next tick
    bool surface{true};

    explicit Exploration(MovingSurface& frames) : frames_(frames) {}

    [[nodiscard]] TickRecord next() {
        TickRecord record;
        record.tick = number_;
        const std::int64_t step_ns = 1'000'000 + 1000 * (number_ % 7);
        ns_ += step_ns;
        record.dt_s = static_cast<double>(step_ns) / 1e9;
        record.t_s = static_cast<double>(ns_) / 1e9;
        record.lateness_us = static_cast<double>(number_ % 50) + 0.123;
        record.update_us = 0.3;
        record.settings = parameters.version;
        record.surface = surface;
        record.releases_contact = releases_contact;
        surface ? touch_surface(record) : pause();
        releases_contact = false;
        const Touch& touch = touch_;
        record.goal = touch.goal;
        record.proxy = touch.proxy.position;
        record.spring_newton = touch.spring_force_newton;
        record.sent_newton = touch.sent_force_newton;
        record.own_newton = surface ? own_force_newton : Vec3(0.0);
        record.moves = touch.proxy.moves;
        record.i = touch.proxy.active.i;
        record.j = touch.proxy.active.j;
        record.contact = surface && touch.proxy.contact;
        record.primitive = static_cast<std::uint8_t>(touch.proxy.active.kind);
        record.cut = static_cast<std::uint8_t>(touch.cut);
        ++number_;
        return record;
    }

  private:
    void touch_surface(TickRecord& record) {
        const double t = record.t_s;
        record.frames = MovingSurface::pair_at(t, record.blend);
        const Frame from = frames_.frame(record.frames.source, record.frames.from_s);
        const Frame to = frames_.frame(record.frames.source, record.frames.to_s);
        const DepthSurface ground(*from.depth, *to.depth, record.blend, parameters.touch.shape);
        const Vec3 goal{48.0 + 40.0 * std::sin(1.7 * t), 32.0 + 25.0 * std::sin(2.3 * t + 1.0),
                        100.0 - depth_px * std::min(1.0, t) + tremor_px * std::sin(31.0 * t)};
        record.from_zero = from_zero_;
        from_zero_ = false;
        if (releases_contact && touch_.proxy.contact) renderer_.release_contact();
        touch_ = renderer_.update(ground, goal, parameters.touch,
                                  {.dt_s = record.dt_s,
                                   .force_enabled = parameters.force_enabled,
                                   .device_force_newton = own_force_newton,
                                   .from_zero = record.from_zero},
                                  parameters.limits);
    }

    void pause() {
        renderer_.pause();
        touch_.spring_force_newton = Vec3(0.0);
        touch_.sent_force_newton = Vec3(0.0);
        from_zero_ = true;
    }

    MovingSurface& frames_;
    TouchRenderer renderer_{};
    Touch touch_{};
    std::int64_t number_{0};
    std::int64_t ns_{0};
    bool from_zero_{true};
};

}  // namespace dibhr::test
