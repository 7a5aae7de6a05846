// Names of the proxy algorithms.
#include "core/haptics/algorithm.hpp"

#include <array>

namespace dibhr {

namespace {

constexpr std::array kAlgorithms{Algorithm::dibhr, Algorithm::pga, Algorithm::neighborhood,
                                 Algorithm::god_object};

}  // namespace

std::span<const Algorithm> all_algorithms() noexcept {
    return kAlgorithms;
}

const char* name_of(Algorithm algorithm) noexcept {
    switch (algorithm) {
        case Algorithm::dibhr:
            break;
        case Algorithm::pga:
            return "pga";
        case Algorithm::neighborhood:
            return "neighborhood";
        case Algorithm::god_object:
            return "god-object";
    }
    return "dibhr";
}

std::optional<Algorithm> algorithm_named(std::string_view name) noexcept {
    for (const Algorithm algorithm : kAlgorithms) {
        if (name == name_of(algorithm)) return algorithm;
    }
    return std::nullopt;
}

}  // namespace dibhr
