// Finds ramps along lines of pixels, lets them vote for a side of each pixel, and moves pixels.
#include "core/video/cleaning/silhouettes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>
#include <opencv2/core/matx.hpp>
#include <optional>

#include "core/video/cleaning/patches.hpp"
#include "core/video/cleaning/silhouette_sides.hpp"
#include "core/video/frames/colour_image.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

using namespace side_of_pixel;

namespace {

/// A ramp is at least kSteep in the default relief of 255/720 of the picture's width [px/px]; a
/// flatter slope is a surface.
constexpr double kRelief_widths = 255.0 / 720.0;
constexpr double kSteep = 3.0;

constexpr float kWidest_px = 19.0F;  ///< 13 px of ramp across a corner, from end to end
/// That width in steps: on slanting lines, straight ones, and straight ones near the border.
constexpr int kSlantingSteps = 14, kStraightSteps = 20, kMostSteps = 28;
constexpr float kShoulder = 0.12F;    ///< of a ramp's steepest rise: below it the ramp ends
constexpr float kEven = 2.5F;         ///< of a ramp's slope: a steeper rise is a step already
constexpr float kGoesOn = 0.18F;      ///< of a ramp's slope: the most that a face may rise by
constexpr float kLevel = 0.02F;       ///< of a ramp's height a pixel: the rise where a face begins
constexpr float kLeastNoises = 8.0F;  ///< the height of a ramp, in standard deviations of the noise
constexpr float kFlatNoises = 1.5F;   ///< a smaller rise is flat

constexpr std::uint32_t kPixelsPerVote =
    3;  ///< a ramp counts if one in 3 pixels across it found it

constexpr int kFace_px = 3;        ///< a face's slope is taken over twice this length
constexpr int kWide_px = 5;        ///< in a narrower ramp the colour's edge is no better
constexpr float kColours = 48.0F;  ///< least difference of two faces' colours [of 255]
constexpr float kOwnSide = 0.25F;  ///< of that: a pixel this near to a face's colour is on it
constexpr int kSharp_px = 2;       ///< a sharp edge has at most these pixels on neither side

constexpr int kRowChunk = 64;  ///< pixels of a row that are checked together

struct Limits {
    float slope;  ///< least change of level a pixel
    float noise;  ///< [levels]
};

struct Pixel {
    int x, y;
};

/// The levels on a straight line of pixels through a centre, which is number 0. Beyond the border
/// the last level is repeated.
struct Line {
    const float* centre;
    std::ptrdiff_t stride;
    int first, last;

    [[nodiscard]] float operator()(int k) const {
        return centre[stride * std::clamp(k, first, last)];
    }
};

/// How many steps (-1, 0 or 1) lead from `at` to the last of `count` pixels.
int steps_inside(int at, int step, int count) {
    if (step == 0) return 3 * kMostSteps;  // more than are ever taken
    return step > 0 ? count - 1 - at : at;
}

Line line_through(const DepthImage& image, Pixel at, Pixel step) {
    const int on =
        std::min(steps_inside(at.x, step.x, image.columns), steps_inside(at.y, step.y, image.rows));
    const int back = std::min(steps_inside(at.x, -step.x, image.columns),
                              steps_inside(at.y, -step.y, image.rows));
    return {image.levels.data() + image.index(at.x, at.y),
            step.x + std::ptrdiff_t{step.y} * image.columns, -back, on};
}

/// The direction uphill, and the step to that of eight neighbours that is nearest to it.
struct Uphill {
    float x, y;
    Pixel step;
    int most_steps;  ///< across the widest ramp

    [[nodiscard]] float px_per_step() const {
        return (x * static_cast<float>(step.x) + y * static_cast<float>(step.y)) /
               std::sqrt(x * x + y * y);
    }
};

std::optional<Uphill> uphill(const DepthImage& image, Pixel at) {
    constexpr float kHalfAngle = 0.41421356F;  // the tangent of 45 / 2 degrees
    const Line row = line_through(image, at, {1, 0});
    const Line column = line_through(image, at, {0, 1});
    const float x = row(1) - row(-1) + row(2) - row(-2);
    const float y = column(1) - column(-1) + column(2) - column(-2);
    const float least = std::min(std::fabs(x), std::fabs(y));
    const float most = std::max(std::fabs(x), std::fabs(y));
    if (!(most > 0.0F)) return std::nullopt;
    // A slanting line near the border may end before the ramp does.
    const bool inside = std::min({-row.first, row.last, -column.first, column.last}) > kMostSteps;
    const bool slants = inside && least > kHalfAngle * most;
    const bool more_x = std::fabs(x) >= std::fabs(y);
    const auto sign = [](float along) { return along > 0.0F ? 1 : -1; };
    return Uphill{x,
                  y,
                  {slants || more_x ? sign(x) : 0, slants || !more_x ? sign(y) : 0},
                  slants   ? kSlantingSteps
                  : inside ? kStraightSteps
                           : kMostSteps};
}

/// Number of the pixel at which the line's rise from pixel 0 ends, measured over one and two pixels
/// so that a ripple is no end. `side` 1: onwards; -1: backwards, where the line falls. It ends at a
/// rise small against `steepest`, the steepest so far, or below `flat`. Nothing: no end in `most`
/// steps, or before the border.
std::optional<int> end_of_rise(const Line& line, int side, int most, float flat, float& steepest) {
    const auto sign = static_cast<float>(side);
    most = std::min(most, (side > 0 ? line.last : -line.first) - 2);
    const std::ptrdiff_t stride = side * line.stride;
    const float* at = line.centre;
    for (int k = 0; k <= most; ++k, at += stride) {
        const float rise = std::max(sign * at[stride], sign * at[2 * stride]) - sign * at[0];
        steepest = std::max(steepest, rise);
        if (rise <= std::max(kShoulder * steepest, flat)) return side * k;
    }
    return std::nullopt;
}

/// Moves the end of a ramp, which may be rounded, up to two pixels on while the line still rises.
int extended_end(const Line& line, int end, int side, float least) {
    const auto sign = static_cast<float>(side);
    for (int k = 0; k < 2 && sign * (line(end + side) - line(end)) > least; ++k) end += side;
    return end;
}

/// The largest rise between neighbours from pixel `low` to pixel `high` of the line.
float highest_step(const Line& line, int low, int high) {
    float highest = 0.0F;
    const float* at = line.centre + line.stride * low;
    for (int k = low; k < high; ++k, at += line.stride)
        highest = std::max(highest, at[line.stride] - at[0]);
    return highest;
}

/// The surface on one side of a ramp.
struct Face {
    int end;             ///< number of its first pixel
    float level, slope;  ///< level at that pixel; slope per step of the line

    [[nodiscard]] float at(int k) const { return level + slope * static_cast<float>(k - end); }
};

/// The level is the mean of three pixels, within the noise of the first. The slope is the part,
/// beyond noise, that two stretches after the end have in common, unless that is another outline.
Face face_from(const Line& line, int end, int side, float steepest, float noise) {
    const float level = line(end);
    const float middle = line(end + kFace_px * side);
    const float near = middle - level;
    const float far = line(end + 2 * kFace_px * side) - middle;
    const float least = std::fabs(near) < std::fabs(far) ? near : far;
    const float change = std::max(std::fabs(least) - kFlatNoises * noise, 0.0F);
    const float slope = std::copysign(change, least * static_cast<float>(side)) / kFace_px;
    const bool goes_on = near * far > 0.0F && std::fabs(slope) <= steepest;
    const float mean = (level + line(end + side) + line(end + 2 * side)) / 3.0F;
    return {end, std::clamp(mean, level - noise, level + noise), goes_on ? slope : 0.0F};
}

struct Ramp {
    Face low, high;
};

/// The ramp that pixel 0 of a line uphill is on.
std::optional<Ramp> find_ramp(const Line& line, const Uphill& up, const Limits& limits) {
    // The steeper side first: most pixels that are not on a ramp are beside a much higher step.
    const int side = line(1) - line(0) > line(0) - line(-1) ? 1 : -1;
    const float flat = kFlatNoises * limits.noise;
    float steepest = 0.0F;
    auto one = end_of_rise(line, side, up.most_steps, flat, steepest);
    if (!one || *one == 0) return std::nullopt;
    const float steepest_of_one = steepest;
    const auto other = end_of_rise(line, -side, up.most_steps, flat, steepest);
    if (!other || *other == 0) return std::nullopt;
    if (steepest > steepest_of_one) one = end_of_rise(line, side, up.most_steps, flat, steepest);
    if (!one || *one == 0) return std::nullopt;

    const int low = std::min(*one, *other);
    const int high = std::max(*one, *other);
    const auto steps = static_cast<float>(high - low);
    const float width_px = steps * up.px_per_step();
    const float height = line(high) - line(low);
    const float slope = height / steps;
    if (width_px > kWidest_px) return std::nullopt;
    if (height < std::max(width_px * limits.slope, kLeastNoises * limits.noise))
        return std::nullopt;
    if (highest_step(line, low, high) > kEven * slope) return std::nullopt;

    const int beyond = std::max(2, (high - low) / 2);
    const float most = kGoesOn * slope * static_cast<float>(beyond) + 2.0F * limits.noise;
    if (line(high + beyond) - line(high) > most) return std::nullopt;
    if (line(low) - line(low - beyond) > most) return std::nullopt;
    const float least = std::max(kLevel * height, flat);
    const float steepest_face = kGoesOn * slope;
    return Ramp{
        face_from(line, extended_end(line, low, -1, least), -1, steepest_face, limits.noise),
        face_from(line, extended_end(line, high, 1, least), 1, steepest_face, limits.noise)};
}

/// Number of the first pixel of the high side, so that it has as many pixels as are nearer to it.
int half_way_up(const Line& line, const Ramp& ramp) {
    int step = ramp.high.end;
    const float* at = line.centre + line.stride * (ramp.low.end + 1);
    for (int k = ramp.low.end + 1; k < ramp.high.end; ++k, at += line.stride)
        step -= 2.0F * *at > ramp.low.at(k) + ramp.high.at(k) ? 1 : 0;
    return step;
}

/// Red, green and blue at the place of a pixel of the depth image.
cv::Vec3f colour_at(const ColourImage& colour, const DepthImage& image, Pixel at) {
    const auto place = [](int pixel, int count, int colour_count) {
        const std::int64_t middle = 2 * std::int64_t{std::clamp(pixel, 0, count - 1)} + 1;
        return static_cast<std::size_t>(middle * colour_count / (2 * std::int64_t{count}));
    };
    const std::size_t row = place(at.y, image.rows, colour.rows);
    const std::size_t column = place(at.x, image.columns, colour.columns);
    const std::uint8_t* const rgb =
        colour.rgb.data() + 3 * (row * static_cast<std::size_t>(colour.columns) + column);
    return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}

/// Number of the first pixel in the high face's colour, if the colours of the faces are clearly
/// different and there is one sharp edge between them. `colour_of(k)`: of pixel k of the line.
template <typename ColourOf>
std::optional<int> colour_edge(const ColourOf& colour_of, const Ramp& ramp) {
    const cv::Vec3f low = colour_of(ramp.low.end - 1);
    const cv::Vec3f across = colour_of(ramp.high.end + 1) - low;
    const float square = across.dot(across);
    if (square < kColours * kColours) return std::nullopt;
    std::optional<int> edge;
    int on_neither = 0;
    for (int k = ramp.low.end; k <= ramp.high.end; ++k) {
        const float part = (colour_of(k) - low).dot(across) / square;
        if (part <= 0.5F && edge) return std::nullopt;  // a second edge
        if (part > 0.5F && !edge) edge = k;
        if (part > kOwnSide && part < 1.0F - kOwnSide) ++on_neither;
    }
    return on_neither <= kSharp_px ? edge : std::nullopt;
}

/// Sets `steep` to 0, or not 0 where the image rises, or falls, on both sides of a pixel by more
/// than `least`, over `reach` or twice as many pixels of the row, or one or two of the column.
/// `rows`: two above, the pixels' own, two below. Returns whether any is not 0.
DIBHR_VECTOR_CLONES bool find_steep(const std::array<const float*, 5>& rows, int reach, int count,
                                    float least, int* __restrict steep) {
    const float* const up2 = rows[0];
    const float* const up = rows[1];
    const float* const row = rows[2];
    const float* const down = rows[3];
    const float* const down2 = rows[4];
    const auto to_both = [least](float before, float here, float after) {
        return static_cast<int>(std::min(here - before, after - here) > least) |
               static_cast<int>(std::max(here - before, after - here) < -least);
    };
    int found = 0;
    for (int i = 0; i < count; ++i) {
        steep[i] = to_both(row[i - reach], row[i], row[i + reach]) |
                   to_both(row[i - 2 * reach], row[i], row[i + 2 * reach]) |
                   to_both(up[i], row[i], down[i]) | to_both(up2[i], row[i], down2[i]);
        found |= steep[i];
    }
    return found != 0;
}

}  // namespace

struct SilhouetteSharpener::Scene {
    const DepthImage& image;
    const ColourImage* colour;
    Limits limits;
};

void SilhouetteSharpener::sharpen(DepthImage& image, const ColourImage* colour,
                                  float noise_levels) {
    if (colour != nullptr && colour->rgb.empty()) colour = nullptr;
    const double least = kSteep * image.highest_level / (kRelief_widths * image.columns);
    const Scene scene{image, colour, {static_cast<float>(least), noise_levels}};
    forget(image.levels.size());
    if (!find_ramps(scene)) return;
    for (Votes& votes : votes_) decide(votes);
    decide_together(image);
    smooth_sides(image);
}

/// Clears the marks of the picture before: of its pixels, which are few.
void SilhouetteSharpener::forget(std::size_t pixels) {
    if (sides_.size() == pixels + kReadBeyond) {
        for (const Votes& votes : votes_) {
            votes_number_[votes.pixel] = 0;
            sides_[votes.pixel] = 0;
        }
        for (const std::uint32_t pixel : steep_) sides_[pixel] = 0;
    } else {
        votes_number_.reset(
            static_cast<std::uint32_t*>(std::calloc(pixels, sizeof(std::uint32_t))));
        if (!votes_number_) throw std::bad_alloc();
        sides_.assign(pixels + kReadBeyond, 0);
    }
    votes_.clear();
    ramps_.clear();
    steep_.clear();
}

/// A continued face may leave the range of levels; recorded real numbers may be outside already.
float SilhouetteSharpener::within(const DepthImage& image, float recorded, float level) noexcept {
    const auto highest = static_cast<float>(image.highest_level);
    return std::clamp(level, std::min(0.0F, recorded), std::max(highest, recorded));
}

bool SilhouetteSharpener::find_ramps(const Scene& scene) {
    const DepthImage& image = scene.image;
    const int inside = std::min(2, image.columns);
    for (int j = 0; j < image.rows; ++j) {
        scan_row(scene, j, 0, inside, 0);
        scan_row(scene, j, inside, image.columns - 2, 1);
        scan_row(scene, j, std::max(inside, image.columns - 2), image.columns, 0);
    }
    for (std::size_t k = 0; k < ramps_.size() && !are_too_many(); ++k) vote(ramps_[k]);
    return !are_too_many();
}

SilhouetteSharpener::Votes& SilhouetteSharpener::votes_of(std::size_t pixel) {
    std::uint32_t& number = votes_number_[pixel];
    if (number == 0) {
        votes_.push_back({.pixel = static_cast<std::uint32_t>(pixel)});
        number = static_cast<std::uint32_t>(votes_.size());
    }
    return votes_[number - 1];
}

/// Counts the votes: which side the pixel is on, and at which level.
void SilhouetteSharpener::decide(Votes& votes) {
    const unsigned count = votes.lows + votes.highs;
    if (kPixelsPerVote * count * count < votes.steps) return;
    const bool high = votes.highs > votes.lows;
    votes.side = high ? kHigh : kLow;
    votes.level = high ? votes.high / static_cast<float>(votes.highs)
                       : votes.low / static_cast<float>(votes.lows);
}

/// visit(row, begin, end) for each run of pixels that are steep or have a side.
template <typename Visit>
void SilhouetteSharpener::visit_runs_of(const DepthImage& image, const Visit& visit) {
    for (int j = 0; j < image.rows; ++j)
        visit_marked(sides_.data() + image.index(0, j), image.columns,
                     [&](int begin, int end) { visit(j, begin, end); });
}

/// A pixel keeps its side only where at least a third of those around that may be on a ramp have
/// one. (Of half the gaps between fingers would be lost.)
void SilhouetteSharpener::decide_together(const DepthImage& image) {
    for (const std::uint32_t pixel : steep_) sides_[pixel] = kUndecided;
    for (const Votes& votes : votes_)
        if (votes.side != kNeither) sides_[votes.pixel] = votes.side;
    visit_runs_of(image, [&](int row, int begin, int end) {
        const std::size_t at = image.index(0, row);
        const auto has_side = [](std::uint8_t side) { return side > kUndecided; };
        const std::uint8_t* const sides = sides_.data() + at;
        if (std::none_of(sides + begin, sides + end, has_side)) return;
        balances_.find(sides_.data(), image, {row, begin, end});
        for (int i = begin; i < end; ++i)
            if (has_side(sides[i]) && balances_.at(i) < 0)
                votes_[votes_number_[at + static_cast<std::size_t>(i)] - 1].side = kNeither;
    });
}

/// Each pixel becomes the mean level of itself and its neighbours on the same side of the outline:
/// each was continued along its own line, and without smoothing their noise would look like a comb.
void SilhouetteSharpener::smooth_sides(DepthImage& image) {
    for (Votes& votes : votes_) {
        sides_[votes.pixel] = votes.side;
        if (votes.side != kNeither) std::swap(image.levels[votes.pixel], votes.level);
    }
    for (Votes& votes : votes_)
        if (votes.side != kNeither)
            votes.smoothed = mean_of_side(image, sides_.data(), votes.pixel);
    for (const Votes& votes : votes_)
        if (votes.side != kNeither)
            image.levels[votes.pixel] = within(image, votes.level, votes.smoothed);
}

/// Checks pixels [begin, end) of a row, 2 * `reach` (0 or 1) pixels or more from its ends.
void SilhouetteSharpener::scan_row(const Scene& scene, int row, int begin, int end, int reach) {
    const DepthImage& image = scene.image;
    const float least = std::max(scene.limits.slope, 2.0F * scene.limits.noise);
    std::array<int, kRowChunk> steep{};
    for (; begin < end && !are_too_many(); begin += kRowChunk) {
        const int count = std::min(kRowChunk, end - begin);
        const auto from = [&](int j) {
            return image.levels.data() + image.index(begin, std::clamp(j, 0, image.rows - 1));
        };
        if (!find_steep({from(row - 2), from(row - 1), from(row), from(row + 1), from(row + 2)},
                        reach, count, least, steep.data()))
            continue;
        for (int i = 0; i < count; ++i)
            if (steep[static_cast<std::size_t>(i)] != 0) {
                steep_.push_back(static_cast<std::uint32_t>(image.index(begin + i, row)));
                find_ramp_at(scene, begin + i, row);
            }
    }
}

/// Finds the ramp that the pixel is on, unless it was found from another pixel across a wide ramp.
void SilhouetteSharpener::find_ramp_at(const Scene& scene, int column, int row) {
    const Pixel at{column, row};
    const auto up = uphill(scene.image, at);
    if (!up) return;
    const Line line = line_through(scene.image, at, up->step);
    const std::size_t own = scene.image.index(column, row);
    const std::uint32_t number = votes_number_[own];
    const std::uint32_t known = number != 0 ? votes_[number - 1].ramp : 0;
    if (known != 0 && ramps_[known - 1].stride == line.stride) {
        ++ramps_[known - 1].seen;
        return;
    }
    const auto ramp = find_ramp(line, *up, scene.limits);
    if (!ramp) return;
    std::optional<int> edge;
    if (scene.colour != nullptr && ramp->high.end - ramp->low.end > kWide_px) {
        const auto colour_of = [&](int k) {
            return colour_at(*scene.colour, scene.image,
                             {at.x + k * up->step.x, at.y + k * up->step.y});
        };
        edge = colour_edge(colour_of, *ramp);
    }
    const int begin = ramp->low.end + 1;
    const int step = std::clamp(edge.value_or(half_way_up(line, *ramp)), begin, ramp->high.end);
    ramps_.push_back({static_cast<std::int32_t>(own), static_cast<std::int32_t>(line.stride),
                      static_cast<std::int16_t>(begin), static_cast<std::int16_t>(step),
                      static_cast<std::int16_t>(ramp->high.end), 1, ramp->low.at(0),
                      ramp->low.slope, ramp->high.at(0), ramp->high.slope});
    const FoundRamp& found = ramps_.back();
    if (found.end - found.begin < kWide_px) return;  // quick to find again, and often another one
    for (int k = found.begin; k < found.end; ++k)
        votes_of(found.pixel(k)).ramp = static_cast<std::uint32_t>(ramps_.size());
}

void SilhouetteSharpener::vote(const FoundRamp& found) {
    const auto seen = static_cast<float>(found.seen);
    for (int k = found.begin; k < found.end; ++k) {
        Votes& votes = votes_of(found.pixel(k));
        votes.steps =
            static_cast<std::uint16_t>(votes.steps + found.seen * (found.end - found.begin + 1));
        const auto away = static_cast<float>(k);
        if (k >= found.step) {
            votes.highs = static_cast<std::uint16_t>(votes.highs + found.seen);
            votes.high += seen * (found.high + found.high_slope * away);
        } else {
            votes.lows = static_cast<std::uint16_t>(votes.lows + found.seen);
            votes.low += seen * (found.low + found.low_slope * away);
        }
    }
}

}  // namespace dibhr
