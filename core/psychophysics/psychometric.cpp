// The functions themselves.
#include "core/psychophysics/psychometric.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/psychophysics/curves.hpp"

namespace dibhr {

const char* name_of(Curve curve) noexcept {
    switch (curve) {
        case Curve::cumulative_gaussian:
            return "cumulative Gaussian";
        case Curve::weibull:
            return "Weibull";
        case Curve::logistic:
            break;
    }
    return "logistic";
}

double PsychometricFunction::share(double x) const {
    const double u =
        (to_axis(curve, x) - to_axis(curve, threshold)) / scale + standard_quantile(curve, level);
    return guess + (1.0 - guess - lapse) * standard_curve(curve, u).share;
}

double PsychometricFunction::slope() const {
    const double density = standard_curve(curve, standard_quantile(curve, level)).density;
    return density / scale / (curve == Curve::weibull ? threshold : 1.0);
}

void add_answer(LevelCounts& counts, double x, bool hit) {
    constexpr double kSame = 1e-9;  // a staircase that goes up and down again comes back so near
    auto found = std::find_if(counts.begin(), counts.end(), [x](const LevelCount& level) {
        return std::abs(level.x - x) <= kSame * std::abs(x);
    });
    if (found == counts.end()) found = counts.insert(counts.end(), LevelCount{x, {}});
    ++found->count.trials;
    found->count.hits += hit ? 1 : 0;
}

Simulate same_levels(LevelCounts counts) {
    return [counts = std::move(counts)](const PsychometricFunction& person, Random& random) {
        LevelCounts drawn = counts;
        for (LevelCount& level : drawn) {
            level.count.hits = random.binomial(level.count.trials, person.share(level.x));
        }
        return drawn;
    };
}

}  // namespace dibhr
