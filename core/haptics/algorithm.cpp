// Names of the proxy algorithms.
#include "core/haptics/algorithm.hpp"

#include <array>
#include <cstddef>

namespace dibhr {

namespace {

constexpr std::array<Word<Algorithm>, 4> kWords{{
    {Algorithm::dibhr, "dibhr", "DIBHR"},
    {Algorithm::pga, "pga", "Proxy graph (PGA)"},
    {Algorithm::neighborhood, "neighborhood", "Neighborhood"},
    {Algorithm::god_object, "god-object", "God-object"},
}};
static_assert(has_all_in_order(kWords, Algorithm::god_object));

constexpr auto kAlgorithms = [] {
    std::array<Algorithm, kWords.size()> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = kWords[k].value;
    return all;
}();

}  // namespace

std::span<const Algorithm> all_algorithms() noexcept {
    return kAlgorithms;
}

std::span<const Word<Algorithm>> algorithm_words() noexcept {
    return kWords;
}

const char* name_of(Algorithm algorithm) noexcept {
    return entry_of(kWords, algorithm).name;
}

std::optional<Algorithm> algorithm_named(std::string_view name) noexcept {
    return value_named(kWords, name);
}

}  // namespace dibhr
