// The measurements behind `dibhr bench`.
#include "app/commands/bench_measurements.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <thread>
#include <utility>

#include "core/experiment/exact_plane.hpp"
#include "core/haptics/dibhr.hpp"
#include "core/haptics/touch.hpp"
#include "core/loop/haptic_loop.hpp"
#include "core/realtime/tick_timer.hpp"
#include "core/video/media.hpp"
#include "core/video/player.hpp"
#include "device/goal_stream.hpp"

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kUpdates = 20000;  // the paper's 20 s
constexpr double kLevel = 100.0;

/// A colour + depth pair made in memory, for timing without files: a hill that wanders.
class GeneratedMedia final : public Media {
  public:
    GeneratedMedia(int columns, int rows, int frames, double frames_per_s) {
        description_.colour_path = description_.depth_path = "generated";
        description_.colour_columns = description_.depth_columns = columns;
        description_.colour_rows = description_.depth_rows = rows;
        description_.frames = frames;
        description_.frames_per_s = frames_per_s;
        description_.duration_s = frames / frames_per_s;
    }

    [[nodiscard]] const MediaDescription& description() const override { return description_; }

    std::optional<RawFrame> next() override {
        if (next_ >= description_.frames) return std::nullopt;
        RawFrame frame;
        frame.index = next_++;
        frame.media_s = static_cast<double>(frame.index) / description_.frames_per_s;
        const double phase = 2.0 * std::numbers::pi * static_cast<double>(frame.index) /
                             static_cast<double>(description_.frames);
        DepthImage& depth = frame.depth;
        depth.columns = description_.depth_columns;
        depth.rows = description_.depth_rows;
        depth.levels.resize(static_cast<std::size_t>(depth.columns) *
                            static_cast<std::size_t>(depth.rows));
        const double centre_x = depth.columns * (0.5 + 0.1 * std::cos(phase));
        const double centre_y = depth.rows * (0.5 + 0.1 * std::sin(phase));
        for (int j = 0; j < depth.rows; ++j) {
            for (int i = 0; i < depth.columns; ++i) {
                const double x = (i - centre_x) / (0.3 * depth.columns);
                const double y = (j - centre_y) / (0.3 * depth.columns);
                // Whole levels, as an 8-bit video has them.
                depth.at(i, j) =
                    static_cast<float>(std::round(60.0 + 120.0 / (1.0 + 2.0 * (x * x + y * y))));
            }
        }
        frame.colour.columns = depth.columns;
        frame.colour.rows = depth.rows;
        frame.colour.rgb.assign(3 * depth.levels.size(), 128);
        return frame;
    }

    void seek(double media_s) override {
        const auto frame = static_cast<std::int64_t>(media_s * description_.frames_per_s + 1e-6);
        next_ = std::clamp<std::int64_t>(frame, 0, description_.frames - 1);
    }

  private:
    MediaDescription description_{};
    std::int64_t next_{0};
};

double us_between(Clock::time_point begin, Clock::time_point end) {
    return std::chrono::duration<double, std::micro>(end - begin).count();
}

DepthImage flat_image(int columns, int rows) {
    DepthImage image{columns, rows, 255.0, {}};
    image.levels.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                        static_cast<float>(kLevel));
    return image;
}

LoopRun::Lateness lateness_of(const TickSchedule& schedule) {
    const LatenessHistogram& lateness = schedule.lateness();
    const auto us = [](std::chrono::nanoseconds t) { return static_cast<double>(t.count()) / 1e3; };
    return {lateness.count(), schedule.late_ticks(), us(lateness.quantile(0.99)),
            us(lateness.worst())};
}

}  // namespace

std::vector<UpdateRun> measure_updates(const BenchResults& settings, int columns, int rows) {
    const DepthImage from = flat_image(columns, rows);
    const DepthImage to = flat_image(columns, rows);
    const DepthSurface surface(from, to, 0.5, SurfaceShape{});
    const PathPlace place{0.5 * columns, 0.5 * rows, kLevel, settings.depth_px};
    std::vector<UpdateRun> runs;
    for (const auto& [name, goal_at] :
         {std::pair{"linear", &linear_goal}, std::pair{"circle", &circle_goal}}) {
        std::vector<Vec3> goals(kUpdates);
        for (int k = 0; k < kUpdates; ++k) goals[static_cast<std::size_t>(k)] = goal_at(place, k);
        for (const Algorithm algorithm : all_algorithms()) {
            const auto proxy = make_algorithm(algorithm);
            runs.push_back({algorithm, name, columns, rows,
                            time_updates(*proxy, surface, goals, {settings.mu, settings.mu})});
        }
    }
    return runs;
}

std::vector<TeleportRun> measure_teleports(const BenchResults& settings, int columns, int rows) {
    constexpr int kTeleports = 50;
    const DepthImage from = flat_image(columns, rows);
    const DepthImage to = flat_image(columns, rows);
    const DepthSurface surface(from, to, 0.5, SurfaceShape{});
    std::vector<TeleportRun> runs;
    for (const auto& [name, z] :
         {std::pair{"contact", kLevel - settings.depth_px}, std::pair{"air", kLevel + 1.0}}) {
        const Vec3 corners[] = {{5.3, 4.2, z}, {columns - 7.1, rows - 6.4, z}};
        Dibhr dibhr;
        std::vector<double> times_us;
        dibhr.update(surface, corners[1], {settings.mu, settings.mu});
        for (int k = 0; k < kTeleports; ++k) {
            const auto begin = Clock::now();
            dibhr.update(surface, corners[k % 2], {settings.mu, settings.mu});
            times_us.push_back(us_between(begin, Clock::now()));
        }
        runs.push_back({name, columns, rows, statistics_of(std::move(times_us))});
    }
    return runs;
}

HandoverRun measure_handover(int columns, int rows) {
    constexpr auto kDuration = std::chrono::seconds(4);
    Player player;
    player.play_media(std::make_unique<GeneratedMedia>(columns, rows, 60, 30.0));
    std::vector<double> swaps_us;
    std::vector<double> cleaning_ms;
    std::vector<double> handover_us;
    const auto end = Clock::now() + kDuration;
    TickTimer timer;
    while (Clock::now() < end) {
        timer.wait();
        if (!player.haptics().fresh()) continue;
        const auto begin = Clock::now();
        const FrameWindow& frames = player.haptics().front();
        const DepthBlend pair = frames.at(frames.clock.playback_s(begin));
        if (pair.from == nullptr) continue;
        const DepthSurface surface = pair.surface(SurfaceShape{});
        swaps_us.push_back(us_between(begin, Clock::now()));
        const PlaybackStatus status = player.status();
        cleaning_ms.push_back(status.clean_ms);
        handover_us.push_back(status.handover_us);
        if (surface.columns() != columns) break;  // never; keeps the view from being optimised away
    }
    return {columns, rows, statistics_of(std::move(cleaning_ms)),
            statistics_of(std::move(handover_us)), statistics_of(std::move(swaps_us))};
}

LoopRun measure_loops(double seconds) {
    constexpr int kColumns = 640;
    constexpr int kRows = 480;
    Player player;
    player.play_media(std::make_unique<GeneratedMedia>(kColumns, kRows, 60, 30.0));

    std::vector<TimedGoal> goals;
    for (int k = 0; k < kUpdates; ++k) {
        goals.push_back({k * 1e-3, circle_goal({0.5 * kColumns, 0.5 * kRows, 90.0, 10.0}, k)});
    }
    GoalStream device("bench", std::move(goals));
    TripleBuffer<HapticSettings> settings;
    TripleBuffer<HapticState> state;
    const auto forces = std::make_unique<ForceRing>();
    const auto ticks = std::make_unique<TickRing>();
    settings.publish(HapticSettings{});

    std::atomic<bool> stop{false};
    TickTimer empty_timer;
    std::thread empty([&] {
        static_cast<void>(become_realtime("bench empty"));
        while (!stop.load(std::memory_order_relaxed)) empty_timer.wait();
    });
    HapticLoop loop({device, player.haptics(), settings, state, *forces, *ticks});
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    stop.store(true);
    empty.join();
    loop.stop();
    return {seconds, lateness_of(empty_timer.schedule()), lateness_of(loop.timer().schedule())};
}

}  // namespace dibhr
