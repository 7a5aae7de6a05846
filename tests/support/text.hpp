// What tests ask of a text.
#pragma once

#include <string>

#include "tests/support/catch.hpp"

namespace dibhr::test {

/// A text that does not contain the part is told with the test's next failure.
[[nodiscard]] inline bool contains(const std::string& text, const std::string& part) {
    const bool found = text.find(part) != std::string::npos;
    if (!found) UNSCOPED_INFO(text);
    return found;
}

}  // namespace dibhr::test
