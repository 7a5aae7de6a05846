// The paper's evaluation: the same goals through several proxy algorithms, side by side, and their
// results.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/vec.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/video/playing/depth_timeline.hpp"

namespace dibhr {

/// The size of the paper's images.
inline constexpr int kPaperColumns = 720;
inline constexpr int kPaperRows = 486;

/// Not printed in the paper: depth of the goals below the surface, friction of the contact.
inline constexpr double kExperimentDepth_px = 20.0;
inline constexpr double kExperimentFriction = 0.4;

/// The paper's 20 s at 1 kHz.
inline constexpr int kExperimentUpdates = 20000;
inline constexpr double kUpdate_s = 1e-3;

[[nodiscard]] inline double seconds_of(std::size_t update) noexcept {
    return kUpdate_s * static_cast<double>(update);
}

/// Distance from the exact answer over all updates in contact.
struct ExactError {
    double max_px{0.0};  ///< of the proxy
    double mean_px{0.0};
    double max_rad{0.0};  ///< of the force's direction
    double mean_rad{0.0};
};

/// The time of a piece of work [us].
struct TimeTaken {
    double wall_us{0.0};
    double processor_us{0.0};  ///< of the thread

    TimeTaken& operator+=(const TimeTaken& other) noexcept;
    /// How much of the time the thread waited for a processor, 0 to 1.
    [[nodiscard]] double waited_share() const noexcept;
};

/// Begins where it is made.
class Stopwatch {
  public:
    Stopwatch() noexcept;
    [[nodiscard]] TimeTaken taken() const noexcept;

  private:
    double processor_begin_us_;
    std::chrono::steady_clock::time_point wall_begin_;
};

/// One line where other programs disturbed the measurement; empty: they did not.
[[nodiscard]] std::string busy_machine_text(const TimeTaken& timed);

/// The results of one algorithm on one path.
struct RunFigures {
    Algorithm algorithm{Algorithm::dibhr};
    std::uint64_t bounds_met{0};  ///< updates that ended before the proxy had caught up
    SampleStatistics time_us{};   ///< of an update; each includes one reading of the clock
    /// An update's share of a run timed as a whole, no clock in it: the median of several runs by
    /// the processor's clock, which stands still while another program runs.
    double whole_run_us{0.0};
    double whole_update_us{0.0};  ///< likewise, with the force, its stability and its limits
    double moves_per_update{0.0};
    VariationStatistics variation{};
    std::optional<ExactError> error{};  ///< where there is an exact answer
};

/// The whole run; one entry an update in each vector.
struct AlgorithmRun : RunFigures {
    std::vector<Vec3> proxies{};  ///< grid space
    std::vector<double> update_us{};
    std::vector<int> moves{};     ///< primitives visited
    std::vector<char> contact{};  ///< 1: the proxy touched the surface
};

/// One path of the evaluation, its goals, and every algorithm's run over them.
struct PathRun {
    std::string name{};             ///< linear, circle, human
    std::string source{};           ///< what the goals are, for the report
    std::vector<Vec3> goals{};      ///< grid space, one a millisecond
    std::vector<double> times_s{};  ///< of the clip at each update; empty: a millisecond apart
    double mu{kExperimentFriction};
    double depth_px{kExperimentDepth_px};  ///< of the goals; for human their mean in contact
    int columns{0};                        ///< of the depth image
    int rows{0};
    int settling_updates{0};       ///< the first ones, left out of the variation while it slides
    std::vector<char> reversal{};  ///< 1: the goal's motion reverses in this update
    std::vector<Vec3> exact_proxies{};  ///< empty where no exact answer is known
    VariationStatistics exact_variation{};
    std::vector<AlgorithmRun> runs{};
    TimeTaken timed{};  ///< all timed runs together
};

/// One cell of the sweep.
struct SweepPoint {
    std::string path{};  ///< linear, circle
    double mu{0.0};
    double depth_px{0.0};
    RunFigures run{};
    TimeTaken timed{};  ///< of all algorithms in this cell
};

/// Called with the share done, 0 to 1, from time to time.
using Progress = std::function<void(double)>;

/// The flat image of the paper's linear and circle: 720 x 486.
[[nodiscard]] DepthClip paper_plane();

/// The paper's goals `depth_px` below that plane, with their exact answer.
[[nodiscard]] PathRun linear_path(double mu, double depth_px, int updates = kExperimentUpdates);
[[nodiscard]] PathRun circle_path(double mu, double depth_px, int updates = kExperimentUpdates);

/// Computes the depth of `path` below the surface of `clip` and where its motion reverses. Its
/// name, goals and times must be set.
void survey_path(PathRun& path, const DepthClip& clip);

/// How carefully updates are timed. Careful: a pass before that warms the caches, and a few passes
/// timed as a whole, by turns with the other algorithms. Quick: one pass, timed update by update.
enum class Timing { quick, careful };

/// Runs the goals of a surveyed path through the algorithms over `clip` and fills in `path.runs`.
void run_algorithms(PathRun& path, const DepthClip& clip, std::span<const Algorithm> algorithms,
                    Timing timing, const Progress& progress = {});

/// Between two readings of the clock [us].
[[nodiscard]] double us_between(std::chrono::steady_clock::time_point begin,
                                std::chrono::steady_clock::time_point end);

/// What reading the clock itself costs [us]: the median of many.
[[nodiscard]] double clock_cost_us();

/// The ranges of the sweep, which the paper does not state: as hands and devices have them.
struct SweepRange {
    std::vector<double> mus{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
    std::vector<double> depths_px{2.0, 5.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0};
    int updates{kExperimentUpdates};  ///< of each path
};

/// Runs linear and circle for all of them; the points in order of path, mu, depth, algorithm.
[[nodiscard]] std::vector<SweepPoint> run_sweep(const SweepRange& range,
                                                std::span<const Algorithm> algorithms,
                                                const Progress& progress = {});

/// Where an algorithm's force is not rougher than DIBHR's, which should never happen. Compares the
/// variation while sliding; empty when no point is of DIBHR.
[[nodiscard]] std::vector<SweepPoint> not_rougher_than_dibhr(std::span<const SweepPoint> points);

/// The proxies of goals below the plane z = `elevation_px`: the first straight above its goal, then
/// each either stays or comes to the friction cone, `p_k = g_k + R (p_(k-1) - g_k) / |...|` with
/// `R = mu depth` around the goal's foot g_k.
[[nodiscard]] std::vector<Vec3> exact_plane_proxies(std::span<const Vec3> goals,
                                                    double elevation_px, double mu);

/// Over the updates in contact; all zero when there is none.
[[nodiscard]] ExactError error_against(std::span<const Vec3> exact_proxies,
                                       std::span<const Vec3> goals, std::span<const Vec3> proxies,
                                       std::span<const char> contact);

/// 700 mm/s at 1 kHz: px per update.
inline constexpr double kHandStep_px = 700.0 / kPaperPitch_mm / 1000.0;

/// Where the paper's runs take place: the middle of an image, the goal `depth_px` below elevation
/// `surface_px`.
struct PathPlace {
    double centre_x{0.0};
    double centre_y{0.0};
    double surface_px{0.0};
    double depth_px{kExperimentDepth_px};
};

/// Along a row, 300 px to either side of the centre, back and forth; update = 0, 1, 2, ...
[[nodiscard]] Vec3 linear_goal(const PathPlace& place, int update) noexcept;

/// On a circle of radius 200 px around the centre.
[[nodiscard]] Vec3 circle_goal(const PathPlace& place, int update) noexcept;

}  // namespace dibhr
