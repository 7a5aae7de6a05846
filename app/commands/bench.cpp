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

#include "app/commands/command_line.hpp"
#include "core/experiment/experiment.hpp"
#include "core/files/json.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/dibhr.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/touch.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/realtime/tick_timer.hpp"
#include "core/video/media.hpp"
#include "core/video/player.hpp"
#include "device/goal_stream.hpp"

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLevel = 100.0;

struct Size {
    int columns, rows;
};
constexpr Size kPaper{kPaperColumns, kPaperRows};
constexpr Size kLarge{7680, 4320};
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

/// Updates on one flat image, two depth images blended.
struct UpdateRun {
    std::string name{};  ///< in the table
    Json json{};
    SampleStatistics us{};
};

/// From the player's thread to the tick.
struct HandoverRun {
    SampleStatistics cleaning_ms{};
    SampleStatistics cleaned_to_touchable_us{};  ///< until a tick that asks gets the new frame
    SampleStatistics swap_us{};                  ///< what taking it costs that tick
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
    double clock_us{0.0};  ///< part of every update's time
    std::vector<UpdateRun> updates{};
    std::vector<UpdateRun> teleports{};  ///< the goal jumps between opposite corners
    HandoverRun handover{};
    LoopRun loop{};
};

double us_between(Clock::time_point begin, Clock::time_point end) {
    return std::chrono::duration<double, std::micro>(end - begin).count();
}

std::string text_of(Size size) {
    return std::to_string(size.columns) + "x" + std::to_string(size.rows);
}

Json json_of(const SampleStatistics& s, const std::string& unit) {
    return {{"median_" + unit, s.median}, {"mean_" + unit, s.mean},   {"p99_" + unit, s.p99},
            {"p999_" + unit, s.p999},     {"max_" + unit, s.highest}, {"samples", s.count}};
}

Json json_of(Size size, const SampleStatistics& us, Json json) {
    json["columns"] = size.columns;
    json["rows"] = size.rows;
    json.update(json_of(us, "us"));
    return json;
}

/// Two depth images blended.
class FlatSurface {
  public:
    explicit FlatSurface(Size size) : from_{size.columns, size.rows, 255.0, {}} {
        from_.levels.assign(
            static_cast<std::size_t>(size.columns) * static_cast<std::size_t>(size.rows),
            static_cast<float>(kLevel));
        to_ = from_;
    }
    [[nodiscard]] DepthSurface blended() const { return {from_, to_, 0.5, SurfaceShape{}}; }

  private:
    DepthImage from_;
    DepthImage to_{};
};

LoopRun::Lateness lateness_of(const TickSchedule& schedule) {
    const LatenessHistogram& lateness = schedule.lateness();
    const auto us = [](std::chrono::nanoseconds t) { return static_cast<double>(t.count()) / 1e3; };
    return {lateness.count(), schedule.late_ticks(), us(lateness.quantile(0.99)),
            us(lateness.worst())};
}

/// The paper's runs.
void measure_updates(Size size, std::vector<UpdateRun>& runs) {
    const FlatSurface flat(size);
    const DepthSurface surface = flat.blended();
    const PathPlace place{0.5 * size.columns, 0.5 * size.rows, kLevel, kExperimentDepth_px};
    for (const auto& [path, goal_at] :
         {std::pair{"linear", &linear_goal}, std::pair{"circle", &circle_goal}}) {
        std::vector<Vec3> goals(kExperimentUpdates);
        for (int k = 0; k < kExperimentUpdates; ++k)
            goals[static_cast<std::size_t>(k)] = goal_at(place, k);
        for (const Algorithm algorithm : all_algorithms()) {
            const auto proxy = make_algorithm(algorithm);
            const UpdateTiming timing =
                time_updates(*proxy, surface, goals, {kExperimentFriction, kExperimentFriction});
            Json json = json_of(size, timing.update_us,
                                {{"algorithm", name_of(algorithm)}, {"path", path}});
            json["moves"] = timing.moves_per_update;
            runs.push_back({name_of(algorithm) + (" " + std::string(path)) + " " + text_of(size),
                            std::move(json), timing.update_us});
        }
    }
}

/// The goal jumps from one corner to the opposite one: along the surface, or just above it.
void measure_teleports(Size size, std::vector<UpdateRun>& runs) {
    constexpr int kTeleports = 50;
    const FlatSurface flat(size);
    const DepthSurface surface = flat.blended();
    for (const auto& [where, z] :
         {std::pair{"contact", kLevel - kExperimentDepth_px}, std::pair{"air", kLevel + 1.0}}) {
        const Vec3 corners[] = {{5.3, 4.2, z}, {size.columns - 7.1, size.rows - 6.4, z}};
        Dibhr dibhr;
        std::vector<double> times_us;
        dibhr.update(surface, corners[1], {kExperimentFriction, kExperimentFriction});
        for (int k = 0; k < kTeleports; ++k) {
            const auto begin = Clock::now();
            dibhr.update(surface, corners[k % 2], {kExperimentFriction, kExperimentFriction});
            times_us.push_back(us_between(begin, Clock::now()));
        }
        const SampleStatistics us = statistics_of(std::move(times_us));
        runs.push_back({"in " + std::string(where) + " " + text_of(size),
                        json_of(size, us, {{"where", where}}), us});
    }
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
    goals.reserve(kExperimentUpdates);
    for (int k = 0; k < kExperimentUpdates; ++k) {
        goals.push_back(
            {k * 1e-3, circle_goal({0.5 * kVideo.columns, 0.5 * kVideo.rows, 90.0, 10.0}, k)});
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
    text << "  " << std::left << std::setw(38) << "" << std::right;
    for (const char* head : {"median", "mean", "p99", "p99.9", "max"}) {
        text << std::setw(11) << head;
    }
    text << "\n\nUpdate, mu " << kExperimentFriction << ", depth " << kExperimentDepth_px
         << " px, two blended images (reading the clock, " << results.clock_us
         << " us, is part of each)\n";
    for (const UpdateRun& run : results.updates) text << row(run.name, run.us, "us");
    text << "\nA goal that jumps from corner to corner\n";
    for (const UpdateRun& run : results.teleports) text << row(run.name, run.us, "us");
    const HandoverRun& handover = results.handover;
    text << "\nA new depth frame of " << text_of(kPaper) << '\n'
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
    Json updates = Json::array();
    for (const UpdateRun& run : results.updates) updates.push_back(run.json);
    Json teleports = Json::array();
    for (const UpdateRun& run : results.teleports) teleports.push_back(run.json);
    const HandoverRun& handover = results.handover;
    const LoopRun& loop = results.loop;
    return {{"mu", kExperimentFriction},
            {"depth_px", kExperimentDepth_px},
            {"clock_us", results.clock_us},
            {"updates", std::move(updates)},
            {"teleports", std::move(teleports)},
            {"handover",
             {{"columns", kPaper.columns},
              {"rows", kPaper.rows},
              {"cleaning", json_of(handover.cleaning_ms, "ms")},
              {"cleaned_to_touchable", json_of(handover.cleaned_to_touchable_us, "us")},
              {"swap", json_of(handover.swap_us, "us")}}},
            {"loops",
             {{"seconds", kLoopSeconds},
              {"empty", json_of(loop.empty)},
              {"haptic", json_of(loop.haptic)}}}};
}

BenchResults measure() {
    BenchResults results;
    results.clock_us = clock_cost_us();
    std::cerr << "Timing updates..." << std::flush;
    for (const Size size : {kPaper, kLarge}) measure_updates(size, results.updates);
    measure_teleports(kLarge, results.teleports);
    std::cerr << " frame hand-over..." << std::flush;
    results.handover = measure_handover(kPaper);
    std::cerr << " loops..." << std::flush;
    results.loop = measure_loops();
    std::cerr << " done.\n";
    return results;
}

}  // namespace

int run_bench(CLI::App& app, const Arguments& arguments) {
    std::filesystem::path file;
    add_file(app, "--json", file, "Writes the numbers as JSON; - is standard output");
    if (!parse(app, arguments)) return 0;
    std::optional<OutputFile> json;
    if (!file.empty()) json.emplace(file);  // before the work: an unwritable file is said at once
    const BenchResults results = measure();
    if (file != "-") std::cout << table_of(results);
    if (json) {
        json->write(json_text(json_of(results)));
        json->commit();
    }
    return 0;
}

}  // namespace dibhr
