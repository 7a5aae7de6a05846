// What the program recorded of a force device, touched again by the program's own `dibhr touch`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/app/program/desk.hpp"

namespace dibhr::test {

/// What there is to compare: ticks of the strokes over the sample of which the goals and the file
/// are all there is.
struct Stroked {
    std::size_t contacts{0};   ///< ticks with more than 0.2 N
    std::size_t held_back{0};  ///< by friction, while it slides to the right
};
[[nodiscard]] Stroked stroked(const std::vector<Row>& rows);

/// By how much the spring forces of those strokes differ at most from those of `dibhr touch` with
/// the spring that the device could stand [N].
[[nodiscard]] double worst_touched_again(const std::vector<Row>& rows);

/// The longest force that was sent [N].
[[nodiscard]] double strongest(const std::vector<Row>& rows);

}  // namespace dibhr::test
