// `dibhr bench`: measures updates, frame hand-over and loop timing on this machine, and prints a
// table for people, JSON for scripts.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/commands/bench_updates.hpp"
#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "core/experiment/experiment.hpp"
#include "core/files/json.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/realtime/tick_timer.hpp"
#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "device/goal_stream.hpp"

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;

struct Size {
    int columns, rows;
};
constexpr Size kPaper{kPaperColumns, kPaperRows};
constexpr Size kVideo{640, 480};
constexpr double kLoopSeconds = 5.0;

/// A colour + depth pair made in memory, for timing without files: a hill that wanders.
class GeneratedMedia final : public Media {
  public:
    explicit GeneratedMedia(Size size) {
        description_.colour_path = description_.depth_path = "generated";
        description_.colour_columns = description_.depth_columns = size.columns;
        description_.colour_rows = description_.depth_rows = size.rows;
        description_.frames = 60;
        description_.frames_per_s = 30.0;
        description_.duration_s = 2.0;
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

/// Hand-over of frames from the player's thread to the tick.
struct HandoverRun {
    SampleStatistics cleaning_ms{};
    SampleStatistics cleaned_to_touchable_us{};  ///< until a tick can take the frame
    SampleStatistics swap_us{};                  ///< cost of taking it in that tick
};

/// Two 1 kHz loops run at the same time on this machine: one that does nothing, and the haptic loop
/// on a playing video.
struct LoopRun {
    struct Lateness {
        std::uint64_t ticks{0};
        std::uint64_t late_ticks{0};
        double p99_us{0.0};
        double worst_us{0.0};
    };
    Lateness empty{};
    Lateness haptic{};
};

struct BenchResults {
    UpdateCosts updates{};
    HandoverRun handover{};
    LoopRun loop{};
};

LoopRun::Lateness lateness_of(const TickSchedule& schedule) {
    const LatenessHistogram& lateness = schedule.lateness();
    const auto us = [](std::chrono::nanoseconds t) { return static_cast<double>(t.count()) / 1e3; };
    return {lateness.count(), schedule.late_ticks(), us(lateness.quantile(0.99)),
            us(lateness.worst())};
}

HandoverRun measure_handover(Size size) {
    constexpr auto kDuration = std::chrono::seconds(4);
    Player player;
    player.play_media(std::make_unique<GeneratedMedia>(size));
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
        if (surface.columns() != size.columns)
            break;  // never; keeps the view from being optimised away
    }
    return {statistics_of(std::move(cleaning_ms)), statistics_of(std::move(handover_us)),
            statistics_of(std::move(swaps_us))};
}

LoopRun measure_loops() {
    Player player;
    player.play_media(std::make_unique<GeneratedMedia>(kVideo));

    std::vector<TimedGoal> goals;
    for (int k = 0; k < kExperimentUpdates; ++k) {
        goals.push_back(
            {k * 1e-3, circle_goal({0.5 * kVideo.columns, 0.5 * kVideo.rows, 90.0, 10.0}, k)});
    }
    GoalStream device("bench", std::move(goals));
    TripleBuffer<HapticSettings> settings;
    TripleBuffer<HapticState> state;
    const auto strips = std::make_unique<StripRing>();
    const auto ticks = std::make_unique<TickRing>();
    settings.publish(HapticSettings{});

    std::atomic<bool> stop{false};
    TickTimer empty_timer;
    std::thread empty([&] {
        static_cast<void>(become_realtime("bench empty"));
        while (!stop.load(std::memory_order_relaxed)) empty_timer.wait();
    });
    HapticLoop loop({device, player.haptics(), settings, state, *strips, *ticks});
    std::this_thread::sleep_for(std::chrono::duration<double>(kLoopSeconds));
    stop.store(true);
    empty.join();
    loop.stop();
    return {lateness_of(empty_timer.schedule()), lateness_of(loop.timer().schedule())};
}

std::string row(const std::string& name, const SampleStatistics& s, const std::string& unit) {
    std::ostringstream line;
    line << "  " << std::left << std::setw(38) << name << std::right << std::fixed
         << std::setprecision(3);
    for (const double value : {s.median, s.mean, s.p99, s.p999, s.highest})
        line << std::setw(11) << value;
    line << "  " << unit << '\n';
    return line.str();
}

std::string table_of(const BenchResults& results) {
    std::ostringstream text;
    text << table_of(results.updates);
    const HandoverRun& handover = results.handover;
    text << '\n'
         << std::left << std::setw(40)
         << "A new depth frame of " + size_text(kPaper.columns, kPaper.rows) << std::right;
    for (const char* head : {"median", "mean", "p99", "p99.9", "max"})
        text << std::setw(11) << head;
    text << '\n'
         << row("cleaning", handover.cleaning_ms, "ms")
         << row("from cleaned to touchable", handover.cleaned_to_touchable_us, "us")
         << row("its swap in the tick", handover.swap_us, "us");
    const LoopRun& loop = results.loop;
    text << "\n1 kHz loops side by side for " << kLoopSeconds << " s, 640x480 video at 30 fps\n";
    for (const auto& [name, lateness] :
         {std::pair{"empty loop", loop.empty}, std::pair{"haptic loop", loop.haptic}}) {
        text << "  " << std::left << std::setw(16) << name << std::right << lateness.ticks
             << " ticks, " << lateness.late_ticks << " late, 99 % within "
             << number_text(lateness.p99_us, 0) << " us, worst "
             << number_text(lateness.worst_us, 0) << " us\n";
    }
    return text.str();
}

Json json_of(const LoopRun::Lateness& lateness) {
    return {{"ticks", lateness.ticks},
            {"late_ticks", lateness.late_ticks},
            {"p99_us", lateness.p99_us},
            {"max_us", lateness.worst_us}};
}

Json json_of(const BenchResults& results) {
    const HandoverRun& handover = results.handover;
    const LoopRun& loop = results.loop;
    Json json{{"mu", kExperimentFriction},
              {"depth_px", kExperimentDepth_px},
              {"clock_us", results.updates.clock_us}};
    add_to_json(results.updates, json);
    json["handover"] = {{"columns", kPaper.columns},
                        {"rows", kPaper.rows},
                        {"cleaning", json_of(handover.cleaning_ms, "ms")},
                        {"cleaned_to_touchable", json_of(handover.cleaned_to_touchable_us, "us")},
                        {"swap", json_of(handover.swap_us, "us")}};
    json["loops"] = {{"seconds", kLoopSeconds},
                     {"empty", json_of(loop.empty)},
                     {"haptic", json_of(loop.haptic)}};
    return json;
}

BenchResults measure() {
    BenchResults results;
    std::cerr << "Timing updates..." << std::flush;
    results.updates = measure_updates();
    std::cerr << " frame hand-over..." << std::flush;
    results.handover = measure_handover(kPaper);
    std::cerr << " loops..." << std::flush;
    results.loop = measure_loops();
    std::cerr << " done.\n";
    TimeTaken timed;
    for (const PathCost& cost : results.updates.paths) timed += cost.timed;
    print_warning(busy_machine_text(timed));
    return results;
}

}  // namespace

int run_bench(CLI::App& app, const Arguments& arguments) {
    std::filesystem::path file;
    add_file(app, "--json", file, "Writes the numbers as JSON; - is standard output");
    app.footer(
        "Examples:\n"
        "  dibhr bench\n"
        "  dibhr bench --json bench.json\n"
        "  dibhr bench --json - | jq .loops");
    if (!parse(app, arguments)) return 0;
    std::optional<OutputFile> json;
    if (!file.empty()) json.emplace(file);  // first: reports an unwritable file at once
    const BenchResults results = measure();
    if (file != "-") std::cout << table_of(results);
    if (json) {
        json->write(json_text(json_of(results)));
        json->commit();
    }
    return 0;
}

}  // namespace dibhr
