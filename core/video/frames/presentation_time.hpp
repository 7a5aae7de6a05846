// Presentation times of pictures and frames, compared.
#pragma once

#include <optional>
#include <utility>

namespace dibhr {

/// Containers round times to milliseconds: a time asked for matches a frame's within half of one.
inline constexpr double kTimeTolerance_s = 0.0005;

/// Of the items that `source.next()` gives the first that is not before `earliest_s`, or the last.
template <typename Source, typename Item>
std::optional<Item> first_from(double earliest_s, Source& source, double Item::*time_s) {
    std::optional<Item> first = source.next();
    while (first && (*first).*time_s < earliest_s) {
        std::optional<Item> later = source.next();
        if (!later) break;
        first = std::move(later);
    }
    return first;
}

}  // namespace dibhr
