// Motion of pixels from a frame to the next, against scenes whose motion is known.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/video/frames/object_pool.hpp"
#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_estimator.hpp"
#include "core/video/motion/motion_plain.hpp"
#include "core/video/motion/motion_spread.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/core/video/moving_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using test::MovingScene;
using Shape = MovingScene::Shape;
using Goes = MovingScene::Goes;

namespace {

MovingScene scene_of(Shape shape, Goes goes, double speed_px_per_s) {
    return MovingScene({shape, goes, speed_px_per_s, 320, 240});
}

/// For pixels well within one object that stay in the picture: errors [px], in rising order, and
/// their mean along the true way.
struct Errors {
    std::vector<double> px{};
    double along_px{0.0};

    [[nodiscard]] double quantile(double share) const {
        return px[static_cast<std::size_t>(share * static_cast<double>(px.size() - 1))];
    }
};

Errors errors_of(const MovingScene& scene, const MotionField& field, double from_s, double to_s,
                 int object) {
    constexpr double kBeside_px = 6.0;
    Errors errors;
    const auto& what = scene.what();
    for (int j = 0; j < what.rows; j += 2)
        for (int i = 0; i < what.columns; i += 2) {
            const MovingScene::Point here{static_cast<double>(i), static_cast<double>(j)};
            bool is_within = true;
            for (const double x : {-kBeside_px, 0.0, kBeside_px})
                for (const double y : {-kBeside_px, 0.0, kBeside_px})
                    is_within = is_within && scene.at(from_s, {i + x, j + y}).object == object;
            const MovingScene::Point there = scene.gone(from_s, here, to_s);
            const bool is_inside = there.x > 4.0 && there.y > 4.0 && there.x < what.columns - 5 &&
                                   there.y < what.rows - 5;
            if (!is_within || !is_inside) continue;
            const double x = field.at(i, j).right - (there.x - here.x);
            const double y = field.at(i, j).down - (there.y - here.y);
            errors.px.push_back(std::hypot(x, y));
            const double far = std::hypot(there.x - here.x, there.y - here.y);
            if (far > 0.0)
                errors.along_px += (x * (there.x - here.x) + y * (there.y - here.y)) / far;
        }
    errors.along_px /= static_cast<double>(std::max<std::size_t>(errors.px.size(), 1));
    std::sort(errors.px.begin(), errors.px.end());
    return errors;
}

MotionField motion_of(const Frame& from, const Frame& to) {
    MotionEstimator estimator;
    const auto field = estimator.estimate(from, to);
    if (field) return *field;
    return {from.depth->columns, from.depth->rows,
            std::vector<MotionField::Way>(from.depth->levels.size())};
}

}  // namespace

TEST_CASE("nothing moves in a still scene, whatever the camera's noise", "[motion]") {
    const Shape shape = GENERATE(some_of<Shape>({Shape::hand, Shape::plane, Shape::sphere}, 1));
    const double noise = GENERATE(0.0, 1.0, 4.0);
    const std::vector<Frame> frames =
        test::film(scene_of(shape, Goes::along, 0.0), 2, 30.0, {.brightness = noise}, false);
    CAPTURE(noise);
    CHECK(MotionEstimator().estimate(frames[0], frames[1]) == nullptr);
}

TEST_CASE("nothing moves in a still scene that a video codec has coded", "[motion]") {
    const Shape shape = GENERATE(some_of<Shape>({Shape::hand, Shape::plane}, 1));
    const std::vector<Frame> frames =
        test::film(scene_of(shape, Goes::along, 0.0), 7, 30.0, {.brightness = 3.0}, true);
    MotionEstimator estimator;
    for (std::size_t k = 1; k < frames.size(); ++k)
        CHECK(estimator.estimate(frames[k - 1], frames[k]) == nullptr);
}

TEST_CASE("depth alone that does not move gives no motion", "[motion]") {
    const MovingScene scene = scene_of(Shape::hand, Goes::along, 0.0);
    Frame from = scene.frame(0.0, {.elevation_px = 0.5, .seed = 1});
    Frame to = scene.frame(0.0, {.elevation_px = 0.5, .seed = 2});
    from.colour_of_view = to.colour_of_view = false;
    CHECK(MotionEstimator().estimate(from, to) == nullptr);
}

TEST_CASE("a textured plane's pixels are found where they have gone", "[motion]") {
    const double speed = GENERATE(20.0, 100.0, 400.0);
    const double rate = GENERATE(30.0, 60.0);
    CAPTURE(speed, rate);
    const MovingScene scene = scene_of(Shape::plane, Goes::along, speed);
    const std::vector<Frame> frames = test::film(scene, 2, rate, {.brightness = 1.0}, false);
    const Errors errors = errors_of(scene, motion_of(frames[0], frames[1]), 0.0, 1.0 / rate, 1);
    CHECK(errors.quantile(0.5) < 0.08);
    CHECK(std::fabs(errors.along_px) < 0.04);
}

TEST_CASE("a thing moves before a wall that stays", "[motion]") {
    const Shape shape = GENERATE(some_of<Shape>({Shape::hand, Shape::sphere}, 1));
    const Goes goes = GENERATE(some_of<Goes>({Goes::round, Goes::along, Goes::apart}, 1));
    const double speed = GENERATE(60.0, 200.0);
    CAPTURE(static_cast<int>(shape), static_cast<int>(goes), speed);
    const MovingScene scene = scene_of(shape, goes, speed);
    const std::vector<Frame> frames = test::film(scene, 2, 30.0, {.brightness = 2.0}, false);
    const MotionField field = motion_of(frames[0], frames[1]);
    const Errors thing = errors_of(scene, field, 0.0, 1.0 / 30.0, 1);
    const Errors wall = errors_of(scene, field, 0.0, 1.0 / 30.0, 0);
    CHECK(thing.quantile(0.5) < 0.3);
    CHECK(thing.quantile(0.9) < 0.9);
    CHECK(std::fabs(thing.along_px) < 0.15);
    CHECK(wall.quantile(0.9) < 0.1);
}

TEST_CASE("a thing without texture goes as its outline does, in its middle, too", "[motion]") {
    using Look = MovingScene::Look;
    const Look look = GENERATE(Look::plain, Look::shaded);
    const double diameter_px = GENERATE(30.0, 60.0, 120.0);
    const double speed = GENERATE(60.0, 150.0);
    const double depth_noise_px = GENERATE(some_of<double>({0.0, 3.0}, 1));
    CAPTURE(static_cast<int>(look), diameter_px, speed, depth_noise_px);
    const MovingScene scene({.shape = Shape::disc,
                             .speed_px_per_s = speed,
                             .columns = 320,
                             .rows = 240,
                             .look = look,
                             .diameter_px = diameter_px});
    const std::vector<Frame> frames =
        test::film(scene, 2, 30.0, {.brightness = 2.0, .elevation_px = depth_noise_px}, false);
    const MotionField field = motion_of(frames[0], frames[1]);
    const Errors thing = errors_of(scene, field, 0.0, 1.0 / 30.0, 1);
    const Errors wall = errors_of(scene, field, 0.0, 1.0 / 30.0, 0);
    CHECK(thing.quantile(0.5) < 0.2);
    CHECK(thing.quantile(1.0) < 0.5);
    CHECK(wall.quantile(0.9) < 0.1);
}

TEST_CASE("an exposure that changes is no motion, and hides none", "[motion]") {
    const Shape shape = GENERATE(some_of<Shape>({Shape::hand, Shape::plane}, 1));
    const double speed = GENERATE(0.0, 100.0);
    CAPTURE(static_cast<int>(shape), speed);
    const MovingScene scene = scene_of(shape, Goes::along, speed);
    const std::vector<Frame> frames =
        test::film(scene, 2, 30.0, {.brightness = 2.0, .exposure = 0.25}, false);
    const Errors thing = errors_of(scene, motion_of(frames[0], frames[1]), 0.0, 1.0 / 30.0, 1);
    CHECK(thing.quantile(0.5) < 0.2);
    CHECK(thing.quantile(0.9) < (speed > 0.0 ? 0.5 : 1e-6));
}

TEST_CASE("plain parts take the ways of outlines of their own surface, none across a cliff",
          "[motion]") {
    constexpr int kColumns = 20;
    constexpr int kRows = 12;
    constexpr int kCliff = 13;  // the column from which on it is far
    constexpr MotionField::Way kWay{3.0F, -2.0F};
    MotionCells cells{.columns = kColumns, .rows = kRows};
    cells.threshold.resize(kColumns, kRows);
    cells.lowest.resize(kColumns, kRows);
    cells.highest.resize(kColumns, kRows);
    cells.highest.fill(MotionCells::kNoPart);
    MotionSums structure, sums;
    MotionLayers changed;
    MotionWays ways;
    for (MotionSums* each : {&structure, &sums}) {
        each->resize(kColumns, kRows);
        each->fill(0.0F);
    }
    changed.resize(kColumns, kRows);
    changed.fill(1.0F);
    ways.resize(kColumns, kRows);
    ways.fill(0.0F);
    structure[MotionSum::n].fill(100.0F);
    sums[MotionSum::n].fill(64.0F);
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i) {
            const bool near = i < kCliff;
            cells.lowest.of[0].row(j)[i] = cells.highest.of[0].row(j)[i] = near ? 200.0F : 100.0F;
            // Each side of the near surface knows one direction.
            const bool upright = i == 0;
            const bool level = j == 0 && near;
            const float slope = 64.0F * 100.0F;
            if (upright) {
                sums[MotionSum::xx].of[0].row(j)[i] = slope;
                sums[MotionSum::xr].of[0].row(j)[i] = -slope * kWay.right;
            } else if (level) {
                sums[MotionSum::yy].of[0].row(j)[i] = slope;
                sums[MotionSum::yr].of[0].row(j)[i] = -slope * kWay.down;
            }
        }
    PlainParts plain;
    plain.find(cells, changed, structure, 8);
    REQUIRE(plain.parts().size() == kColumns * kRows);
    CHECK(plain.groups() == 2);
    plain.settle(sums, changed, changed, ways, 1.0F);
    plain.take(100.0F, 100.0F, ways);
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i) {
            const MotionField::Way there = i < kCliff ? kWay : MotionField::Way{};
            REQUIRE_THAT(ways.right.of[0].row(j)[i], WithinAbs(there.right, 0.05));
            REQUIRE_THAT(ways.down.of[0].row(j)[i], WithinAbs(there.down, 0.05));
        }
}

TEST_CASE("the colour of a video is as good a guide", "[motion]") {
    const MovingScene scene = scene_of(Shape::hand, Goes::along, 200.0);
    const std::vector<Frame> frames = test::film(scene, 3, 30.0, {.brightness = 2.0}, true);
    const Errors errors =
        errors_of(scene, motion_of(frames[1], frames[2]), 1.0 / 30.0, 2.0 / 30.0, 1);
    CHECK(errors.quantile(0.5) < 0.25);
    CHECK(errors.quantile(0.9) < 0.6);
}

TEST_CASE("no way is longer than a sixteenth of the width to each side", "[motion]") {
    const Frame from = scene_of(Shape::plane, Goes::along, 0.0).frame(0.0, {.brightness = 40.0});
    const Frame to = scene_of(Shape::hand, Goes::along, 0.0).frame(0.0, {.brightness = 40.0});
    const MotionField field = motion_of(from, to);
    const double most = kFarthestMotion * from.depth->columns + 1e-3;
    for (const MotionField::Way& way : field.ways) {
        REQUIRE(std::fabs(way.right) <= most);
        REQUIRE(std::fabs(way.down) <= most);
    }
}

TEST_CASE("the same two frames give the same bits, whatever was asked before", "[motion]") {
    const MovingScene scene = scene_of(Shape::hand, Goes::along, 150.0);
    const std::vector<Frame> frames = test::film(scene, 3, 30.0, {.brightness = 2.0}, false);
    MotionEstimator busy;
    static_cast<void>(busy.estimate(frames[0], frames[1]));
    const auto again = busy.estimate(frames[1], frames[2]);
    const auto afresh = MotionEstimator().estimate(frames[1], frames[2]);
    REQUIRE(again);
    REQUIRE(afresh);
    CHECK(again->ways == afresh->ways);
}

TEST_CASE(
    "smoothing leaves ways that turn and grow as they are, near and far, and nearly so at borders",
    "[motion]") {
    test::Dice dice(3);
    MotionCells cells;
    cells.columns = 21;
    cells.rows = 13;
    cells.threshold.resize(cells.columns, cells.rows);
    cells.lowest.resize(cells.columns, cells.rows);
    cells.highest.resize(cells.columns, cells.rows);
    MotionLayers wanted;
    wanted.resize(cells.columns, cells.rows);
    wanted.fill(1.0F);
    // A near surface to the left, a wall to the right; the cells between have both.
    for (int j = 0; j < cells.rows; ++j)
        for (int i = 0; i < cells.columns; ++i) {
            const bool both = i == 9 + j / 5;
            const float depth = i <= 9 + j / 5 ? 200.0F : 20.0F;
            cells.lowest.of[0].row(j)[i] = cells.highest.of[0].row(j)[i] = depth;
            cells.lowest.of[1].row(j)[i] = both ? 20.0F : -MotionCells::kNoPart;
            cells.highest.of[1].row(j)[i] = both ? 20.0F : MotionCells::kNoPart;
            if (both)
                cells.split.push_back(static_cast<std::uint32_t>(cells.threshold.index(i, j)));
            // Some parts have no known way.
            if (dice.uniform(0.0, 1.0) < 0.15) wanted.of[0].row(j)[i] = 0.0F;
        }
    const auto even = [](float x, float y, bool near) {
        return near ? MotionField::Way{3.0F - 0.9F * y + 0.2F * x, 0.9F * x - 5.0F}
                    : MotionField::Way{0.1F * x - 7.0F, 0.4F * y};
    };
    MotionWays ways, smooth;
    ways.resize(cells.columns, cells.rows);
    const auto each = [&](auto visit) {
        for (std::size_t part = 0; part < 2; ++part)
            for (int j = 0; j < cells.rows; ++j)
                for (int i = 0; i < cells.columns; ++i)
                    if (cells.has(part, i, j) && wanted.of[part].row(j)[i] > 0.0F)
                        visit(part, i, j,
                              even(static_cast<float>(i), static_cast<float>(j),
                                   cells.lowest.of[part].row(j)[i] > 100.0F));
    };
    ways.fill(40.0F);  // where nothing is known anything may stand
    each([&](std::size_t part, int i, int j, MotionField::Way way) {
        ways.right.of[part].row(j)[i] = way.right;
        ways.down.of[part].row(j)[i] = way.down;
    });
    SimilarParts similar;
    similar.find(cells);
    similar.smooth(wanted, ways, smooth);
    std::vector<float> off;  // what changes by 0.9 from cell to cell
    each([&](std::size_t part, int i, int j, MotionField::Way way) {
        off.push_back(std::fabs(smooth.right.of[part].row(j)[i] - way.right));
        off.push_back(std::fabs(smooth.down.of[part].row(j)[i] - way.down));
    });
    std::sort(off.begin(), off.end());
    CHECK(off[off.size() / 2] < 0.03F);
    CHECK(off.back() < 0.4F);
}

TEST_CASE("between the middles of cells ways change evenly, to the middle of each pixel",
          "[motion]") {
    constexpr int kCells = 4;
    constexpr int kSide = kCells * kMotionCell_px;
    MotionCells cells{.columns = kCells, .rows = kCells};
    MotionWays ways;
    for (MotionLayers* layers : {&cells.lowest, &cells.highest, &ways.right, &ways.down})
        layers->resize(kCells, kCells);
    cells.lowest.fill(100.0F);
    cells.highest.fill(100.0F);
    std::fill_n(cells.highest.of[1].values.begin(), kCells * kCells, MotionCells::kNoPart);
    for (int j = 0; j < kCells; ++j) {
        for (int i = 0; i < kCells; ++i) {
            ways.right.of[0].row(j)[i] = static_cast<float>(i);
            ways.down.of[0].row(j)[i] = static_cast<float>(j);
        }
    }
    const DepthImage depth{kSide, kSide, 255.0, std::vector<float>(kSide * kSide, 100.0F)};
    ObjectPool<MotionField> fields;
    const auto field = spread_motion(depth, cells, 1, ways, fields);
    REQUIRE(field);
    for (int j = kMotionCell_px / 2; j < kSide - kMotionCell_px / 2; ++j) {
        for (int i = kMotionCell_px / 2; i < kSide - kMotionCell_px / 2; ++i) {
            const MotionField::Way way = field->ways[depth.index(i, j)];
            REQUIRE_THAT(way.right, WithinAbs((i + 0.5) / kMotionCell_px - 0.5, 0.01));
            REQUIRE_THAT(way.down, WithinAbs((j + 0.5) / kMotionCell_px - 0.5, 0.01));
        }
    }
}
