// Near by where the picture is brighter, by the light in a tunnel, and by how slopes bend.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/video/depth/depth_guess.hpp"
#include "core/video/depth/mean_level.hpp"
#include "core/video/depth/slope_shape.hpp"

namespace dibhr {

namespace {

constexpr double kClear = 0.35;        ///< deviations by which areas must differ to count
constexpr double kFullyClear = 0.5;    ///< at twice these the sureness is nearly the highest
constexpr double kAllSides = 0.5;      ///< deviations between the middle and each side of a tunnel
constexpr double kSurestMiddle = 0.8;  ///< people and things in the middle, but also corridors
constexpr double kSurestFloor = 0.9;
constexpr double kSurenessOfTunnel = 0.6;  ///< of more than 8 bits: heights of things, too
constexpr double kSurenessOfTunnelIn8Bits = 0.8;
constexpr double kSurenessOfLitTunnel = 0.93;
constexpr double kSurestCustom = 0.93;
constexpr double kSurenessOfCustom = 0.87;
constexpr std::size_t kLeastSlopes = 400;
constexpr double kLeastBent = 0.7;            ///< share of the slopes that bend to one side
constexpr double kSurestBend = 0.98;          ///< insides of bowls bend the other way
constexpr double kLeastStraight = 0.78;       ///< share of slopes; others are no planes
constexpr double kSurenessOfStraight = 0.93;  ///< a shallow scene has straight distances, too
constexpr double kLeastPerspective = 0.05;
constexpr double kLeastProportional = 0.6;
constexpr double kLevelsInProportion = 0.2;  ///< their 0 seldom is the camera's place
constexpr std::size_t kMostForSlopes = 6;    ///< pictures

/// Mean levels of areas of the picture.
struct Places {
    Mean all{}, middle{}, border{}, floor{}, ceiling{};
    std::array<Mean, 4> sides{};  ///< narrow: left, right, upper, lower

    /// `x` and `y`: from the middle, in [-0.5, 0.5].
    void add(double x, double y, double level) {
        all.add(level);
        if (std::fabs(x) < 0.25 && std::fabs(y) < 0.25) middle.add(level);
        if (std::fabs(x) > 0.4 || y < -0.4) border.add(level);
        if (y > 0.3) floor.add(level);
        if (y < -0.3) ceiling.add(level);
        if (x < -0.4) sides[0].add(level);
        if (x > 0.4) sides[1].add(level);
        if (y < -0.4) sides[2].add(level);
        if (y > 0.4) sides[3].add(level);
    }

    /// By how many standard deviations one area is brighter than the other; 0: not known.
    [[nodiscard]] double brighter(const Mean& here, const Mean& there) const {
        const double deviation = all.count > 0.0 ? all.deviation() : 0.0;
        const bool both = here.count > 0.0 && there.count > 0.0 && deviation > 0.0;
        return both ? (here.value() - there.value()) / deviation : 0.0;
    }

    /// 1: the middle is brighter than each side, by `least` deviations, -1: it is darker than
    /// each, 0: neither.
    [[nodiscard]] int brighter_than_sides(double least) const {
        const auto all_are = [&](double sign) {
            return std::all_of(sides.begin(), sides.end(), [&](const Mean& side) {
                return sign * brighter(middle, side) > least;
            });
        };
        return all_are(1.0) ? 1 : all_are(-1.0) ? -1 : 0;
    }
};

template <typename IsData>
Places places_of(const std::vector<LevelLattice>& lattices, const IsData& is_data) {
    Places places;
    for (const LevelLattice& lattice : lattices) {
        auto level = lattice.levels.begin();
        for (int j = 0; j < lattice.rows; ++j) {
            for (int i = 0; i < lattice.columns; ++i, ++level) {
                if (is_data(*level))
                    places.add((i + 0.5) / lattice.columns - 0.5, (j + 0.5) / lattice.rows - 0.5,
                               *level);
            }
        }
    }
    return places;
}

/// The row on an area that is brighter or darker than another by so many standard deviations.
void add_row_on_area(double deviations, double surest, const std::string& areas, Findings& rows) {
    if (std::fabs(deviations) < kClear) return;
    const bool brighter = deviations > 0.0;
    const double clear = 1.0 - std::exp(-std::fabs(deviations) / kFullyClear);
    rows.push_back({{.near = brighter ? NearLevels::bright : NearLevels::dark},
                    Evidence::numbers,
                    0.5 + (surest - 0.5) * clear,
                    areas + " by " + short_text(std::fabs(deviations), 2) +
                        " standard deviations, " + (brighter ? "brighter" : "darker")});
}

bool has_perspective(const SlopeShape& shape) {
    return shape.perspective > kLeastPerspective;
}

/// The larger share of the slopes, of those that bend up and down.
double bent_share(const SlopeShape& shape) {
    return std::max(shape.convex, 1.0 - shape.convex);
}

/// The row on what 8 bits are by custom. It is less sure of a scene, as a camera sees it, where
/// many slopes could say otherwise and do not; heights without outlines are near white as a rule.
Finding finding_on_custom(const SlopeShape& shape, bool has_outlines) {
    const bool is_undecided = has_outlines && shape.slopes >= kLeastSlopes &&
                              shape.straight <= kLeastStraight && bent_share(shape) < kLeastBent;
    return {{.near = NearLevels::bright},
            Evidence::numbers,
            is_undecided ? kSurenessOfCustom : kSurestCustom,
            std::string("by custom 8 bits are near white") +
                (is_undecided ? ", but slopes bend both ways" : "")};
}

/// The rows on how slopes bend, where they do.
void add_rows_on_slopes(const SlopeShape& shape, int bits, Findings& rows) {
    if (shape.slopes < kLeastSlopes) return;
    const auto percent = [](double share) { return short_text(100.0 * share, 2) + " %"; };
    if (shape.straight > kLeastStraight && has_perspective(shape))
        return rows.push_back({{.near = NearLevels::bright},
                               Evidence::numbers,
                               kSurenessOfStraight,
                               percent(shape.straight) +
                                   " of the slopes are straight, as where levels are one over the "
                                   "distance"});
    const double bent = bent_share(shape);
    if (bent < kLeastBent) return;
    const bool is_convex = shape.convex > 0.5;
    rows.push_back({{.near = is_convex ? NearLevels::dark : NearLevels::bright},
                    Evidence::numbers,
                    0.5 + (kSurestBend - 0.5) * (2.0 * bent - 1.0),
                    percent(bent) + " of the slopes bend as " +
                        (is_convex ? "distances" : "nearness") +
                        " of planes and of convex things"});
    if (bits > 8 && shape.proportional > kLeastProportional && has_perspective(shape))
        rows.push_back(
            {{.unit = DepthUnit::levels},
             Evidence::numbers,
             kLevelsInProportion,
             percent(shape.proportional) + " of the slopes bend as distances from the camera"});
}

}  // namespace

int SampledLevels::middle_brighter_than_sides() const {
    constexpr double kLeast = 0.25;  // the light may be faint
    const auto has_level = [this](float level) { return is_data(level); };
    return places_of(lattices_, has_level).brighter_than_sides(kLeast);
}

Findings SampledLevels::near(std::optional<int> middle_of_colour) const {
    Findings rows;
    const SlopeShape slopes = slope_shape();
    if (bits_ == 8) rows.push_back(finding_on_custom(slopes, has_outlines()));
    add_rows_on_slopes(slopes, bits_, rows);
    const Places places = places_of(lattices_, [this](float level) { return is_data(level); });
    const int than_sides = places.brighter_than_sides(kAllSides);
    const NearLevels of_tunnel = than_sides > 0 ? NearLevels::dark : NearLevels::bright;
    if (than_sides != 0 && middle_of_colour.value_or(0) < 0)
        rows.push_back(
            {{.near = of_tunnel},
             Evidence::numbers,
             kSurenessOfLitTunnel,
             "the middle of the colour picture is darker than all four sides, as the end "
             "of a tunnel that is lit from the camera"});
    if (than_sides > 0 && !middle_of_colour)
        rows.push_back({{.near = of_tunnel},
                        Evidence::numbers,
                        bits_ == 8 ? kSurenessOfTunnelIn8Bits : kSurenessOfTunnel,
                        "the middle is brighter than all four sides, as the end of a tunnel"});
    if (than_sides != 0) return rows;  // neither floor nor things in the middle are seen
    add_row_on_area(places.brighter(places.middle, places.border), kSurestMiddle,
                    "the middle differs from the border", rows);
    add_row_on_area(places.brighter(places.floor, places.ceiling), kSurestFloor,
                    "the lower part differs from the upper", rows);
    return rows;
}

SlopeShape SampledLevels::slope_shape() const {
    SlopeMeter meter;
    const std::size_t step = 1 + lattices_.size() / kMostForSlopes;
    for (std::size_t k = 0; k < lattices_.size(); k += step) {
        const LevelLattice& lattice = lattices_[k];
        std::vector<float> levels = lattice.levels;
        for (float& level : levels)
            if (!is_data(level)) level = std::numeric_limits<float>::quiet_NaN();
        meter.add(lattice.columns, lattice.rows, levels);
    }
    return meter.shape();
}

}  // namespace dibhr
