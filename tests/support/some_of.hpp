// Fewer cases under a sanitizer, where each takes many times as long.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tests/support/catch.hpp"

namespace dibhr {

/// A generator of all `cases`; under a sanitizer, whose errors any case can show, of the first
/// `few`.
template <typename Case>
[[nodiscard]] auto some_of(std::vector<Case> cases, std::size_t few) {
    if (DIBHR_SANITIZED) cases.resize(std::min(few, cases.size()));
    return Catch::Generators::from_range(cases);
}

}  // namespace dibhr
