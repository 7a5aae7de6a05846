// Turns a motion into goals, and models a hand: arcs of ellipses in minimum-jerk time.
#include "core/experiment/hand_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kRoundOff = 1e-9;

constexpr int kMoments = 10;
constexpr double kThreshold = 0.25;
constexpr double kInside = 0.9;

/// The mask of the foreground at one moment, row-major.
std::vector<char> foreground_of(const DepthSurface& surface) {
    std::vector<double> elevations;
    for (int j = 0; j < surface.rows(); ++j) {
        for (int i = 0; i < surface.columns(); ++i) elevations.push_back(surface.elevation(i, j));
    }
    const auto [lowest, highest] = std::minmax_element(elevations.begin(), elevations.end());
    const double threshold = *lowest + kThreshold * (*highest - *lowest);
    std::vector<char> mask(elevations.size());
    std::transform(elevations.begin(), elevations.end(), mask.begin(),
                   [threshold](double z) { return static_cast<char>(z > threshold ? 1 : 0); });
    return mask;
}

struct Rectangle {
    int left{0}, top{0}, width{0}, height{0};
    [[nodiscard]] long area() const { return static_cast<long>(width) * height; }
};

/// The largest rectangle that stands on `row`, of columns `heights` high there.
Rectangle largest_on_row(const std::vector<int>& heights, int row) {
    Rectangle best;
    std::vector<std::size_t> rising;  // columns whose rectangles are still growing
    for (std::size_t i = 0; i <= heights.size(); ++i) {
        const int height = i < heights.size() ? heights[i] : 0;
        while (!rising.empty() && heights[rising.back()] >= height) {
            const int top = heights[rising.back()];
            rising.pop_back();
            const std::size_t left = rising.empty() ? 0 : rising.back() + 1;
            const Rectangle found{static_cast<int>(left), row - top + 1, static_cast<int>(i - left),
                                  top};
            if (found.area() > best.area()) best = found;
        }
        rising.push_back(i);
    }
    return best;
}

Rectangle largest_rectangle(const std::vector<char>& mask, int columns, int rows) {
    Rectangle best;
    std::vector<int> heights(static_cast<std::size_t>(columns), 0);
    for (int j = 0; j < rows; ++j) {
        const std::size_t row = static_cast<std::size_t>(j) * heights.size();
        for (std::size_t i = 0; i < heights.size(); ++i) {
            heights[i] = mask[row + i] != 0 ? heights[i] + 1 : 0;
        }
        const Rectangle found = largest_on_row(heights, j);
        if (found.area() > best.area()) best = found;
    }
    return best;
}

constexpr double kTremor_px = 0.25;
constexpr double kLightest_px = 6.0;
constexpr double kDeepest_px = 20.0;
constexpr int kTries = 200;

/// 0 to 1 in minimum-jerk time, u in [0, 1].
double minimum_jerk(double u) {
    return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

/// The generator's bits are standardized; std's distributions differ between libraries.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : bits_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits_() >> 11U) * 0x1p-53);
    }

  private:
    std::mt19937_64 bits_;
};

/// An arc of an ellipse. Its angle advances evenly, which by itself gives the power law.
struct HandStroke {
    Vec2 centre{0.0};
    Vec2 along{0.0};  ///< half axes
    Vec2 across{0.0};
    double from_rad{0.0};
    double sweep_rad{0.0};
    double duration_s{1.0};

    [[nodiscard]] Vec2 at(double share) const {
        const double angle = from_rad + share * sweep_rad;
        return centre + std::cos(angle) * along + std::sin(angle) * across;
    }
};

bool stays_inside(const HandStroke& stroke, const ImageArea& area) {
    constexpr int kSteps = 64;
    for (int k = 0; k <= kSteps; ++k) {
        const Vec2 off = stroke.at(static_cast<double>(k) / kSteps) - area.centre;
        if (std::abs(off.x) > area.half_size.x || std::abs(off.y) > area.half_size.y) return false;
    }
    return true;
}

HandStroke stroke_from(Vec2 place, const ImageArea& area, double share_of_area, Dice& dice) {
    const double reach = share_of_area * std::min(area.half_size.x, area.half_size.y);
    const double half = reach * dice.between(0.4, 1.2);
    const double other = half * dice.between(0.25, 0.9);
    const double turned = dice.between(0.0, std::numbers::pi);
    HandStroke stroke;
    stroke.along = half * Vec2{std::cos(turned), std::sin(turned)};
    stroke.across = other * Vec2{-std::sin(turned), std::cos(turned)};
    stroke.from_rad = dice.between(0.0, 2.0 * std::numbers::pi);
    stroke.sweep_rad =
        dice.between(0.8, 3.2) * std::numbers::pi * (dice.between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0);
    stroke.duration_s = dice.between(0.35, 0.6) * std::abs(stroke.sweep_rad) / std::numbers::pi;
    stroke.centre = place - (stroke.at(0.0) - stroke.centre);
    return stroke;
}

/// A stroke that stays inside the area; after many tries shorter and shorter ones.
HandStroke next_stroke(Vec2 place, const ImageArea& area, Dice& dice) {
    HandStroke stroke = stroke_from(place, area, 1.0, dice);
    for (int k = 0; k < kTries && !stays_inside(stroke, area); ++k) {
        stroke = stroke_from(place, area, 1.0 - static_cast<double>(k) / kTries, dice);
    }
    return stroke;
}

/// The sum of three slow sines within the band, by an axis of its own.
class Tremor {
  public:
    explicit Tremor(Dice& dice) {
        for (Wave& wave : waves_) {
            wave = {dice.between(8.0, 12.0), dice.between(0.0, 2.0 * std::numbers::pi)};
        }
    }
    [[nodiscard]] double at(double t_s) const {
        double sum = 0.0;
        for (const Wave& wave : waves_)
            sum += std::sin(2.0 * std::numbers::pi * wave.hertz * t_s + wave.phase);
        return kTremor_px * sum / static_cast<double>(waves_.size());
    }

  private:
    struct Wave {
        double hertz{0.0};
        double phase{0.0};
    };
    std::array<Wave, 3> waves_{};
};

/// Lays strokes and pauses end to end.
class HandModel {
  public:
    HandModel(const ImageArea& area, int updates, std::uint64_t seed)
        : area_(area), updates_(static_cast<std::size_t>(std::max(updates, 0))), dice_(seed) {}

    HandMotion run() {
        motion_.source = "modelled: minimum-jerk strokes, two-thirds power law, tremor, pauses";
        Vec2 place = area_.centre;
        double pressed_px = -kLifted_px;
        while (motion_.places.size() < updates_) {
            const double next_px = dice_.between(kLightest_px, kDeepest_px);
            const HandStroke stroke = next_stroke(place, area_, dice_);
            append_stroke(stroke, stroke.duration_s, pressed_px, next_px);
            place = stroke.at(1.0);
            const bool lifts = dice_.between(0.0, 1.0) < 0.3;
            pressed_px = lifts ? -kLifted_px : next_px;
            HandStroke pause;
            pause.centre = place;
            append_stroke(pause, dice_.between(0.1, 0.4), next_px, pressed_px);
        }
        add_tremor();
        return std::move(motion_);
    }

  private:
    void append_stroke(const HandStroke& stroke, double duration_s, double from_px, double to_px) {
        const int count = std::max(static_cast<int>(duration_s / kUpdate_s), 1);
        for (int k = 1; k <= count && motion_.places.size() < updates_; ++k) {
            const double share = minimum_jerk(static_cast<double>(k) / count);
            motion_.places.push_back(stroke.at(share));
            motion_.penetrations_px.push_back(from_px + share * (to_px - from_px));
        }
    }

    void add_tremor() {
        const Tremor x(dice_);
        const Tremor y(dice_);
        const Tremor z(dice_);
        for (std::size_t k = 0; k < updates_; ++k) {
            const double t_s = kUpdate_s * static_cast<double>(k);
            motion_.places[k] += Vec2{x.at(t_s), y.at(t_s)};
            motion_.penetrations_px[k] += z.at(t_s);
        }
    }

    ImageArea area_;
    std::size_t updates_;
    Dice dice_;
    HandMotion motion_{};
};

}  // namespace

void fit_into(HandMotion& motion, const ImageArea& area) {
    Vec2 low = motion.places.at(0);
    Vec2 high = low;
    for (const Vec2& place : motion.places) {
        low = {std::min(low.x, place.x), std::min(low.y, place.y)};
        high = {std::max(high.x, place.x), std::max(high.y, place.y)};
    }
    const Vec2 half = 0.5 * (high - low);
    // The round-off of a resting hand is no motion, and must not be magnified.
    const double furthest = std::max(std::max(std::abs(low.x), std::abs(low.y)),
                                     std::max(std::abs(high.x), std::abs(high.y)));
    const double least = kRoundOff * furthest;
    const double fits_x = half.x > least ? area.half_size.x / half.x : INFINITY;
    const double fits_y = half.y > least ? area.half_size.y / half.y : INFINITY;
    const double scale = std::min(fits_x, fits_y);
    if (!std::isfinite(scale) || scale <= 0.0) {
        throw InputError("the hand does not move; record it again while it moves");
    }
    const Vec2 centre = low + half;
    for (Vec2& place : motion.places) place = area.centre + scale * (place - centre);
}

PathRun human_path(const HandMotion& motion, const DepthClip& clip, double mu) {
    PathRun path;
    path.name = "human";
    path.source = motion.source;
    path.mu = mu;
    for (std::size_t k = 0; k < motion.places.size(); ++k) {
        const Vec2& place = motion.places[k];
        const double z = clip.at(kUpdate_s * static_cast<double>(k)).elevation_at(place.x, place.y);
        path.goals.emplace_back(place.x, place.y, z - motion.penetrations_px[k]);
    }
    survey_path(path, clip);
    return path;
}

ImageArea foreground_area(const DepthClip& clip) {
    std::vector<char> always;
    for (int k = 0; k < kMoments; ++k) {
        const auto mask = foreground_of(clip.at(clip.duration_s() * k / kMoments));
        if (always.empty()) always = mask;
        std::transform(always.begin(), always.end(), mask.begin(), always.begin(),
                       [](char a, char b) { return static_cast<char>(a & b); });
    }
    const Rectangle found = largest_rectangle(always, clip.columns(), clip.rows());
    const Vec2 whole{0.5 * (clip.columns() - 1), 0.5 * (clip.rows() - 1)};
    if (found.width < 2 || found.height < 2) return {whole, whole};
    const Vec2 half{0.5 * (found.width - 1), 0.5 * (found.height - 1)};
    return {Vec2(found.left, found.top) + half, kInside * half};
}

HandMotion modelled_hand(const ImageArea& area, int updates, std::uint64_t seed) {
    return HandModel(area, updates, seed).run();
}

}  // namespace dibhr
