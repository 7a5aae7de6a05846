// Step 5: counts at the end stops and over lengths measured with a ruler, and the thigh angle at
// count 0 that fits them (../README.md, Kinematics).
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "device/falcon/check/context.hpp"
#include "device/falcon/check/push.hpp"

namespace dibhr::falcon {

namespace {

constexpr double kMillimetres = 1000.0;  // in a metre

// ../README.md, Workspace; by libnifalcon's constants.
constexpr double kFullyOut_mm = 170.0;
constexpr double kFullyIn_mm = 75.0;

// The range of the setting.
constexpr double kLowestAngle_deg = 0.0;
constexpr double kHighestAngle_deg = 70.0;
constexpr double kAngleStep_deg = 0.05;

// A fit is too vague if an error of 1 mm on the ruler changes the angle by more than this.
constexpr double kMostUncertainty_deg = 3.0;
constexpr double kMostMisfit_mm = 3.0;

/// Martin & Hillier 2009, second-hand. The angle is 50 in the paper; the user who published the
/// constants measured 40.
Geometry martin_hillier(double angle_deg) {
    Geometry set;
    set.shin_end_d_m = set.shin_end_e_m = 0.0115;
    set.platform_radius_m = 0.0157;
    set.base_radius_m = 0.0366;
    set.platform_shift_m = 0.0262;
    set.base_shift_m = 0.0272;
    set.gear = 7.62;
    set.angle_at_zero_deg = angle_deg;
    return set;
}

struct Length {
    const char* name;
    Vec3 from_counts{0.0};
    Vec3 to_counts{0.0};
    double ruler_mm{0.0};
};

Geometry with_angle(Geometry geometry, double angle_deg) {
    geometry.angle_at_zero_deg = angle_deg;
    return geometry;
}

std::optional<Vec3> place_mm(Vec3 counts, const Geometry& geometry) {
    const auto place = place_of(counts, geometry);
    return place ? std::optional(*place * kMillimetres) : std::nullopt;
}

std::optional<double> length_mm(const Length& length, const Geometry& geometry) {
    const auto from = place_mm(length.from_counts, geometry);
    const auto to = place_mm(length.to_counts, geometry);
    return from && to ? std::optional(glm::distance(*from, *to)) : std::nullopt;
}

/// Root mean square error of the lengths [mm]; infinite where the grip could not be.
double misfit_mm(const std::vector<Length>& lengths, const Geometry& geometry) {
    double sum = 0.0;
    for (const Length& length : lengths) {
        const auto found = length_mm(length, geometry);
        if (!found) return std::numeric_limits<double>::infinity();
        sum += (*found - length.ruler_mm) * (*found - length.ruler_mm);
    }
    return std::sqrt(sum / static_cast<double>(lengths.size()));
}

/// The angle at count 0 that fits the ruler best.
struct Fit {
    double angle_deg{0.0};
    double misfit_mm{std::numeric_limits<double>::infinity()};
    double uncertainty_deg{std::numeric_limits<double>::infinity()};  ///< for 1 mm on the ruler

    [[nodiscard]] bool is_conclusive() const {
        return misfit_mm <= kMostMisfit_mm && uncertainty_deg <= kMostUncertainty_deg;
    }
};

Fit fit(const std::vector<Length>& lengths, const Geometry& geometry) {
    Fit best;
    for (double angle = kLowestAngle_deg; angle <= kHighestAngle_deg; angle += kAngleStep_deg) {
        const double misfit = misfit_mm(lengths, with_angle(geometry, angle));
        if (misfit < best.misfit_mm) best = {angle, misfit, best.uncertainty_deg};
    }
    double squared_slopes = 0.0;  // of the lengths over the angle
    for (const Length& length : lengths) {
        const auto more = length_mm(length, with_angle(geometry, best.angle_deg + 1.0));
        const auto less = length_mm(length, with_angle(geometry, best.angle_deg - 1.0));
        if (!more || !less) return best;
        const double slope = (*more - *less) / 2.0;
        squared_slopes += slope * slope;
    }
    if (squared_slopes > 0.0) best.uncertainty_deg = 1.0 / std::sqrt(squared_slopes);
    return best;
}

/// The angle at count 0 that puts these counts at height `z_mm`.
std::optional<double> angle_for_height(Vec3 counts, double z_mm, const Geometry& geometry) {
    std::optional<double> best;
    double least = 1.0;  // mm
    for (double angle = kLowestAngle_deg; angle <= kHighestAngle_deg; angle += kAngleStep_deg) {
        const auto place = place_mm(counts, with_angle(geometry, angle));
        if (!place || std::abs(place->z - z_mm) >= least) continue;
        least = std::abs(place->z - z_mm);
        best = angle;
    }
    return best;
}

Json or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

/// Positions and lengths of the counts, by one set of constants.
Json meaning_of(Vec3 out, Vec3 in, const std::vector<Length>& lengths, const Geometry& geometry) {
    const auto place_out = place_mm(out, geometry);
    const auto place_in = place_mm(in, geometry);
    Json part{{"angle_at_zero_deg", geometry.angle_at_zero_deg}};
    if (place_out) part["out_mm"] = as_json(*place_out);
    if (place_in) part["in_mm"] = as_json(*place_in);
    part["angle_if_out_is_at_170_mm_deg"] = or_null(angle_for_height(out, kFullyOut_mm, geometry));
    part["angle_if_in_is_at_75_mm_deg"] = or_null(angle_for_height(in, kFullyIn_mm, geometry));
    for (const Length& length : lengths) part[length.name] = or_null(length_mm(length, geometry));
    if (lengths.empty()) return part;
    const Fit fitted = fit(lengths, geometry);
    part["fitted_angle_deg"] = fitted.angle_deg;
    part["fit_misfit_mm"] = fitted.misfit_mm;
    part["fit_doubt_deg_per_mm"] = fitted.uncertainty_deg;
    return part;
}

Vec3 counts_where(CheckContext& context, const char* name, const std::string& question,
                  Json& measured) {
    context.word(question + " Enter = it is there, s = skip, q = quit");
    const CountsSample sample = sample_counts(context);
    measured[name] = {{"mean_counts", as_json(sample.mean)}, {"replies", sample.replies}};
    return sample.mean;
}

/// Asks for the ruler's number; leaves the length out when there is none.
void ask_length(CheckContext& context, Length length, const std::string& question,
                std::vector<Length>& lengths, Json& measured) {
    constexpr double kLongest_mm = 200.0;
    const auto ruler =
        context.number(question + " [mm] (Enter alone = not measured)", 1.0, kLongest_mm);
    if (!ruler) return;
    length.ruler_mm = *ruler;
    lengths.push_back(length);
    measured[std::string(length.name) + "_by_ruler"] = *ruler;
}

void record_answer(CheckContext& context, Vec3 out, Vec3 in, const std::vector<Length>& lengths) {
    const auto heights = [&](const Geometry& geometry) {
        const auto place_out = place_mm(out, geometry);
        const auto place_in = place_mm(in, geometry);
        return (place_out ? number_text(place_out->z, 1) : "?") + " and " +
               (place_in ? number_text(place_in->z, 1) : "?") + " mm";
    };
    const Geometry& ours = context.options.geometry;
    context.findings.record_answer(
        OpenQuestion::end_stops, "out " + number_text((out.x + out.y + out.z) / 3.0, 1) + ", in " +
                                     number_text((in.x + in.y + in.z) / 3.0, 1) +
                                     " counts on average: z " + heights(Geometry{}) +
                                     " by libnifalcon, " + heights(martin_hillier(40.0)) +
                                     " by Martin & Hillier at 40 degrees");
    if (lengths.empty()) return;
    const Fit fitted = fit(lengths, ours);
    const std::string found = number_text(fitted.angle_deg, 1) + " degrees by the ruler, +-" +
                              number_text(fitted.uncertainty_deg, 1) +
                              " for 1 mm, which misses the lengths by " +
                              number_text(fitted.misfit_mm, 1) + " mm";
    context.findings.record_answer(
        OpenQuestion::angle_at_zero,
        found + (fitted.is_conclusive() ? "" : ": too vague to be used"));
    if (fitted.is_conclusive())
        context.findings.set("angle-at-zero", number_text(fitted.angle_deg, 1));
}

}  // namespace

void check_stops(CheckContext& context, Json& measured) {
    home_with_person(context, measured);
    std::vector<Length> lengths;
    const Vec3 out =
        counts_where(context, "pulled_out",
                     "Pull the grip straight out to its stop, and hold it there.", measured);
    const Vec3 in =
        counts_where(context, "pushed_in",
                     "Push the grip straight in to its stop, and hold it there.", measured);
    ask_length(context, {"stop_to_stop_mm", out, in},
               "How far has the grip moved between the stops?", lengths, measured);
    const Vec3 left = counts_where(
        context, "left",
        "Half way out, lay a ruler across, and hold the grip at the ruler's left, some 3 cm left "
        "of the middle.",
        measured);
    const Vec3 right = counts_where(
        context, "right", "Hold the grip at the ruler's right, some 3 cm right of the middle.",
        measured);
    ask_length(context, {"left_to_right_mm", left, right}, "How far has it moved along the ruler?",
               lengths, measured);
    measured["by_the_settings"] = meaning_of(out, in, lengths, context.options.geometry);
    measured["by_libnifalcon"] = meaning_of(out, in, lengths, Geometry{});
    measured["by_martin_hillier_50"] = meaning_of(out, in, lengths, martin_hillier(50.0));
    measured["by_martin_hillier_40"] = meaning_of(out, in, lengths, martin_hillier(40.0));
    record_answer(context, out, in, lengths);
}

}  // namespace dibhr::falcon
