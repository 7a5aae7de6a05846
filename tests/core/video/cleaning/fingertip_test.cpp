// A ball that touches a height field: where it rests, and where it touches.
#include "core/video/cleaning/fingertip.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/haptics/surface.hpp"
#include "core/video/cleaning/cleaning_chain.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kExact_px = 0.02;
constexpr double kRounding_px = 2e-3;
constexpr double kRelief_px = 255.0;  // so a level of 255 is a pixel

DepthImage dilated(const DepthImage& image, double radius_px, double relief_px = kRelief_px) {
    return FingertipDilation().dilated(image, {radius_px, relief_px});
}

/// Levels that differ from pixel to pixel by about `deviation`, on a slope.
DepthImage rough(int columns, int rows, double highest_level, double deviation, double slope,
                 unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, deviation);
    return image_of(columns, rows, highest_level, [&](int i, int j) {
        const double level = 100.0 + slope * (i - 0.4 * j) + noise(random);
        return std::clamp(level, 0.0, 255.0) * highest_level / 255.0;
    });
}

/// Plateaus of all heights.
DepthImage stepped(int columns, int rows) {
    return image_of(columns, rows, 255.0, [](int i, int j) {
        return 50.0 * ((i / 7 + 2 * (j / 5) + (2 * i + j) / 11) % 5);
    });
}

/// Teeth of one pixel at every `pitch`th row, column or diagonal, of two heights by turns.
DepthImage comb(int pitch, int direction, double height, double lower) {
    return image_of(34, 30, 255.0, [=](int i, int j) {
        const int across = direction == 0 ? i : direction == 1 ? j : i + j;
        if (across % pitch != 0) return 20.0 + 0.3 * i;
        return 20.0 + (across / pitch % 2 == 0 ? height : lower) + 0.2 * j;
    });
}

/// A cliff, a needle or a pit of some height at every pixel.
DepthImage scattered(unsigned seed, unsigned one_of) {
    std::mt19937 random(seed);
    DepthImage image = stepped(32, 26);
    for (float& level : image.levels)
        if (random() % one_of == 0) level = static_cast<float>(random() % 256);
    return image;
}

/// Where a ball rests, from the definition, in double precision.
class Rest {
  public:
    Rest(const DepthImage& image, const Fingertip& finger)
        : surface_(image, image, 0.0, {finger.relief_px, 0.0}), radius_(finger.radius_px) {}

    /// Over the points of every TRIANGLE, `fine` to an EDGE: a little too low.
    [[nodiscard]] double on_samples(int x, int y, int fine) const {
        double highest = -1e9;
        each_facet(x, y, [&](int i, int j, int sign) {
            for (int a = 0; a <= fine; ++a)
                for (int b = 0; a + b <= fine; ++b) {
                    const double u = 1.0 * a / fine;
                    const double v = 1.0 * b / fine;
                    const double z =
                        (1.0 - u - v) * z_at(i, j) + u * z_at(i + sign, j) + v * z_at(i, j + sign);
                    const double away = std::hypot(i + sign * u - x, j + sign * v - y);
                    if (away <= radius_) highest = std::max(highest, z + cap(away));
                }
        });
        return highest;
    }

    /// The same in closed form: on a plane and on a line the ball touches in one point.
    [[nodiscard]] double exactly(int x, int y) const {
        double highest = -1e9;
        each_facet(x, y, [&](int i, int j, int sign) {
            const double z = z_at(i, j);
            const double slope_x = sign * (z_at(i + sign, j) - z);
            const double slope_y = sign * (z_at(i, j + sign) - z);
            const double slant = std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
            const double u = sign * (x - i + radius_ * slope_x / slant);
            const double v = sign * (y - j + radius_ * slope_y / slant);
            if (u >= 0.0 && v >= 0.0 && u + v <= 1.0)
                highest = std::max(
                    highest, z + slope_x * (x - i) + slope_y * (y - j) + radius_ * slant - radius_);
            const glm::dvec2 at(x, y);
            highest = std::max(highest, on_edge({i, j}, {i + sign, j}, at));
            highest = std::max(highest, on_edge({i, j}, {i, j + sign}, at));
            highest = std::max(highest, on_edge({i + sign, j}, {i, j + sign}, at));
        });
        return highest;
    }

  private:
    [[nodiscard]] double z_at(int i, int j) const { return surface_.elevation(i, j); }
    [[nodiscard]] double cap(double away) const {
        return std::sqrt(std::max(0.0, radius_ * radius_ - away * away)) - radius_;
    }

    [[nodiscard]] double on_edge(glm::ivec2 a, glm::ivec2 b, glm::dvec2 at) const {
        const double length = glm::length(glm::dvec2(b - a));
        const glm::dvec2 along = glm::dvec2(b - a) / length;
        const double foot = glm::dot(at - glm::dvec2(a), along);
        const double beside = glm::length(at - glm::dvec2(a) - foot * along);
        if (beside > radius_) return -1e9;
        const double reach = std::sqrt(radius_ * radius_ - beside * beside);
        const double slope = (z_at(b.x, b.y) - z_at(a.x, a.y)) / length;
        const double touched = foot + reach * slope / std::sqrt(1.0 + slope * slope);
        const double held = std::clamp(touched, 0.0, length);
        if (std::abs(held - foot) > reach) return -1e9;
        return z_at(a.x, a.y) + slope * held + cap(std::hypot(held - foot, beside));
    }

    /// The TRIANGLEs that the ball may reach: corner, and 1 or -1 for the side.
    template <typename Visit>
    void each_facet(int x, int y, Visit&& visit) const {
        const int reach = static_cast<int>(radius_) + 2;
        for (int j = std::max(0, y - reach); j < std::min(surface_.rows(), y + reach + 1); ++j)
            for (int i = std::max(0, x - reach); i < std::min(surface_.columns(), x + reach + 1);
                 ++i)
                for (const int sign : {1, -1})
                    if (surface_.has_vertex(i + sign, j) && surface_.has_vertex(i, j + sign))
                        visit(i, j, sign);
    }

    DepthSurface surface_;
    double radius_;
};

/// Largest difference from the exact resting level [px], over each `step`th pixel of a row, with
/// another first pixel in the next row.
double worst_error(const DepthImage& image, const Fingertip& finger, int step = 3) {
    const DepthImage result = FingertipDilation().dilated(image, finger);
    const Rest rest(image, finger);
    double worst = 0.0;
    for (int j = 0; j < image.rows; ++j)
        for (int i = j % step; i < image.columns; i += step) {
            const double z = result.at(i, j) * finger.relief_px / image.highest_level;
            worst = std::max(worst, std::abs(z - rest.exactly(i, j)));
        }
    return worst;
}

/// Where a ball rests `away` pixels from the last one of a plateau, behind which the surface falls
/// from `high` to `low` over one pixel.
double rest_beside_wall(double away, double high, double low, double radius_px) {
    const double fall = high - low;
    const double touched =
        std::clamp(away - radius_px * fall / std::sqrt(1.0 + fall * fall), 0.0, 1.0);
    const double over2 = radius_px * radius_px - (away - touched) * (away - touched);
    if (over2 < 0.0) return low;
    return std::max(low, high - fall * touched + std::sqrt(over2) - radius_px);
}

double largest_difference(const DepthImage& a, const DepthImage& b) {
    REQUIRE(a.levels.size() == b.levels.size());
    double largest = 0.0;
    for (std::size_t k = 0; k < a.levels.size(); ++k)
        largest = std::max(largest, std::abs(double{a.levels[k]} - b.levels[k]));
    return largest;
}

/// How much the lowest of all differences a - b is below 0.
double least_lead(const DepthImage& a, const DepthImage& b) {
    double least = 1e9;
    for (std::size_t k = 0; k < a.levels.size(); ++k)
        least = std::min(least, double{a.levels[k]} - b.levels[k]);
    return least;
}

/// Distance from the ball's centre to contact_point; `proxy` is at a pixel of the dilated image.
double distance_to_contact(const DepthImage& image, const DepthImage& felt, double radius_px, int i,
                           int j) {
    const DepthSurface original(image, image, 0.0, {kRelief_px, 0.0});
    const DepthSurface surface(felt, felt, 0.0, {kRelief_px, 0.0});
    const Vec3 proxy{i, j, surface.elevation(i, j)};
    const Vec3 point = contact_point(original, {radius_px, kRelief_px}, proxy);
    REQUIRE_THAT(point.z, WithinAbs(original.elevation_at(point.x, point.y), 1e-6));
    return glm::length(point - proxy - Vec3{0.0, 0.0, radius_px});
}

}  // namespace

TEST_CASE("a finger without a width feels the image's own bits", "[fingertip]") {
    const DepthImage image = rough(30, 20, 65535.0, 20.0, 0.5);
    const double radius_px = GENERATE(0.0, -1.0, std::numeric_limits<double>::quiet_NaN());
    CHECK(dilated(image, radius_px).levels == image.levels);
}

TEST_CASE("without a relief there is nothing to dilate", "[fingertip]") {
    const DepthImage image = rough(30, 20, 255.0, 20.0, 0.5);
    CHECK(dilated(image, 5.0, 0.0).levels == image.levels);
}

TEST_CASE("a level surface stays as it is, to the bit", "[fingertip]") {
    const double radius_px = GENERATE(0.3, 1.0, 7.7, 40.0);
    const double level = GENERATE(0.0, 1.0 / 3.0, 254.9, 255.0);
    CAPTURE(radius_px, level);
    const DepthImage image = image_of(60, 40, 255.0, [&](int, int) { return level; });
    CHECK(dilated(image, radius_px).levels == image.levels);
}

TEST_CASE("no level falls, and none rises above the image's highest", "[fingertip]") {
    const double radius_px = GENERATE(0.3, 1.0, 3.0, 10.0, 40.0);
    const double deviation = GENERATE(0.1, 2.0, 60.0);
    const double highest_level = GENERATE(255.0, 65535.0);
    CAPTURE(radius_px, deviation, highest_level);
    const DepthImage image = rough(70, 50, highest_level, deviation, 1.0);
    const DepthImage felt = dilated(image, radius_px);
    CHECK(felt.columns == image.columns);
    CHECK(felt.rows == image.rows);
    CHECK(felt.highest_level == highest_level);
    CHECK(least_lead(felt, image) >= 0.0);
    CHECK(*std::max_element(felt.levels.begin(), felt.levels.end()) ==
          *std::max_element(image.levels.begin(), image.levels.end()));
}

TEST_CASE("a wider finger is nowhere lower", "[fingertip]") {
    const double deviation = GENERATE(0.3, 5.0, 60.0);
    const DepthImage image = rough(70, 50, 255.0, deviation, 1.0);
    DepthImage narrower = image;
    for (const double radius_px : {0.5, 1.0, 2.3, 5.0, 6.5, 11.0, 30.0}) {
        CAPTURE(deviation, radius_px);
        const DepthImage felt = dilated(image, radius_px);
        CHECK(least_lead(felt, narrower) >= -kRounding_px);
        narrower = felt;
    }
}

TEST_CASE("what is added to a surface lowers it nowhere", "[fingertip]") {
    const DepthImage image = rough(70, 50, 255.0, 3.0, 0.5);
    DepthImage higher = image;
    std::mt19937 random(7);
    for (float& level : higher.levels)
        if (random() % 5 == 0) level = std::min(255.0F, level + static_cast<float>(random() % 40));
    CHECK(least_lead(dilated(higher, 8.0), dilated(image, 8.0)) >= -kRounding_px);
}

TEST_CASE("it matters neither where a shape is, nor how it is turned", "[fingertip]") {
    const double radius_px = GENERATE(2.5, 9.0);
    const DepthImage shape = rough(24, 18, 255.0, 15.0, 0.0);
    const auto placed = [&shape](int column, int row) {
        return image_of(80, 70, 255.0, [&](int i, int j) {
            const int x = i - column, y = j - row;
            const bool inside = x >= 0 && y >= 0 && x < shape.columns && y < shape.rows;
            return inside ? double{shape.at(x, y)} : 40.0;
        });
    };
    const DepthImage image = placed(20, 20);
    const DepthImage felt = dilated(image, radius_px);
    SECTION("moved by whole pixels") {
        const DepthImage moved = dilated(placed(27, 23), radius_px);
        double largest = 0.0;
        for (int j = 0; j < 60; ++j)
            for (int i = 0; i < 70; ++i)
                largest =
                    std::max(largest, std::abs(double{moved.at(i + 7, j + 3)} - felt.at(i, j)));
        CHECK(largest < kRounding_px);
    }
    SECTION("turned by half a turn, which leaves the diagonals as they are") {
        DepthImage turned = image;
        std::reverse(turned.levels.begin(), turned.levels.end());
        DepthImage back = dilated(turned, radius_px);
        std::reverse(back.levels.begin(), back.levels.end());
        CHECK(largest_difference(back, felt) < kRounding_px);
    }
    SECTION("rows for columns") {
        const auto transposed = [](const DepthImage& of) {
            return image_of(of.rows, of.columns, of.highest_level,
                            [&of](int i, int j) { return of.at(j, i); });
        };
        CHECK(largest_difference(transposed(dilated(transposed(image), radius_px)), felt) <
              kRounding_px);
    }
}

TEST_CASE("the same image gives the same bits, whatever came before", "[fingertip]") {
    const DepthImage image = rough(50, 40, 65535.0, 10.0, 0.5);
    const DepthImage felt = dilated(image, 7.5);
    FingertipDilation used;
    CHECK(used.dilated(rough(90, 20, 255.0, 60.0, 0.0), {30.0, 90.0}).columns == 90);
    CHECK(used.dilated(stepped(20, 70), {0.7, 255.0}).columns == 20);
    CHECK(used.dilated(image, {7.5, kRelief_px}).levels == felt.levels);
    CHECK(used.dilated(image, {7.5, kRelief_px}).levels == felt.levels);
}

namespace {

/// Noise, cliffs, needles and holes, and slopes.
DepthImage surface_of(unsigned kind, int columns, int rows, unsigned seed) {
    if (kind == 0) return rough(columns, rows, 255.0, 2.0, 0.1, seed);
    if (kind == 1) return rough(columns, rows, 65535.0, 40.0, 0.0, seed);
    DepthImage image = stepped(columns, rows);
    std::mt19937 random(seed);
    if (kind == 2)
        for (float& level : image.levels)
            if (random() % 40 == 0) level = static_cast<float>(random() % 256);
    if (kind == 3)
        for (float& level : image.levels)
            if (random() % 9 == 0) level = 0.0F;
    return image;
}

/// The middle of an image, from as many pixels to each side.
DepthImage without_rim(const DepthImage& image, int left, int top, int right, int bottom) {
    return image_of(image.columns - left - right, image.rows - top - bottom, image.highest_level,
                    [&](int i, int j) { return double{image.at(i + left, j + top)}; });
}

/// Other levels in a random part, of one pixel or more.
void change_some(DepthImage& image, std::mt19937& random) {
    const auto below = [&random](int most) {
        return static_cast<int>(random() % static_cast<unsigned>(most));
    };
    const int left = below(image.columns);
    const int top = below(image.rows);
    const int right = left + 1 + below(image.columns - left);
    const int bottom = top + 1 + below(image.rows - top);
    const double most = image.highest_level / 255.0;
    for (int j = top; j < bottom; ++j)
        for (int i = left; i < right; ++i)
            if (below(3) == 0) image.at(i, j) = static_cast<float>(most * below(256));
}

}  // namespace

TEST_CASE("a part of an image feels as it does in the whole, to the bit", "[fingertip]") {
    const unsigned kind = GENERATE(0U, 1U, 2U, 3U);
    const double radius_px = GENERATE(some_of<double>({2.0, 7.7, 20.0, 33.3}, 1));
    CAPTURE(kind, radius_px);
    const DepthImage image = surface_of(kind, 720, 440, kind);
    const DepthImage felt = dilated(image, radius_px);
    const int rim = 2 * static_cast<int>(radius_px) + 3;
    for (const int top : {0, 110, 220}) {
        const DepthImage part = without_rim(image, 400, top, 60, 220 - top);
        const int above = top == 0 ? 0 : rim;
        CHECK(without_rim(dilated(part, radius_px), rim, above, rim, rim).levels ==
              without_rim(felt, 400 + rim, top + above, 60 + rim, 220 - top + rim).levels);
    }
}

TEST_CASE("frame after frame feels as it does alone, to the bit", "[fingertip]") {
    const unsigned kind = GENERATE(0U, 1U, 2U, 3U);
    const double radius_px = GENERATE(0.5, 5.0, 17.0, 70.0);
    CAPTURE(kind, radius_px);
    std::mt19937 random(kind);
    DepthImage image = surface_of(kind, 90, 70, kind);
    FingertipDilation used;
    for (int frame = 0; frame < 12; ++frame) {
        CAPTURE(frame);
        CHECK(used.dilated(image, {radius_px, kRelief_px}).levels ==
              dilated(image, radius_px).levels);
        if (frame % 4 != 3) change_some(image, random);
    }
}

TEST_CASE("it is exact on surfaces of every kind and size", "[fingertip]") {
    const unsigned kind = GENERATE(0U, 1U, 2U, 3U);
    const double radius_px = GENERATE(some_of<double>({2.0, 3.5, 5.0, 8.0, 13.0, 23.0}, 2));
    CAPTURE(kind, radius_px);
    for (const auto& [columns, rows] :
         std::initializer_list<std::pair<int, int>>{{2, 2}, {3, 2}, {2, 40}, {33, 3}, {29, 27}})
        CHECK(worst_error(surface_of(kind, columns, rows, kind), {radius_px, kRelief_px}) <
              kExact_px);
}

TEST_CASE("a picture without a surface is left as it is", "[fingertip]") {
    const auto [columns, rows] = GENERATE(std::pair{1, 1}, std::pair{5, 1}, std::pair{1, 5});
    CleaningPlan plan{kRawSteps, {5.0, kRelief_px}};
    const DepthImage image = rough(columns, rows, 255.0, 20.0, 1.0);
    CHECK(CleaningChain().clean_and_finish(image, plan).depth->levels == image.levels);
}

TEST_CASE("it is the definition, over the finely sampled surface", "[fingertip]") {
    const double radius_px = GENERATE(0.3, 1.0, 2.6, 5.0, 9.0);
    const DepthImage image = rough(26, 18, 255.0, 0.4, GENERATE(0.0, 0.8));
    CAPTURE(radius_px);
    const DepthImage felt = dilated(image, radius_px);
    const Rest rest(image, {radius_px, kRelief_px});
    double too_low = 0.0, too_high = 0.0;
    for (int j = 0; j < image.rows; j += 2)
        for (int i = 0; i < image.columns; i += 3) {
            const double above = felt.at(i, j) - rest.on_samples(i, j, 16);
            too_low = std::min(too_low, above);
            too_high = std::max(too_high, above);
        }
    CHECK(too_low > -kRounding_px);
    CHECK(too_high < kExact_px);
}

TEST_CASE("it is exact on surfaces of every roughness", "[fingertip]") {
    const double radius_px = GENERATE(some_of<double>({2.4, 6.0, 0.3, 1.0, 10.3}, 2));
    const double deviation = GENERATE(some_of<double>({3.0, 100.0, 0.05, 0.5, 20.0}, 2));
    const double slope = GENERATE(0.0, 1.5);
    CAPTURE(radius_px, deviation, slope);
    CHECK(worst_error(rough(26, 20, 255.0, deviation, slope), {radius_px, kRelief_px}) < kExact_px);
}

TEST_CASE("it is exact for every form of levels and every relief", "[fingertip]") {
    const double highest_level = GENERATE(255.0, 65535.0);
    const double relief_px = GENERATE(0.5, 40.0, 255.0, 1000.0);
    CAPTURE(highest_level, relief_px);
    CHECK(worst_error(rough(26, 20, highest_level, 4.0, 0.5), {7.0, relief_px}) < kExact_px);
}

TEST_CASE("it is exact on steps", "[fingertip]") {
    const double radius_px = GENERATE(0.5, 2.0, 5.0, 8.3, 10.0, 14.142);
    CAPTURE(radius_px);
    CHECK(worst_error(stepped(30, 24), {radius_px, kRelief_px}) < kExact_px);
}

TEST_CASE("it is exact over combs of every pitch and direction", "[fingertip]") {
    const int pitch = GENERATE(some_of<int>({3, 7, 2, 5, 11}, 2));
    const int direction = GENERATE(some_of<int>({2, 0, 1}, 1));
    const double lower = GENERATE(some_of<double>({60.0, 3.0}, 1));
    CAPTURE(pitch, direction, lower);
    CHECK(worst_error(comb(pitch, direction, 60.0, lower), {9.7, kRelief_px}) < kExact_px);
}

TEST_CASE("it is exact among needles and pits of all heights", "[fingertip]") {
    const unsigned one_of = GENERATE(some_of<unsigned>({9, 1, 2, 40}, 1));
    const double relief_px = GENERATE(4.0, kRelief_px, 3000.0);
    const double radius_px = GENERATE(some_of<double>({10.0, 3.2, 14.5}, 1));
    CAPTURE(one_of, relief_px, radius_px);
    CHECK(worst_error(scattered(one_of, one_of), {radius_px, relief_px}) < kExact_px);
}

TEST_CASE("it is exact where the surface is rough in one direction alone", "[fingertip]") {
    const double deviation = GENERATE(some_of<double>({2.0, 0.2, 12.0}, 1));
    const int direction = GENERATE(some_of<int>({2, 0, 1}, 1));
    CAPTURE(deviation, direction);
    std::mt19937 random(5);
    std::normal_distribution<double> noise(100.0, deviation);
    std::vector<double> profile(64);
    for (double& level : profile) level = std::clamp(noise(random), 0.0, 255.0);
    const DepthImage image = image_of(32, 28, 255.0, [&](int i, int j) {
        const int across = direction == 0 ? i : direction == 1 ? j : i + j;
        return profile[static_cast<std::size_t>(across)] + 0.1 * j;
    });
    CHECK(worst_error(image, {10.0, kRelief_px}) < kExact_px);
}

TEST_CASE("it is exact for a finger wider than the image", "[fingertip]") {
    const double radius_px = GENERATE(40.0, kWidestExactFinger_px);
    CAPTURE(radius_px);
    CHECK(worst_error(rough(24, 16, 255.0, 5.0, 0.5), {radius_px, kRelief_px}) < kExact_px);
    CHECK(worst_error(rough(2, 2, 255.0, 30.0, 0.5), {radius_px, kRelief_px}) < kExact_px);
}

namespace {

void require_felt_wide(const DepthImage& bumpy, double radius_px, int step) {
    CAPTURE(radius_px);
    const DepthImage felt = dilated(bumpy, radius_px);
    CHECK(least_lead(felt, dilated(bumpy, 8.0)) >= -kRounding_px);
    CHECK(worst_error(bumpy, {radius_px, kRelief_px}, step) < 0.5);

    const int size = 2 * static_cast<int>(radius_px) + 41;
    const DepthImage plane =
        image_of(size, size, 255.0, [](int i, int j) { return 40.0 + 0.2 * i + 0.1 * j; });
    const double lift = radius_px * (std::sqrt(1.05) - 1.0);
    CHECK_THAT(dilated(plane, radius_px).at(size / 2, size / 2) - plane.at(size / 2, size / 2),
               WithinAbs(lift, kExact_px));
}

}  // namespace

TEST_CASE("a very wide finger is felt nearly as exactly, and as exactly on a plane",
          "[fingertip]") {
    require_felt_wide(rough(24, 18, 255.0, 3.0, 0.2), GENERATE(some_of<double>({65.0, 130.0}, 1)),
                      3);
}

TEST_CASE("over a larger surface, too, a very wide finger is felt nearly as exactly",
          "[fingertip][long]") {
    require_felt_wide(rough(60, 45, 255.0, 3.0, 0.2), GENERATE(65.0, 130.0, 300.0), 3);
}

namespace {

/// The definition of a very wide finger: dilated by a ball of four steps, thinned out, dilated by
/// the rest, and no lower than between those pixels.
DepthImage dilated_in_two_steps(const DepthImage& image, double radius_px) {
    const int step = static_cast<int>(std::ceil(radius_px / kWidestExactFinger_px));
    DepthImage felt = dilated(image, 4.0 * step);
    const auto thinned = [step](int pixels) { return (pixels + step - 2) / step + 1; };
    DepthImage coarse = image_of(
        thinned(image.columns), thinned(image.rows), image.highest_level, [&](int i, int j) {
            return felt.at(std::min(i * step, felt.columns - 1), std::min(j * step, felt.rows - 1));
        });
    coarse = dilated(coarse, (radius_px - 4.0 * step) / step, kRelief_px / step);
    const auto share = [step](int along, int from) {
        return static_cast<float>(along - from * step) / static_cast<float>(step);
    };
    for (int j = 0; j < felt.rows; ++j)
        for (int i = 0; i < felt.columns; ++i) {
            const int x = std::min(i / step, coarse.columns - 2);
            const int y = std::min(j / step, coarse.rows - 2);
            const float above = std::lerp(coarse.at(x, y), coarse.at(x + 1, y), share(i, x));
            const float below =
                std::lerp(coarse.at(x, y + 1), coarse.at(x + 1, y + 1), share(i, x));
            felt.at(i, j) = std::max(felt.at(i, j), std::lerp(above, below, share(j, y)));
        }
    return felt;
}

}  // namespace

TEST_CASE("a very wide finger leaves out only what it does not touch, to the bit", "[fingertip]") {
    const unsigned kind = GENERATE(0U, 1U, 2U, 3U);
    const double radius_px = GENERATE(some_of<double>({65.0, 128.5, 200.0, 500.0}, 2));
    const auto [columns, rows] = GENERATE(std::pair{2, 2}, std::pair{361, 2}, std::pair{402, 251});
    CAPTURE(kind, radius_px, columns, rows);
    const DepthImage image = surface_of(kind, columns, rows, kind);
    CHECK(dilated(image, radius_px).levels == dilated_in_two_steps(image, radius_px).levels);
}

TEST_CASE("it is exact at every pixel", "[fingertip][long]") {
    const Fingertip finger{GENERATE(2.4, 9.7), kRelief_px};
    CAPTURE(finger.radius_px);
    CHECK(worst_error(stepped(30, 24), finger, 1) < kExact_px);
    for (const double deviation : {0.05, 3.0, 100.0})
        CHECK(worst_error(rough(26, 20, 255.0, deviation, 1.5), finger, 1) < kExact_px);
    for (const int pitch : {2, 3, 5, 7, 11})
        for (const int direction : {0, 1, 2})
            for (const double lower : {60.0, 3.0})
                CHECK(worst_error(comb(pitch, direction, 60.0, lower), finger, 1) < kExact_px);
    for (const unsigned one_of : {1U, 2U, 9U, 40U})
        CHECK(worst_error(scattered(one_of, one_of), finger, 1) < kExact_px);
}

TEST_CASE("a finger is not wider than the widest", "[fingertip]") {
    const DepthImage image = rough(20, 20, 255.0, 30.0, 0.5);
    CHECK(dilated(image, 1e9).levels == dilated(image, kWidestFinger_px).levels);
}

TEST_CASE("a plane is felt as the plane a radius away from it", "[fingertip]") {
    const double radius_px = GENERATE(0.3, 1.0, 4.5, 10.0);
    const double slope = GENERATE(0.0, 0.3, 1.0, 3.0, 5.0);
    const double angle = GENERATE(0.0, 0.2, 0.7854, 1.1, 2.3562, 4.0);
    CAPTURE(radius_px, slope, angle);
    const double slope_x = slope * std::cos(angle), slope_y = slope * std::sin(angle);
    const DepthImage image = image_of(44, 44, 65535.0, [&](int i, int j) {
        return 65535.0 / 1000.0 * (500.0 + slope_x * (i - 22) + slope_y * (j - 22));
    });
    const DepthImage felt = dilated(image, radius_px, 1000.0);
    const double lift = radius_px * (std::sqrt(1.0 + slope * slope) - 1.0);
    double worst = 0.0;
    for (int j = 12; j < 32; ++j)
        for (int i = 12; i < 32; ++i) {
            const double rise = (felt.at(i, j) - image.at(i, j)) * 1000.0 / 65535.0;
            worst = std::max(worst, std::abs(rise - lift));
        }
    CHECK(worst < kExact_px);
}

TEST_CASE("the edge of a step is felt round", "[fingertip]") {
    const double radius_px = GENERATE(1.5, 6.0, 10.0);
    const DepthImage image =
        image_of(60, 20, 255.0, [](int i, int) { return i <= 30 ? 200.0 : 20.0; });
    const DepthImage felt = dilated(image, radius_px);
    for (int i = 0; i < 60; ++i) {
        CAPTURE(radius_px, i);
        const double z = rest_beside_wall(std::max(0, i - 30), 200.0, 20.0, radius_px);
        CHECK_THAT(double{felt.at(i, 10)}, WithinAbs(z, kExact_px));
    }
}

TEST_CASE("a sphere is felt as one with a radius more", "[fingertip]") {
    const double radius_px = GENERATE(2.0, 10.0, 25.0);
    const double sphere_px = 100.0;
    const DepthImage image = image_of(121, 121, 65535.0, [&](int i, int j) {
        const double away = std::hypot(i - 60, j - 60);
        return 65535.0 / 255.0 *
               (100.0 + std::sqrt(std::max(0.0, sphere_px * sphere_px - away * away)));
    });
    const DepthImage felt = dilated(image, radius_px);
    const double whole_px = sphere_px + radius_px;
    double worst = 0.0;
    for (int j = 10; j < 111; ++j)
        for (int i = 10; i < 111; ++i) {
            const double away = std::hypot(i - 60, j - 60);
            if (away > 45.0) continue;
            const double z = 100.0 - radius_px + std::sqrt(whole_px * whole_px - away * away);
            worst = std::max(worst, std::abs(felt.at(i, j) * 255.0 / 65535.0 - z));
        }
    CAPTURE(radius_px);
    CHECK(worst < kExact_px);
}

TEST_CASE("in a groove the ball rests on both walls", "[fingertip]") {
    const double radius_px = GENERATE(2.0, 6.0, 10.0);
    const double slope = GENERATE(0.3, 1.0, 3.0);
    const bool diagonal = GENERATE(false, true);
    CAPTURE(radius_px, slope, diagonal);
    const auto away = [diagonal](int i, int j) {
        return diagonal ? std::abs(i - j) * std::sqrt(0.5) : std::abs(i - 30.0);
    };
    const DepthImage image = image_of(
        61, 61, 255.0, [&](int i, int j) { return std::min(20.0 + slope * away(i, j), 200.0); });
    const DepthImage felt = dilated(image, radius_px);
    const double lift = radius_px * (std::sqrt(1.0 + slope * slope) - 1.0);
    for (int k = 26; k < 35; ++k)
        CHECK_THAT(double{felt.at(k, 30)}, WithinAbs(20.0 + slope * away(k, 30) + lift, kExact_px));
}

TEST_CASE("a crack or a pit narrower than the finger cannot be entered", "[fingertip]") {
    const double radius_px = GENERATE(3.0, 10.0);
    const int half = GENERATE(1, 2, 3);
    const bool pit = GENERATE(false, true);
    CAPTURE(radius_px, half, pit);
    const DepthImage image = image_of(50, 50, 255.0, [&](int i, int j) {
        return std::abs(i - 25) < half && (!pit || std::abs(j - 25) < half) ? 0.0 : 150.0;
    });
    // Around a pit of one pixel the diagonals of the cells are nearer than its neighbours.
    const double rim = pit && half == 1 ? std::sqrt(0.5) : half;
    const double over = std::sqrt(radius_px * radius_px - rim * rim);
    CHECK_THAT(double{dilated(image, radius_px).at(25, 25)},
               WithinAbs(150.0 - radius_px + over, kExact_px));
}

TEST_CASE("a ridge, and a needle, are felt as round as the finger", "[fingertip]") {
    const double radius_px = GENERATE(3.0, 10.0, 12.5);
    const bool needle = GENERATE(false, true);
    const DepthImage image = image_of(50, 50, 255.0, [&](int i, int j) {
        return i == 25 && (!needle || j == 25) ? 180.0 : 10.0;
    });
    const DepthImage felt = dilated(image, radius_px);
    for (int i = 10; i < 40; ++i) {
        CAPTURE(radius_px, needle, i);
        const double z = rest_beside_wall(std::abs(i - 25), 180.0, 10.0, radius_px);
        CHECK_THAT(double{felt.at(i, 25)}, WithinAbs(z, kExact_px));
    }
}

TEST_CASE("beyond the border there is nothing to touch", "[fingertip]") {
    const double radius_px = 10.0;
    const double slope = 1.0;
    const DepthImage image = image_of(60, 30, 255.0, [&](int i, int) { return 20.0 + slope * i; });
    const DepthImage felt = dilated(image, radius_px);
    const double touched = radius_px * slope / std::sqrt(1.0 + slope * slope);
    for (int away = 0; away < 20; ++away) {
        CAPTURE(away);
        const double over = std::sqrt(std::max(0.0, radius_px * radius_px - away * away));
        const double lift = radius_px * (std::sqrt(1.0 + slope * slope) - 1.0);
        const double z = away < touched ? 79.0 - radius_px + over : 79.0 - away + lift;
        CHECK_THAT(double{felt.at(59 - away, 15)}, WithinAbs(z, kExact_px));
    }
}

TEST_CASE("a ball at rest touches the original surface at its radius", "[fingertip]") {
    const double radius_px = GENERATE(0.5, 3.0, 10.0, 30.0);
    const int kind = GENERATE(0, 1, 2, 3, 4);
    CAPTURE(radius_px, kind);
    const DepthImage image = [kind] {
        if (kind == 0) return rough(50, 40, 255.0, 0.0, 1.5);
        if (kind == 1) return rough(50, 40, 255.0, 3.0, 0.5);
        if (kind == 2) return stepped(50, 40);
        if (kind == 3)
            return image_of(50, 40, 255.0, [](int i, int) { return 20.0 + std::abs(i - 25.0); });
        return image_of(50, 40, 255.0, [](int i, int j) {
            return 20.0 + std::sqrt(std::max(0.0, 900.0 - (i - 25) * (i - 25) - j * j));
        });
    }();
    const DepthImage felt = dilated(image, radius_px);
    double worst = 0.0;
    for (int j = 0; j < image.rows; j += 3)
        for (int i = 0; i < image.columns; i += 2) {
            const double distance = distance_to_contact(image, felt, radius_px, i, j);
            worst = std::max(worst, std::abs(distance - radius_px));
        }
    CHECK(worst < kExact_px);
}

TEST_CASE("a point touches right under itself", "[fingertip]") {
    const DepthImage image = rough(20, 20, 255.0, 5.0, 0.0);
    const DepthSurface surface(image, image, 0.0, {kRelief_px, 0.0});
    const Vec3 point = contact_point(surface, {0.0, kRelief_px}, {7.3, 4.8, 200.0});
    CHECK(point.x == 7.3);
    CHECK(point.y == 4.8);
    CHECK(point.z == surface.elevation_at(7.3, 4.8));
}

TEST_CASE("between two frames the ball never enters the surface", "[fingertip]") {
    const double radius_px = 6.0;
    const DepthImage from = rough(40, 30, 255.0, 3.0, 0.5, 1);
    const DepthImage to = rough(40, 30, 255.0, 3.0, -0.5, 2);
    const DepthImage felt_from = dilated(from, radius_px), felt_to = dilated(to, radius_px);
    const double blend = GENERATE(0.0, 0.3, 0.5, 1.0);
    CAPTURE(blend);
    const DepthSurface original(from, to, blend, {kRelief_px, 0.0});
    const DepthSurface felt(felt_from, felt_to, blend, {kRelief_px, 0.0});
    double nearest = 1e9;
    for (int j = 0; j < 30; j += 2)
        for (int i = 0; i < 40; i += 2) {
            const Vec3 proxy{i, j, felt.elevation(i, j)};
            const Vec3 point = contact_point(original, {radius_px, kRelief_px}, proxy);
            nearest = std::min(nearest, glm::length(point - proxy - Vec3{0.0, 0.0, radius_px}));
        }
    CHECK(nearest > radius_px - kExact_px);
}
