// Runs the algorithms over a path and measures them.
#include "core/experiment/experiment.hpp"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/files/plain_text.hpp"
#include "core/haptics/touch.hpp"
#include "core/metrics/force_variation.hpp"

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLevel = 100.0;
constexpr double kRadius_px = 200.0;
constexpr int kWholeRuns = 9;
constexpr const char* kPlaneSource = "the paper's goals, 4961 px/s on a flat image";

/// Of the calling thread [us].
double processor_now_us() noexcept {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Of the clip at update k [s].
double time_of(const PathRun& path, std::size_t k) noexcept {
    return path.times_s.empty() ? seconds_of(k) : path.times_s[k];
}

/// One path prepared for all algorithms: its surfaces and its friction.
class PreparedPath {
  public:
    PreparedPath(const PathRun& path, const DepthClip& clip)
        : path_(path), friction_{path.mu, path.mu} {
        // Made before the runs: finding a moment's frames is the tick's work, not the algorithm's.
        surfaces_.reserve(path.goals.size());
        for (std::size_t k = 0; k < path.goals.size(); ++k) {
            surfaces_.push_back(clip.at(time_of(path, k)));
        }
    }

    /// A pass of the algorithm alone, timed as a whole.
    TimeTaken time_walk(ProxyAlgorithm& algorithm) const {
        algorithm.reset();
        const Stopwatch watch;
        for (std::size_t k = 0; k < path_.goals.size(); ++k) {
            algorithm.update(surfaces_[k], path_.goals[k], friction_);
        }
        return watch.taken();
    }

    /// A pass of whole updates, as the loop has them but for its glide and its record.
    TimeTaken time_updates(TouchRenderer& renderer, Algorithm which) const {
        const TouchParameters parameters{.algorithm = which, .friction = friction_};
        renderer.reset();
        const Stopwatch watch;
        for (std::size_t k = 0; k < path_.goals.size(); ++k) {
            renderer.update(surfaces_[k], path_.goals[k], parameters, {.dt_s = kUpdate_s}, {});
        }
        return watch.taken();
    }

    /// An update's share of a pass, by the processor's clock [us].
    [[nodiscard]] double share_us(const TimeTaken& pass) const {
        return pass.processor_us /
               static_cast<double>(std::max<std::size_t>(path_.goals.size(), 1));
    }

    /// A pass that stores the result and the time of every update.
    AlgorithmRun recorded(Algorithm which, ProxyAlgorithm& algorithm) const {
        AlgorithmRun run;
        run.algorithm = which;
        const std::size_t count = path_.goals.size();
        run.proxies.resize(count);
        run.update_us.resize(count);
        run.moves.resize(count);
        run.contact.resize(count);
        algorithm.reset();
        for (std::size_t k = 0; k < count; ++k) {
            const auto begin = Clock::now();
            const Proxy& proxy = algorithm.update(surfaces_[k], path_.goals[k], friction_);
            run.update_us[k] = us_between(begin, Clock::now());
            run.proxies[k] = proxy.position;
            run.moves[k] = proxy.moves;
            run.contact[k] = proxy.contact ? 1 : 0;
            run.bounds_met += proxy.bound_met ? 1 : 0;
        }
        return run;
    }

  private:
    const PathRun& path_;
    Friction friction_;
    std::vector<DepthSurface> surfaces_{};  ///< at each update
};

void evaluate(AlgorithmRun& run, const PathRun& path) {
    run.time_us = statistics_of(run.update_us);
    const double moves = std::accumulate(run.moves.begin(), run.moves.end(), 0.0);
    run.moves_per_update = run.moves.empty() ? 0.0 : moves / static_cast<double>(run.moves.size());
    run.variation = force_variation(path.goals, run.proxies, run.contact, path.reversal,
                                    static_cast<std::size_t>(path.settling_updates));
    if (!path.exact_proxies.empty()) {
        run.error = error_against(path.exact_proxies, path.goals, run.proxies, run.contact);
    }
}

PathRun plane_path(const char* name, Vec3 (*goal_at)(const PathPlace&, int) noexcept, double mu,
                   double depth_px, int updates, int settling_updates) {
    PathRun path;
    path.name = name;
    path.source = kPlaneSource;
    path.settling_updates = settling_updates;
    path.mu = mu;
    path.depth_px = depth_px;
    path.columns = kPaperColumns;
    path.rows = kPaperRows;
    const PathPlace place{0.5 * kPaperColumns, 0.5 * kPaperRows, kLevel, depth_px};
    for (int k = 0; k < updates; ++k) path.goals.push_back(goal_at(place, k));
    path.reversal =
        reversal_updates(path.goals, std::vector<double>(path.goals.size(), depth_px), mu);
    path.exact_proxies = exact_plane_proxies(path.goals, kLevel, mu);
    const std::vector<char> contact(path.goals.size(), 1);
    path.exact_variation = force_variation(path.goals, path.exact_proxies, contact, path.reversal,
                                           static_cast<std::size_t>(settling_updates));
    return path;
}

bool same_cell(const SweepPoint& a, const SweepPoint& b) {
    return a.path == b.path && a.mu == b.mu && a.depth_px == b.depth_px;
}

constexpr double kHalfLine_px = 300.0;

}  // namespace

DepthClip paper_plane() {
    DepthImage image{kPaperColumns, kPaperRows, 255.0, {}};
    image.levels.assign(std::size_t{kPaperColumns} * std::size_t{kPaperRows},
                        static_cast<float>(kLevel));
    return {{{.depth = std::make_shared<const DepthImage>(std::move(image))}}, SurfaceShape{}};
}

PathRun linear_path(double mu, double depth_px, int updates) {
    return plane_path("linear", &linear_goal, mu, depth_px, updates, 0);
}

PathRun circle_path(double mu, double depth_px, int updates) {
    // The first revolution: until then the proxy spirals into its orbit.
    const int settling_updates =
        static_cast<int>(std::ceil(2.0 * std::numbers::pi * kRadius_px / kHandStep_px)) + 1;
    return plane_path("circle", &circle_goal, mu, depth_px, updates, settling_updates);
}

void survey_path(PathRun& path, const DepthClip& clip) {
    path.columns = clip.columns();
    path.rows = clip.rows();
    std::vector<double> depths_px(path.goals.size());
    double sum_px = 0.0;
    std::size_t below = 0;
    for (std::size_t k = 0; k < path.goals.size(); ++k) {
        const Vec3& goal = path.goals[k];
        depths_px[k] = clip.at(time_of(path, k)).elevation_at(goal.x, goal.y) - goal.z;
        if (depths_px[k] <= 0.0) continue;
        sum_px += depths_px[k];
        ++below;
    }
    path.depth_px = below == 0 ? 0.0 : sum_px / static_cast<double>(below);
    path.reversal = reversal_updates(path.goals, depths_px, path.mu);
}

void run_algorithms(PathRun& path, const DepthClip& clip, std::span<const Algorithm> algorithms,
                    Timing timing, const Progress& progress) {
    const PreparedPath prepared(path, clip);
    const bool careful = timing == Timing::careful;
    const int rounds = careful ? kWholeRuns : 0;
    const std::size_t passes = algorithms.size() * static_cast<std::size_t>(1 + rounds);
    std::size_t done = 0;
    const auto report_progress = [&] {
        if (progress) progress(static_cast<double>(++done) / static_cast<double>(passes));
    };

    TouchRenderer renderer;
    std::vector<std::unique_ptr<ProxyAlgorithm>> walkers;
    std::vector<AlgorithmRun> runs;
    for (const Algorithm which : algorithms) {
        ProxyAlgorithm& walker = *walkers.emplace_back(make_algorithm(which));
        if (careful) static_cast<void>(prepared.time_walk(walker));
        const Stopwatch watch;
        runs.push_back(prepared.recorded(which, walker));
        path.timed += watch.taken();
        report_progress();
    }
    std::vector<std::vector<double>> walks_us(algorithms.size());
    std::vector<std::vector<double>> updates_us(algorithms.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t a = 0; a < algorithms.size(); ++a) {
            const TimeTaken walk = prepared.time_walk(*walkers[a]);
            const TimeTaken updates = prepared.time_updates(renderer, algorithms[a]);
            walks_us[a].push_back(prepared.share_us(walk));
            updates_us[a].push_back(prepared.share_us(updates));
            path.timed += walk;
            path.timed += updates;
            report_progress();
        }
    }
    for (std::size_t a = 0; a < algorithms.size(); ++a) {
        runs[a].whole_run_us = statistics_of(std::move(walks_us[a])).median;
        runs[a].whole_update_us = statistics_of(std::move(updates_us[a])).median;
        evaluate(runs[a], path);
    }
    path.runs = std::move(runs);
}

TimeTaken& TimeTaken::operator+=(const TimeTaken& other) noexcept {
    wall_us += other.wall_us;
    processor_us += other.processor_us;
    return *this;
}

double TimeTaken::waited_share() const noexcept {
    return wall_us > 0.0 ? std::clamp(1.0 - processor_us / wall_us, 0.0, 1.0) : 0.0;
}

// The wall clock is read last and first: what reading the processor's costs is not in its time.
Stopwatch::Stopwatch() noexcept
    : processor_begin_us_(processor_now_us()), wall_begin_(Clock::now()) {}

TimeTaken Stopwatch::taken() const noexcept {
    const double wall_us = us_between(wall_begin_, Clock::now());
    return {wall_us, processor_now_us() - processor_begin_us_};
}

std::string busy_machine_text(const TimeTaken& timed) {
    constexpr double kSlight = 0.05;
    const double share = timed.waited_share();
    if (share < kSlight) return {};
    return "other programs had the processor for " + number_text(100.0 * share, 0) +
           " % of the time: averages leave that out, single and slowest updates do not; close them "
           "and measure again";
}

double us_between(Clock::time_point begin, Clock::time_point end) {
    return std::chrono::duration<double, std::micro>(end - begin).count();
}

double clock_cost_us() {
    std::vector<double> costs(10001);
    for (double& cost : costs) {
        const auto begin = Clock::now();
        cost = us_between(begin, Clock::now());
    }
    return statistics_of(std::move(costs)).median;
}

std::vector<SweepPoint> run_sweep(const SweepRange& range, std::span<const Algorithm> algorithms,
                                  const Progress& progress) {
    const DepthClip plane = paper_plane();
    const std::size_t cells = 2 * range.mus.size() * range.depths_px.size();
    std::vector<SweepPoint> points;
    std::size_t done = 0;
    for (const auto make_path : {&linear_path, &circle_path}) {
        for (const double mu : range.mus) {
            for (const double depth_px : range.depths_px) {
                PathRun path = make_path(mu, depth_px, range.updates);
                run_algorithms(path, plane, algorithms, Timing::quick);
                for (const AlgorithmRun& run : path.runs) {
                    points.push_back({path.name, path.mu, path.depth_px, run, path.timed});
                }
                ++done;
                if (progress) progress(static_cast<double>(done) / static_cast<double>(cells));
            }
        }
    }
    return points;
}

std::vector<SweepPoint> not_rougher_than_dibhr(std::span<const SweepPoint> points) {
    // Two forces that both stand still are equally smooth: no difference below round-off counts.
    constexpr double kRoundOff_deg = 1e-9;
    std::vector<SweepPoint> found;
    for (const SweepPoint& ours : points) {
        if (ours.run.algorithm != Algorithm::dibhr) continue;
        for (const SweepPoint& other : points) {
            if (other.run.algorithm == Algorithm::dibhr || !same_cell(ours, other)) continue;
            const double rougher_deg = other.run.variation.mean_without_reversals_deg -
                                       ours.run.variation.mean_without_reversals_deg;
            if (rougher_deg <= kRoundOff_deg) found.push_back(other);
        }
    }
    return found;
}

std::vector<Vec3> exact_plane_proxies(std::span<const Vec3> goals, double elevation_px, double mu) {
    std::vector<Vec3> proxies;
    proxies.reserve(goals.size());
    for (const Vec3& goal : goals) {
        const Vec3 foot{goal.x, goal.y, elevation_px};
        const double cone_px = mu * (elevation_px - goal.z);
        if (proxies.empty()) {
            proxies.push_back(foot);
            continue;
        }
        const Vec3 lag = proxies.back() - foot;
        const double distance_px = glm::length(lag);
        const bool sticks = distance_px <= cone_px;
        proxies.push_back(sticks ? proxies.back() : foot + (cone_px / distance_px) * lag);
    }
    return proxies;
}

ExactError error_against(std::span<const Vec3> exact_proxies, std::span<const Vec3> goals,
                         std::span<const Vec3> proxies, std::span<const char> contact) {
    ExactError error;
    std::size_t count = 0;
    for (std::size_t k = 0; k < goals.size(); ++k) {
        if (contact[k] == 0) continue;
        const double off_px = glm::length(proxies[k] - exact_proxies[k]);
        const double off_rad =
            angle_between_rad(proxies[k] - goals[k], exact_proxies[k] - goals[k]);
        error.max_px = std::max(error.max_px, off_px);
        error.max_rad = std::max(error.max_rad, off_rad);
        error.mean_px += off_px;
        error.mean_rad += off_rad;
        ++count;
    }
    if (count > 0) {
        error.mean_px /= static_cast<double>(count);
        error.mean_rad /= static_cast<double>(count);
    }
    return error;
}

Vec3 linear_goal(const PathPlace& place, int update) noexcept {
    const double travelled = std::fmod(update * kHandStep_px, 4.0 * kHalfLine_px);
    const double x = travelled < 2.0 * kHalfLine_px ? travelled : 4.0 * kHalfLine_px - travelled;
    return {place.centre_x - kHalfLine_px + x, place.centre_y, place.surface_px - place.depth_px};
}

Vec3 circle_goal(const PathPlace& place, int update) noexcept {
    const double turned_rad = update * kHandStep_px / kRadius_px;
    return {place.centre_x + kRadius_px * std::cos(turned_rad),
            place.centre_y + kRadius_px * std::sin(turned_rad), place.surface_px - place.depth_px};
}

}  // namespace dibhr
