// Where the drawn grid is cut at silhouettes, and what is drawn there.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "render/silhouette_cuts.hpp"
#include "render/silhouette_layers.hpp"
#include "tests/render/scenes.hpp"
#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

using Catch::Matchers::WithinAbs;

constexpr double kLimit = 12.0;

struct Cut {
    std::shared_ptr<const DepthImage> image{};
    ReliefGrid grid{};
    std::vector<float> elevations{};
    SilhouetteCuts cuts{};
    SilhouetteLayers layers{};

    Cut(int columns, int rows, int step, const std::function<double(int, int)>& elevation,
        std::shared_ptr<const ColourImage> colour = nullptr)
        : image(depth_image(columns, rows, elevation)), grid{columns, rows, step} {
        const BlendedDepth depth{*image, *image};
        drawn_elevations(depth, grid, elevations);
        find_cuts(depth, grid, elevations, kLimit, cuts);
        const glm::vec4 eye_at_the_left(-0.5F, 0.0F, 1.0F, 0.0F);
        Frame frame;
        frame.colour = std::move(colour);
        build_layers({depth, grid, elevations, cuts, &frame, eye_at_the_left}, layers);
    }
    [[nodiscard]] std::size_t cut_in_row(int j) const {
        const auto columns = static_cast<std::size_t>(grid.columns());
        const auto row = static_cast<std::size_t>(j);
        return static_cast<std::size_t>(
            std::count_if(cuts.cells.begin(), cuts.cells.end(),
                          [=](std::size_t cell) { return cell / columns == row; }));
    }
};

TEST_CASE("the drawn elevation blends both images at every drawn vertex") {
    const auto from = depth_image(8, 5, [](int i, int j) { return 10.0 * i + j; });
    const auto to = depth_image(8, 5, [](int i, int j) { return 100.0 - i * j; });
    const ReliefGrid grid{8, 5, 3};
    std::vector<float> elevations;
    drawn_elevations({*from, *to, 0.25, 2.0}, grid, elevations);
    REQUIRE(elevations.size() == 12);
    for (int j = 0; j < grid.rows(); ++j) {
        for (int i = 0; i < grid.columns(); ++i) {
            const int x = grid.image_i(i);
            const int y = grid.image_j(j);
            const double expected = 2.0 * (0.75 * (10.0 * x + y) + 0.25 * (100.0 - x * y));
            const auto k = static_cast<std::size_t>(j * grid.columns() + i);
            CHECK_THAT(static_cast<double>(elevations[k]), WithinAbs(expected, 1e-3));
        }
    }
}

TEST_CASE("a slope without a step behind it is whole, however steep, at any grid step") {
    const int step = GENERATE(1, 2, 3);
    const double slope = GENERATE(5.0, 13.0, 40.0, 150.0);
    const auto ramp = [slope](int i, int) { return slope * std::clamp(i - 12, 0, 8); };
    const auto dome = [slope](int i, int j) {
        const double off = std::hypot(i - 20.0, j - 15.0) / 8.0;
        return 3.0 * slope * std::exp(-off * off);
    };
    for (const std::function<double(int, int)>& shape :
         {std::function<double(int, int)>(ramp), std::function<double(int, int)>(dome)}) {
        const Cut whole(40, 30, step, shape);
        CHECK(whole.cuts.cells.empty());
        CHECK(whole.layers.front.indices.empty());
        CHECK(whole.layers.behind.indices.empty());
        CHECK(whole.layers.under.indices.empty());
    }
}

TEST_CASE("a fold is whole, and a step of more than twice the limit is cut") {
    const double height = GENERATE(6.0, 20.0, 23.0, 26.0, 200.0);
    const bool falls = GENERATE(false, true);
    const Cut cut(40, 30, 3, [=](int i, int) { return (i < 20) == falls ? height : 0.0; });
    CHECK(cut.cuts.cells.empty() == (height < 2.0 * kLimit));
}

TEST_CASE("a step over up to three pixels is cut, a wider one is a slope") {
    const int width = GENERATE(1, 2, 3, 4, 8);
    const Cut cut(40, 30, 1, [=](int i, int) { return 50.0 * std::clamp(i - 20, 0, width); });
    CHECK(cut.cuts.cells.empty() == (width > 3));
}

TEST_CASE("a picture of any size is cut all over or not at all") {
    const int side = GENERATE(64, 512, 2048);
    const int step = side / 32;
    // Boards with a gap of some pixels between them, from the first row to the last one.
    const Cut cut(side, side, step, [=](int i, int) { return i / step % 2 == 0 ? 150.0 : 0.0; });
    const std::size_t in_first = cut.cut_in_row(0);
    CHECK(in_first == static_cast<std::size_t>(cut.grid.columns() - 2));
    for (int j = 1; j + 1 < cut.grid.rows(); ++j) CHECK(cut.cut_in_row(j) == in_first);
}

TEST_CASE("at a step the front is at the near face and what is behind at the far one") {
    const int step = GENERATE(1, 3);
    const int blur = GENERATE(0, 1);  // pixels half way
    const Cut cut(61, 31, step,
                  [=](int i, int) { return i < 20 ? 20.0 : (i < 20 + blur ? 120.0 : 220.0); });
    REQUIRE_FALSE(cut.layers.front.indices.empty());
    for (const LayerVertex& vertex : cut.layers.front.vertices)
        CHECK_THAT(static_cast<double>(vertex.elevation_px), WithinAbs(220.0, 1e-3));
    int farthest = 0;
    for (const LayerVertex& vertex : cut.layers.behind.vertices) {
        CHECK_THAT(static_cast<double>(vertex.elevation_px), WithinAbs(20.0, 1e-3));
    }
    for (const LayerVertex& vertex : cut.layers.under.vertices) {
        if (vertex.elevation_px > 20.5F) continue;  // the end of the fill, at the near face
        CHECK_THAT(static_cast<double>(vertex.elevation_px), WithinAbs(20.0, 1e-3));
        farthest = std::max(farthest, cut.grid.image_i(vertex.corner.i));
    }
    CHECK(farthest >= 20 + blur + 20);  // seen at a slope of a half, 200 px down: all of the rest
}

TEST_CASE("what is seen through a gap over a lower face is continued under the higher one") {
    // A ray to the wall passes 14 px over the lower face at the left.
    constexpr int kGap = 60;
    constexpr int kHigher = 130;
    const Cut cut(200, 12, 1, [=](int i, int) {
        return i < kGap ? 150.0 : i < kHigher ? 20.0 : 220.0;
    });
    std::vector<bool> continued(200, false);
    for (const LayerVertex& vertex : cut.layers.under.vertices)
        if (vertex.corner.j == 6 && vertex.elevation_px < 20.5F) continued[vertex.corner.i] = true;
    for (int i = kHigher; i < kHigher + 40; ++i) {
        CAPTURE(i);
        CHECK(continued[static_cast<std::size_t>(i)]);
    }
}

TEST_CASE("where two faces go on under a near one, neither leans over to the other") {
    const int step = GENERATE(1, 3);
    const Cut cut(240, 90, step, [](int i, int j) {
        return i >= 90 ? 220.0 : j < 45 ? 20.0 : 120.0;
    });
    REQUIRE_FALSE(cut.layers.under.indices.empty());
    for (const LayerVertex& vertex : cut.layers.under.vertices) {
        const float z = vertex.elevation_px;
        CAPTURE(vertex.corner.i, vertex.corner.j, z);
        CHECK((std::abs(z - 20.0F) < 15.0F || std::abs(z - 120.0F) < 15.0F || z > 219.0F));
    }
}

TEST_CASE("where three faces meet, no triangle of the front stands between two of them") {
    const int step = GENERATE(1, 3);
    const Cut cut(240, 90, step, [](int i, int j) {
        return i >= 91 ? 220.0 : i + j < 100 ? 20.0 : 140.0;
    });
    REQUIRE_FALSE(cut.layers.front.indices.empty());
    for (std::size_t k = 0; k < cut.layers.front.indices.size(); k += 3) {
        const auto z = [&](std::size_t n) {
            return cut.layers.front.vertices[cut.layers.front.indices[k + n]].elevation_px;
        };
        CHECK(std::max({z(0), z(1), z(2)}) - std::min({z(0), z(1), z(2)}) < 70.0F);
    }
}

TEST_CASE("a face that falls to its outline ends evenly there") {
    constexpr double kEnd = 150.0;
    constexpr double kFall = 11.0;  // px/px
    const auto inside = [](double i, double j) { return i - (20.5 + 0.13 * j); };
    const Cut cut(90, 90, 3, [&](int i, int j) {
        const double d = inside(i, j);
        return d < 0.0 ? 20.0 : kEnd + kFall * d;
    });
    std::vector<double> ends;
    const auto& layer = cut.layers.front;
    for (std::size_t k = 0; k < layer.indices.size(); ++k) {
        const LayerVertex& a = layer.vertices[layer.indices[k]];
        const LayerVertex& b = layer.vertices[layer.indices[k - k % 3 + (k + 1) % 3]];
        const auto place = [&](const LayerVertex& v) {
            return inside(cut.grid.image_i(v.corner.i), cut.grid.image_j(v.corner.j));
        };
        if (!(place(a) > 0.0 && place(b) < 0.0) || a.corner.j < 3 || a.corner.j > 26) continue;
        const double share = place(a) / (place(a) - place(b));
        ends.push_back((1.0 - share) * a.elevation_px + share * b.elevation_px);
    }
    REQUIRE(ends.size() > 30);
    const auto count = static_cast<double>(ends.size());
    const double mean = std::accumulate(ends.begin(), ends.end(), 0.0) / count;
    CHECK_THAT(mean, WithinAbs(kEnd, kFall));
    double apart = 0.0;
    for (const double end : ends) apart += std::abs(end - mean) / count;
    CHECK(apart < 2.1);
}

// A disc before a wall: its edge is a ramp of some pixels, as scaled or estimated depth has.
class RampedDisc {
  public:
    static constexpr double kWall = 20.0;

    RampedDisc(int columns, int ramp)
        : unit_(std::max(1, (columns + 320) / 640)), columns_(columns), ramp_(ramp) {}

    [[nodiscard]] int unit() const { return unit_; }
    [[nodiscard]] double near_px() const { return kWall + 150.0 * unit_; }
    [[nodiscard]] double middle() const { return 0.3 * rows(); }  ///< of the ramp, from the centre
    [[nodiscard]] int rows() const { return columns_ / 2; }
    [[nodiscard]] double from_centre(double x, double y) const {
        return std::hypot(x - 0.5 * columns_, y - 0.5 * rows());
    }
    [[nodiscard]] double elevation(int x, int y) const {
        const double share = 0.5 + (middle() - from_centre(x, y)) / ramp_;
        return kWall + (near_px() - kWall) * std::clamp(share, 0.0, 1.0);
    }
    /// Skin before a dark wall; between them the colours are mixed.
    [[nodiscard]] Rgb colour(int x, int y) const {
        const double share =
            std::clamp(0.5 + (middle() - from_centre(x, y)) / (2.0 * unit_), 0.0, 1.0);
        return {static_cast<int>(40.0 + 200.0 * share), 40, 40};
    }

  private:
    int unit_;
    int columns_;
    int ramp_;
};

TEST_CASE("a disc is cut all around whatever the picture's size and however blurred its edge") {
    // Wider ramps are nearly slopes.
    const auto [columns, ramp] = GENERATE(table<int, int>({{640, 1},
                                                           {640, 2},
                                                           {1280, 1},
                                                           {1280, 3},
                                                           {1280, 5},
                                                           {1920, 1},
                                                           {1920, 3},
                                                           {1920, 5},
                                                           {1920, 8},
                                                           {3840, 1},
                                                           {3840, 8}}));
    const RampedDisc disc(columns, ramp);
    const int step = columns == 640 ? 3 : columns / 275;
    const auto colour =
        colour_image(columns, disc.rows(), [&](int x, int y) { return disc.colour(x, y); });
    const Cut cut(
        columns, disc.rows(), step, [&](int x, int y) { return disc.elevation(x, y); }, colour);
    CAPTURE(columns, ramp, step);

    // Every ray from the centre meets a cut cell where the ramp is highest.
    int uncut = 0;
    constexpr int kRays = 720;
    for (int ray = 0; ray < kRays; ++ray) {
        const double angle = ray * 2.0 * 3.14159265358979 / kRays;
        const int i = static_cast<int>(0.5 * columns + disc.middle() * std::cos(angle)) / step;
        const int j = static_cast<int>(0.5 * disc.rows() + disc.middle() * std::sin(angle)) / step;
        if (!(cut.cuts.cut[static_cast<std::size_t>(j * cut.grid.columns() + i)] > 0.0F)) ++uncut;
    }
    CHECK(uncut == 0);
    // What is cut lies within a cell of the ramp.
    int astray = 0;
    for (const std::size_t cell : cut.cuts.cells) {
        const double x = static_cast<double>(cell % static_cast<std::size_t>(cut.grid.columns()));
        const double y = static_cast<double>(cell / static_cast<std::size_t>(cut.grid.columns()));
        const double off = disc.from_centre((x + 0.5) * step, (y + 0.5) * step) - disc.middle();
        if (std::abs(off) > 0.5 * ramp + 1.5 * step) ++astray;
    }
    CHECK(astray == 0);
    // The layers are on their faces, and nothing is on the way from one to the other.
    const double blur = 0.15 * (disc.near_px() - RampedDisc::kWall);
    double off_near = 0.0;
    double off_far = 0.0;
    for (const LayerVertex& vertex : cut.layers.front.vertices)
        off_near = std::max(off_near, std::abs(vertex.elevation_px - disc.near_px()));
    int reddish = 0;
    for (const LayerVertex& vertex : cut.layers.behind.vertices) {
        off_far = std::max(off_far, std::abs(vertex.elevation_px - RampedDisc::kWall));
        if (vertex.fill[0] > 60) ++reddish;
    }
    for (const LayerVertex& vertex : cut.layers.under.vertices)
        if (vertex.fill[0] > 60) ++reddish;
    CHECK(off_near <= blur);
    CHECK(off_far <= blur);
    CHECK(reddish == 0);
    // The relief is whole up to a cell before the ramp, so the near layer ends at the outline.
    for (const LayerVertex& vertex : cut.layers.front.vertices) {
        CHECK(vertex.near_px - vertex.far_px >= 0.75 * (disc.near_px() - RampedDisc::kWall));
    }
}

TEST_CASE("a ball and a steep fold are whole at any size of the picture") {
    const int columns = GENERATE(640, 1920, 3840);
    const int rows = columns / 2;
    const int step = columns == 640 ? 3 : columns / 275;
    const double unit = columns / 640.0;
    const auto ball = [&](int x, int y) {
        const double r = 100.0 * unit;
        const double off = std::hypot(x - 0.5 * columns, y - 0.5 * rows);
        return std::sqrt(std::max(r * r - off * off, 0.0));
    };
    const auto fold = [&](int x, int) { return x < columns / 2 ? 0.0 : 20.0 * unit; };
    CHECK(Cut(columns, rows, step, ball).cuts.cells.empty());
    CHECK(Cut(columns, rows, step, fold).cuts.cells.empty());
}

TEST_CASE("beside a step the ring of a filter that overshoots is on no face") {
    const int unit = GENERATE(1, 3, 6);
    const int columns = 640 * unit;
    const auto ringed = [=](int x, int) {
        const int from_edge = x - columns / 2;
        if (from_edge < -2 * unit) return 500.0 * unit;
        if (from_edge < 0) return 515.0 * unit;
        return from_edge < 2 * unit ? 0.0 : 20.0 * unit;
    };
    const Cut cut(columns, 60 * unit, unit == 1 ? 3 : columns / 275, ringed);
    REQUIRE_FALSE(cut.cuts.cells.empty());
    for (const glm::vec2 ends_px : cut.cuts.ends_px) {
        CHECK_THAT(static_cast<double>(ends_px.x), WithinAbs(20.0 * unit, 10.0 * unit));
        CHECK_THAT(static_cast<double>(ends_px.y), WithinAbs(500.0 * unit, 10.0 * unit));
    }
    for (const LayerVertex& vertex : cut.layers.behind.vertices)
        CHECK(vertex.elevation_px < 60.0F * static_cast<float>(unit));
    for (const LayerVertex& vertex : cut.layers.front.vertices)
        CHECK(vertex.elevation_px > 450.0F * static_cast<float>(unit));
}

TEST_CASE("no uncut cell hangs between two faces, whatever corner an outline touches") {
    const int unit = GENERATE(1, 3, 6);
    const int columns = 640 * unit;
    const int rows = 80 * unit;
    const int step = unit == 1 ? 3 : columns / 275;
    // Boards whose corners are at every place in a cell.
    const auto boards = [=](int x, int y) {
        const int pitch = 8 * step + 1;
        return x % pitch < pitch / 2 && y % pitch < pitch / 2 ? 200.0 * unit : 0.0;
    };
    const Cut cut(columns, rows, step, boards);
    int hanging = 0;
    for (int j = 0; j + 1 < cut.grid.rows(); ++j) {
        for (int i = 0; i + 1 < cut.grid.columns(); ++i) {
            const auto at = [&](int x, int y) {
                return cut.elevations[static_cast<std::size_t>(y * cut.grid.columns() + x)];
            };
            const auto [low, high] =
                std::minmax({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
            const auto cell = static_cast<std::size_t>(j * cut.grid.columns() + i);
            if (high > low && !(cut.cuts.cut[cell] > 0.0F)) ++hanging;
        }
    }
    CHECK(hanging == 0);
}

TEST_CASE("between two images their blend is cut") {
    const int step = GENERATE(1, 5);
    const double blend = GENERATE(0.0, 0.3, 1.0);
    const auto flat = depth_image(33, 33, [](int, int) { return 20.0; });
    const auto stepped = depth_image(33, 33, [](int i, int) { return i < 17 ? 20.0 : 60.0; });
    const ReliefGrid grid{33, 33, step};
    const BlendedDepth depth{*flat, *stepped, blend};
    std::vector<float> elevations;
    SilhouetteCuts cuts;
    drawn_elevations(depth, grid, elevations);
    find_cuts(depth, grid, elevations, kLimit, cuts);
    CHECK(cuts.cells.empty() == (40.0 * blend <= 2.0 * kLimit));
}

}  // namespace
}  // namespace dibhr
