// Reading, writing and checking text in tests.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "tests/support/catch.hpp"

namespace dibhr::test {

inline void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// All of a file, byte for byte; empty when it cannot be read.
[[nodiscard]] inline std::string read_text(const std::filesystem::path& file) {
    std::ostringstream text;  // by blocks: byte by byte it takes seconds where nothing is optimised
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return std::move(text).str();
}

/// A text that does not contain the part is printed with the test's next failure.
[[nodiscard]] inline bool contains(const std::string& text, const std::string& part) {
    const bool found = text.find(part) != std::string::npos;
    if (!found) UNSCOPED_INFO(text);
    return found;
}

}  // namespace dibhr::test
