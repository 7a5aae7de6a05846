// The evaluation's pictures: axes that can be read, data where it belongs, files that arrive.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/experiment/experiment.hpp"
#include "core/experiment/plots.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/plot/axes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

namespace fs = std::filesystem;

constexpr int kUpdates = 1200;
constexpr Ink kWhite{255, 255, 255};
constexpr Ink kBlack{0, 0, 0};

/// The exact proxies, moved aside by up to `hop_px` from update to update.
AlgorithmRun hopping_run(const PathRun& path, Algorithm algorithm, double hop_px) {
    AlgorithmRun run;
    run.algorithm = algorithm;
    run.contact.assign(path.goals.size(), 1);
    for (std::size_t k = 0; k < path.goals.size(); ++k) {
        const double aside = hop_px * std::sin(2.0 * static_cast<double>(k));
        run.proxies.push_back(path.exact_proxies[k] + Vec3{aside, -aside, 0.0});
    }
    run.variation = force_variation(path.goals, run.proxies, run.contact, path.reversal,
                                    static_cast<std::size_t>(path.settling_updates));
    return run;
}

/// A circle with one calm and one restless algorithm.
PathRun circle_with_runs() {
    PathRun path = circle_path(0.4, 20.0, kUpdates);
    path.runs = {hopping_run(path, Algorithm::dibhr, 0.0), hopping_run(path, Algorithm::pga, 0.8)};
    return path;
}

/// How many pixels are of this ink, within what reduction does to its edges.
std::size_t pixels_of(const ColourImage& picture, Ink ink) {
    const auto near = [](int a, int b) { return std::abs(a - b) <= 6; };
    std::size_t count = 0;
    for (std::size_t k = 0; k < picture.rgb.size(); k += 3) {
        count += near(picture.rgb[k], ink.red) && near(picture.rgb[k + 1], ink.green) &&
                 near(picture.rgb[k + 2], ink.blue);
    }
    return count;
}

/// Rows of the canvas with anything dark between two columns.
std::set<int> dark_rows(const ColourImage& picture, int from_x, int to_x) {
    std::set<int> rows;
    for (int y = 0; y < picture.rows; ++y) {
        for (int x = from_x; x < to_x; ++x) {
            const std::size_t k =
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.columns) +
                     static_cast<std::size_t>(x));
            if (picture.rgb[k] < 128) rows.insert(y);
        }
    }
    return rows;
}

}  // namespace

TEST_CASE("ticks are round, ascending, inside their span and not too many", "[axes]") {
    const ValueSpan span =
        GENERATE(ValueSpan{0.0, 1.0}, ValueSpan{0.3, 0.6}, ValueSpan{-90.0, 270.0},
                 ValueSpan{497.3, 511.3}, ValueSpan{0.0, 2e-7}, ValueSpan{-3e6, 17.0});
    const int most = GENERATE(2, 5, 8);
    CAPTURE(span.low, span.high, most);
    const std::vector<double> ticks = round_ticks(span, most);
    REQUIRE_FALSE(ticks.empty());
    CHECK(static_cast<int>(ticks.size()) <= most);
    CHECK(std::is_sorted(ticks.begin(), ticks.end()));
    const double slack = 1e-6 * (span.high - span.low);
    CHECK(ticks.front() >= span.low - slack);
    CHECK(ticks.back() <= span.high + slack);
    if (ticks.size() < 2) return;
    const double step = ticks[1] - ticks[0];
    const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
    CAPTURE(step);
    CHECK(std::min({std::abs(digit - 1.0), std::abs(digit - 2.0), std::abs(digit - 5.0)}) < 1e-6);
}

TEST_CASE("logarithmic ticks are powers of ten", "[axes]") {
    const int most = GENERATE(3, 6, 9);
    const std::vector<double> ticks = decade_ticks({2e-16, 100.0}, most);
    REQUIRE(ticks.size() >= 2);
    CHECK(static_cast<int>(ticks.size()) <= most);
    CHECK_THAT(ticks.back(), WithinAbs(100.0, 1e-9));
    for (const double tick : ticks) {
        const double power = std::log10(tick);
        CHECK_THAT(power, WithinAbs(std::round(power), 1e-9));
    }
}

TEST_CASE("numbers beside the ticks are short", "[axes]") {
    CHECK(tick_text(0.0) == "0");
    CHECK(tick_text(0.1 * 3.0) == "0.3");
    CHECK(tick_text(-90.0) == "-90");
    CHECK(decade_text(0.01) == "0.01");
    CHECK(decade_text(100.0) == "100");
    CHECK(decade_text(1e-12) == "1e-12");
    CHECK(fixed_text(0.5284, 2) == "0.53");
    CHECK(fixed_text(0.0, 2) == "0");
}

TEST_CASE("the ends of an axis are the edges of its area, turned around or logarithmic", "[axes]") {
    const Box area{10.0, 20.0, 110.0, 220.0};
    const Axes plain(area, {{0.0, 4.0}, "x"}, {{-1.0, 1.0}, "y"});
    CHECK(plain.at(0.0, -1.0) == Vec2(10.0, 220.0));
    CHECK(plain.at(4.0, 1.0) == Vec2(110.0, 20.0));
    const Axes image(area, {{0.0, 4.0}, "x"}, {{100.0, 0.0}, "row"});
    CHECK(image.at(0.0, 0.0) == Vec2(10.0, 20.0));
    const Axes decades(area, {{0.0, 4.0}, "x"}, {{1e-4, 1.0}, "error", true});
    CHECK_THAT(decades.at(0.0, 1e-2).y, WithinAbs(120.0, 1e-9));
    CHECK_THAT(decades.at(0.0, 0.0).y, WithinAbs(220.0, 1e-9));
    CHECK_THAT(decades.at(0.0, -3.0).y, WithinAbs(220.0, 1e-9));
}

TEST_CASE("a peak or a dip of one update among twenty thousand is drawn", "[axes]") {
    const bool peak = GENERATE(true, false);
    CAPTURE(peak);
    std::vector<Vec2> values;
    for (int k = 0; k < 20000; ++k) values.emplace_back(k, (k == 12345) == peak ? 1.0 : 0.0);
    const Axes axes({10.0, 10.0, 210.0, 110.0}, {{0.0, 19999.0}, "x"}, {{-0.1, 1.1}, "y"});
    Canvas canvas(220, 120, kWhite);
    axes.draw_series(canvas, values, {kBlack, 1.5, Dash::solid});
    const int x = static_cast<int>(axes.at(12345.0, 0.0).x);
    const std::set<int> rows = dark_rows(canvas.finished(), x - 2, x + 3);
    REQUIRE_FALSE(rows.empty());
    CHECK(*rows.begin() < axes.at(0.0, 0.9).y);
    CHECK(*rows.rbegin() > axes.at(0.0, 0.1).y);
}

TEST_CASE("a series stays in its area and breaks where there is no value", "[axes]") {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Vec2> values{{0.0, 0.5}, {4.0, 0.5}, {5.0, nothing}, {6.0, 0.5}, {10.0, 9.0}};
    const Axes axes({20.0, 20.0, 120.0, 120.0}, {{0.0, 10.0}, "x"}, {{0.0, 1.0}, "y"});
    Canvas canvas(140, 140, kWhite);
    axes.draw_series(canvas, values, {kBlack, 2.0, Dash::solid});
    const ColourImage picture = canvas.finished();
    CHECK_FALSE(dark_rows(picture, 30, 50).empty());
    CHECK(dark_rows(picture, 63, 77).empty());  // between x = 4 and x = 6
    const std::set<int> all = dark_rows(picture, 0, 140);
    CHECK(*all.begin() >= 20);
    CHECK(*all.rbegin() < 120);
}

TEST_CASE("algorithms differ in colour, dashes, marker and name", "[style]") {
    std::set<std::string> names;
    std::set<Dash> dashes;
    std::set<Marker> markers;
    std::set<int> colours;
    for (const Algorithm algorithm : all_algorithms()) {
        const SeriesStyle look = style_of(algorithm);
        names.insert(look.name);
        dashes.insert(look.stroke.dash);
        markers.insert(look.marker);
        colours.insert(look.stroke.ink.red * 65536 + look.stroke.ink.green * 256 +
                       look.stroke.ink.blue);
    }
    CHECK(names.size() == all_algorithms().size());
    CHECK(dashes.size() == names.size());
    CHECK(markers.size() == names.size());
    CHECK(colours.size() == names.size());
    CHECK(names.count("") == 0);
    CHECK(markers.count(Marker::none) == 0);
}

TEST_CASE("the place magnified is settled, in contact and the same every time", "[plots]") {
    PathRun path = circle_with_runs();
    std::fill(path.runs[1].contact.begin(), path.runs[1].contact.begin() + 400, char{0});
    const MagnifiedPlace place = typical_place(path);
    CHECK(place.update >= 400);
    CHECK(place.update < path.goals.size());
    CHECK(place.update == typical_place(path).update);
    const Vec3 goal = path.goals[place.update];
    CHECK(std::abs(goal.x - place.centre.x) < place.side_px / 2.0);
    CHECK(std::abs(goal.y - place.centre.y) < place.side_px / 2.0);
    CHECK(updates_a_marker(path, place) == 1);
}

TEST_CASE("markers of a slow hand are thinned out", "[plots]") {
    PathRun path = circle_with_runs();
    for (std::size_t k = 0; k < path.goals.size(); ++k) {
        path.goals[k] = path.goals[0] + Vec3{0.05 * static_cast<double>(k), 0.0, 0.0};
    }
    const std::size_t step = updates_a_marker(path, {{0.0, 0.0}, 14.0, 600});
    CHECK(step >= 5);
    CHECK(step <= 20);
}

TEST_CASE("the scale of the turns holds the restless algorithm and is round", "[plots]") {
    const PathRun path = circle_with_runs();
    const double highest = highest_turn_deg(path);
    CHECK(highest > path.runs[1].variation.mean_deg);
    CHECK(highest < 90.0);
    const double power = std::pow(10.0, std::floor(std::log10(highest)));
    CHECK_THAT(highest / power, WithinAbs(std::round(highest / power), 1e-9));
}

TEST_CASE("every picture of a path shows each algorithm in its own ink", "[plots]") {
    const PathRun path = circle_with_runs();
    for (const ColourImage& picture :
         {plot_paths(path, nullptr).finished(), plot_force(path).finished(),
          plot_error(path).finished(), plot_explanation(path).finished()}) {
        CHECK(picture.columns == 1200);
        CHECK(picture.rows >= 600);
        for (const AlgorithmRun& run : path.runs) {
            CHECK(pixels_of(picture, style_of(run.algorithm).stroke.ink) > 100);
        }
        CHECK(pixels_of(picture, style_of(Algorithm::neighborhood).stroke.ink) == 0);
    }
}

TEST_CASE("the sweep's picture shows each algorithm that was swept, and no point is no failure",
          "[plots]") {
    std::vector<SweepPoint> points;
    for (const double mu : {0.2, 0.4, 0.8}) {
        for (const double depth : {2.0, 3.0, 5.0, 8.0, 13.0, 21.0, 34.0, 55.0}) {
            SweepPoint point;
            point.path = "circle";
            point.mu = mu;
            point.depth_px = depth;
            point.run.algorithm = Algorithm::neighborhood;
            point.run.variation.mean_deg = 20.0 / depth;
            point.run.error = ExactError{.mean_rad = 0.1 / depth};
            points.push_back(point);
        }
    }
    const ColourImage picture = plot_sweep(points).finished();
    CHECK(pixels_of(picture, style_of(Algorithm::neighborhood).stroke.ink) > 200);
    CHECK(pixels_of(picture, style_of(Algorithm::god_object).stroke.ink) == 0);
    CHECK(plot_sweep({}).finished().columns == picture.columns);
}

TEST_CASE("the pictures are written into a folder that is made for them", "[plots]") {
    const test::TemporaryFolder own;
    const fs::path folder = own / "new" / "plots";
    PathRun human = circle_with_runs();
    human.name = "human";
    human.exact_proxies.clear();
    const ColourImage torso{2, 2, std::vector<std::uint8_t>(12, 90)};
    OutputFolder files(folder);
    write_plots({circle_with_runs(), human}, &torso, {files});
    write_sweep_plot({}, {files});
    files.commit();
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.insert(entry.path().filename().string());
        CHECK(entry.file_size() > 1000);
    }
    CHECK(names == std::set<std::string>{"paths-circle.png", "force-circle.png", "error-circle.png",
                                         "explained.png", "paths-human.png", "force-human.png",
                                         "sweep.png"});
}

TEST_CASE("a folder that cannot be made is said in one line", "[plots]") {
    const test::TemporaryFolder own;
    const fs::path file = own / "file";
    std::ofstream(file) << "in the way";
    try {
        OutputFolder files(file / "plots");
        FAIL("a folder inside a file was accepted");
    } catch (const InputError& error) {
        const std::string line = error.what();
        CHECK(line.find("plots") != std::string::npos);
        CHECK(line.find('\n') == std::string::npos);
    }
}
