// Arcs of ellipses in minimum-jerk time.
#include "core/experiment/modelled_hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <utility>

namespace dibhr {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUpdate_s = 1e-3;
constexpr double kTremor_px = 0.25;
constexpr double kLightest_px = 6.0;
constexpr double kDeepest_px = 20.0;
constexpr double kLifted_px = 3.0;
constexpr int kTries = 200;

/// 0 to 1 in minimum-jerk time, u in [0, 1].
double minimum_jerk(double u) {
    return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

/// The generator's bits are the standard's; its distributions differ from library to library.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : bits_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits_() >> 11U) * 0x1p-53);
    }

  private:
    std::mt19937_64 bits_;
};

/// An arc of an ellipse. Its angle advances evenly, which by itself obeys the power law.
struct Stroke {
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

bool stays_inside(const Stroke& stroke, const ImageArea& area) {
    constexpr int kSteps = 64;
    for (int k = 0; k <= kSteps; ++k) {
        const Vec2 off = stroke.at(static_cast<double>(k) / kSteps) - area.centre;
        if (std::abs(off.x) > area.half_size.x || std::abs(off.y) > area.half_size.y) return false;
    }
    return true;
}

Stroke stroke_from(Vec2 place, const ImageArea& area, double share_of_area, Dice& dice) {
    const double reach = share_of_area * std::min(area.half_size.x, area.half_size.y);
    const double half = reach * dice.between(0.4, 1.2);
    const double other = half * dice.between(0.25, 0.9);
    const double turned = dice.between(0.0, kPi);
    Stroke stroke;
    stroke.along = half * Vec2{std::cos(turned), std::sin(turned)};
    stroke.across = other * Vec2{-std::sin(turned), std::cos(turned)};
    stroke.from_rad = dice.between(0.0, 2.0 * kPi);
    stroke.sweep_rad = dice.between(0.8, 3.2) * kPi * (dice.between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0);
    stroke.duration_s = dice.between(0.35, 0.6) * std::abs(stroke.sweep_rad) / kPi;
    stroke.centre = place - (stroke.at(0.0) - stroke.centre);
    return stroke;
}

/// A stroke that stays inside the area; after many tries shorter and shorter ones.
Stroke next_stroke(Vec2 place, const ImageArea& area, Dice& dice) {
    Stroke stroke = stroke_from(place, area, 1.0, dice);
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
            wave = {dice.between(8.0, 12.0), dice.between(0.0, 2.0 * kPi)};
        }
    }
    [[nodiscard]] double at(double t_s) const {
        double sum = 0.0;
        for (const Wave& wave : waves_) sum += std::sin(2.0 * kPi * wave.hertz * t_s + wave.phase);
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
            const Stroke stroke = next_stroke(place, area_, dice_);
            lay(stroke, stroke.duration_s, pressed_px, next_px);
            place = stroke.at(1.0);
            const bool lifts = dice_.between(0.0, 1.0) < 0.3;
            pressed_px = lifts ? -kLifted_px : next_px;
            Stroke pause;
            pause.centre = place;
            lay(pause, dice_.between(0.1, 0.4), next_px, pressed_px);
        }
        add_tremor();
        return std::move(motion_);
    }

  private:
    void lay(const Stroke& stroke, double duration_s, double from_px, double to_px) {
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

HandMotion modelled_hand(const ImageArea& area, int updates, std::uint64_t seed) {
    return HandModel(area, updates, seed).run();
}

}  // namespace dibhr
