// Prints how near motion and in-betweens come to the truth (moving_scene.hpp): motion [--speeds
// A,B]
// [--rates A,B] [--seconds S] [--raw] [--true-motion]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "core/video/motion/frame_motion.hpp"
#include "core/video/motion/in_betweens.hpp"
#include "tests/core/video/moving_scene.hpp"

namespace {

using namespace dibhr;
using test::MovingScene;
using Point = MovingScene::Point;

struct TableOptions {
    std::vector<double> speeds_px{0.0, 50.0, 200.0, 400.0};
    std::vector<double> rates{15.0, 30.0, 60.0};
    double seconds{0.2};
    bool raw{false};
    bool found{true};
};

constexpr double kBeside_px = 6.0;  // nearer to an outline it is measured for itself

/// Whether everything around a place is of one thing.
bool is_within(const MovingScene& scene, double t_s, Point at, double reach_px) {
    const int object = scene.at(t_s, at).object;
    for (const double x : {-reach_px, 0.0, reach_px})
        for (const double y : {-reach_px, 0.0, reach_px})
            if (scene.at(t_s, {at.x + x, at.y + y}).object != object) return false;
    return true;
}

bool is_inside(const MovingScene& scene, Point at) {
    constexpr double kMargin_px = 5.0;
    return at.x > kMargin_px && at.y > kMargin_px && at.x < scene.what().columns - kMargin_px &&
           at.y < scene.what().rows - kMargin_px;
}

double median(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Of one pair of frames after the other.
struct Measured {
    std::vector<double> error_px{}, rim_px{}, drift_px{};
    double along_px{0.0};
    std::size_t wall{0}, wall_moves{0};
    double faded_px{0.0}, moved_px{0.0};          ///< of elevations at outlines, half way
    double faded_levels{0.0}, moved_levels{0.0};  ///< of colours
    double noise_levels{0.0};                     ///< of the first frame's, at its own time
};

void add_errors(const MovingScene& scene, const MotionField& field, double from_s, double to_s,
                Measured& measured) {
    for (int j = 0; j < field.rows; j += 3)
        for (int i = 0; i < field.columns; i += 3) {
            const Point here{1.0 * i, 1.0 * j};
            const Point there = scene.gone(from_s, here, to_s);
            if (!is_inside(scene, there)) continue;
            const auto& way = field.at(i, j);
            const bool within = is_within(scene, from_s, here, kBeside_px);
            if (scene.at(from_s, here).object == 0) {
                measured.wall += within ? 1 : 0;
                measured.wall_moves += within && way != MotionField::Way{} ? 1 : 0;
                continue;
            }
            const double x = static_cast<double>(way.right) - (there.x - here.x);
            const double y = static_cast<double>(way.down) - (there.y - here.y);
            (within ? measured.error_px : measured.rim_px).push_back(std::hypot(x, y));
            const double far = std::hypot(there.x - here.x, there.y - here.y);
            if (within && far > 0.0)
                measured.along_px += (x * (there.x - here.x) + y * (there.y - here.y)) / far;
        }
}

/// Against what a camera without noise would see then.
void add_half_way(const MovingScene& scene, const Frame& from, const Frame& to, double half_s,
                  double reach_px, Measured& measured) {
    const SurfaceShape shape{.relief_px = 255.0};
    const DepthBlend blend{&from, &to, 0.5};
    const DepthBlend shown = blend.with_in_betweens();
    const DepthSurface moved = blend.surface(shape);
    const DepthSurface faded{*from.depth, *to.depth, 0.5, shape};
    const Frame truth = scene.frame(half_s);
    const Frame first = scene.frame(from.media_s);
    for (int j = 0; j < moved.rows(); ++j)
        for (int i = 0; i < moved.columns(); ++i) {
            const Point here{1.0 * i, 1.0 * j};
            if (is_within(scene, half_s, here, reach_px)) continue;
            const std::size_t k = 3 * from.depth->index(i, j);
            const double level = 1.0 * truth.depth->at(i, j);
            const double brightness = 1.0 * truth.colour->rgb[k];
            const auto between = [k](const Frame& a, const Frame& b, double share) {
                return std::lerp(1.0 * a.colour->rgb[k], 1.0 * b.colour->rgb[k], share);
            };
            measured.moved_px += std::fabs(moved.elevation(i, j) - level);
            measured.faded_px += std::fabs(faded.elevation(i, j) - level);
            measured.moved_levels +=
                std::fabs(between(*shown.from, *shown.to, shown.blend) - brightness);
            measured.faded_levels += std::fabs(between(from, to, 0.5) - brightness);
            measured.noise_levels +=
                std::fabs(1.0 * from.colour->rgb[k] - 1.0 * first.colour->rgb[k]);
        }
}

/// Points of the thing, carried from frame to frame.
class Carried {
  public:
    explicit Carried(const MovingScene& scene) {
        for (double y = 10.0; y < scene.what().rows; y += 20.0)
            for (double x = 10.0; x < scene.what().columns; x += 20.0)
                if (scene.at(0.0, {x, y}).object != 0 && is_within(scene, 0.0, {x, y}, kBeside_px))
                    points_.push_back({{x, y}, {x, y}});
    }
    void go(const MotionField& field) {
        for (auto& [begun, now] : points_) {
            const int i = std::clamp(static_cast<int>(std::lround(now.x)), 0, field.columns - 1);
            const int j = std::clamp(static_cast<int>(std::lround(now.y)), 0, field.rows - 1);
            now.x += static_cast<double>(field.at(i, j).right);
            now.y += static_cast<double>(field.at(i, j).down);
        }
    }
    void add_to(const MovingScene& scene, double t_s, Measured& measured) const {
        for (const auto& [begun, now] : points_) {
            const Point there = scene.gone(0.0, begun, t_s);
            if (is_inside(scene, there))
                measured.drift_px.push_back(std::hypot(now.x - there.x, now.y - there.y));
        }
    }

  private:
    struct Followed {
        Point begun, now;
    };
    std::vector<Followed> points_{};
};

Measured measure(const MovingScene& scene, double rate, const TableOptions& options) {
    const int count = std::max(3, static_cast<int>(std::lround(options.seconds * rate)) + 1);
    std::vector<Frame> frames =
        test::film(scene, count, rate, {.brightness = options.raw ? 0.0 : 2.0}, !options.raw);
    Measured measured;
    Carried carried(scene);
    FrameMotion motion;
    InBetweenMaker maker;
    for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
        const double from_s = static_cast<double>(k) / rate;
        if (options.found) {
            motion.connect(frames[k], frames[k + 1], {.motion = true, .in_betweens = true});
        } else {
            frames[k].motion = scene.motion(from_s, from_s + 1.0 / rate);
            frames[k].in_betweens = maker.make(frames[k], frames[k + 1]);
        }
        MotionField still{frames[k].depth->columns, frames[k].depth->rows, {}};
        still.ways.resize(frames[k].depth->levels.size());
        const MotionField& field = frames[k].motion ? *frames[k].motion : still;
        add_errors(scene, field, from_s, from_s + 1.0 / rate, measured);
        carried.go(field);
        if (k == 1)
            add_half_way(scene, frames[k], frames[k + 1], from_s + 0.5 / rate,
                         std::max(scene.what().speed_px_per_s / rate, 2.0), measured);
    }
    carried.add_to(scene, static_cast<double>(count - 1) / rate, measured);
    measured.along_px /= static_cast<double>(std::max<std::size_t>(measured.error_px.size(), 1));
    return measured;
}

void print_row(const char* shape, const char* goes, double speed, double rate,
               const Measured& measured) {
    const auto share = [](std::size_t part, std::size_t whole) {
        return 100.0 * static_cast<double>(part) /
               static_cast<double>(std::max<std::size_t>(whole, 1));
    };
    std::printf("%-7s %-6s %5.0f %4.0f | %7.3f %7.3f %7.3f %7.2f | %6.2f | %7.2f %7.2f %7.2f\n",
                shape, goes, speed, rate, median(measured.error_px), measured.along_px,
                median(measured.rim_px), median(measured.drift_px),
                share(measured.wall_moves, measured.wall), measured.faded_px / measured.moved_px,
                measured.faded_levels / measured.moved_levels,
                measured.faded_levels / measured.noise_levels);
    std::fflush(stdout);
}

void print_table(const TableOptions& options) {
    using Shape = MovingScene::Shape;
    using Goes = MovingScene::Goes;
    std::printf("%-7s %-6s %5s %4s | %7s %7s %7s %7s | %6s | %7s %7s %7s\n", "thing", "goes",
                "px/s", "1/s", "median", "along", "rim", "carried", "wall %", "relief", "colour",
                "at best");
    for (const auto& [shape, name] :
         {std::pair{Shape::plane, "plane"}, {Shape::sphere, "sphere"}, {Shape::hand, "hand"}})
        for (const auto& [goes, word] :
             {std::pair{Goes::along, "along"}, {Goes::round, "round"}, {Goes::apart, "apart"}})
            for (const double speed : options.speeds_px)
                for (const double rate : options.rates) {
                    if (goes != Goes::along && !(speed > 0.0)) continue;
                    const MovingScene scene({shape, goes, speed, 640, 480});
                    print_row(name, word, speed, rate, measure(scene, rate, options));
                }
}

}  // namespace

int main(int argc, char** argv) {
    TableOptions options;
    CLI::App app("How near motion and in-betweens come to the truth");
    app.add_option("--speeds", options.speeds_px)->delimiter(',');
    app.add_option("--rates", options.rates)->delimiter(',');
    app.add_flag("--raw", options.raw, "Colour without noise and as it is, not coded");
    app.add_flag("!--true-motion", options.found, "As it is, not as it is found");
    app.add_option("--seconds", options.seconds, "How long points are carried");
    CLI11_PARSE(app, argc, argv);
    try {
        print_table(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "motion: %s\n", error.what());
        return 1;
    }
    return 0;
}
