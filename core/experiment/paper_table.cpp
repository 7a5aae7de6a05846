// The paper's numbers.
#include "core/experiment/paper_table.hpp"

#include <array>

namespace dibhr {

namespace {

struct Entry {
    std::string_view path;
    Algorithm algorithm;
    PaperResult result;
};

constexpr std::array kTable{
    Entry{"linear", Algorithm::dibhr, {188.61, 0.0, 0.0}},
    Entry{"linear", Algorithm::pga, {43.38, 0.0, 0.0}},
    Entry{"linear", Algorithm::neighborhood, {159.22, 0.0, 0.0}},
    Entry{"circle", Algorithm::dibhr, {207.31, 0.53, 0.85}},
    Entry{"circle", Algorithm::pga, {47.40, 4.13, 6.77}},
    Entry{"circle", Algorithm::neighborhood, {161.31, 7.45, 10.48}},
    Entry{"human", Algorithm::dibhr, {94.21, 1.81, 4.13}},
    Entry{"human", Algorithm::pga, {80.97, 3.01, 7.97}},
    Entry{"human", Algorithm::neighborhood, {81.74, 4.74, 6.39}},
};

}  // namespace

std::optional<PaperResult> paper_result(std::string_view path, Algorithm algorithm) noexcept {
    for (const Entry& entry : kTable) {
        if (entry.path == path && entry.algorithm == algorithm) return entry.result;
    }
    return std::nullopt;
}

}  // namespace dibhr
