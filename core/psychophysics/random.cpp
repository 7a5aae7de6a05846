// Random numbers of other distributions.
#include "core/psychophysics/random.hpp"

#include <cmath>

namespace dibhr {

std::uint32_t Random::below(std::uint32_t count) noexcept {
    const std::uint32_t uneven = (0U - count) % count;
    std::uint32_t drawn = bits();
    while (drawn < uneven) drawn = bits();
    return drawn % count;
}

double Random::normal() noexcept {
    double x = 0.0;
    double square = 0.0;
    do {
        x = 2.0 * uniform() - 1.0;
        const double y = 2.0 * uniform() - 1.0;
        square = x * x + y * y;
    } while (square >= 1.0 || square == 0.0);
    return x * std::sqrt(-2.0 * std::log(square) / square);
}

int Random::binomial(int trials, double probability) noexcept {
    int count = 0;
    for (int i = 0; i < trials; ++i) count += chance(probability) ? 1 : 0;
    return count;
}

}  // namespace dibhr
