// Tables, in Markdown, of what cleaning and motion do to scenes of our own making: small shapes and
// noise, outlines and flat ground, plain things that move.
#pragma once

#include <string>
#include <vector>

namespace dibhr::bench {

/// "detail", "outlines" and "discs".
[[nodiscard]] std::vector<std::string> feel_scenes();

/// Prints the tables of these scenes, each row as it is measured. Same scenes, same numbers.
void print_feel_scenes(const std::vector<std::string>& scenes,
                       const std::vector<std::string>& cleanings);

}  // namespace dibhr::bench
