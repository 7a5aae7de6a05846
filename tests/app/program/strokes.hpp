// What the program recorded of a force device, touched again by the program's own `dibhr touch`.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/app/program/desk.hpp"

namespace dibhr::test {

struct TouchedAgain {
    std::size_t contacts{0};   ///< ticks with more than 0.2 N
    std::size_t held_back{0};  ///< by friction, while it slides to the right
    double worst_newton{0.0};  ///< by which a spring force differs
};

/// The strokes over the sample of which the goals and the file are all there is.
[[nodiscard]] TouchedAgain touched_again(const std::vector<Row>& rows);

/// The longest force that was sent [N].
[[nodiscard]] double strongest(const std::vector<Row>& rows);

}  // namespace dibhr::test
