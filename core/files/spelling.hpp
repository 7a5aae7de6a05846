// What somebody may have meant who mistyped a name.
#pragma once

#include <string>
#include <vector>

namespace dibhr {

/// The name that is reached from the word with the fewest letters changed, added, left away or
/// swapped with their neighbour, at most a third of them; empty: none is near.
[[nodiscard]] std::string nearest_name(const std::string& word,
                                       const std::vector<std::string>& names);

/// "; did you mean --friction?", or nothing.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& names);

}  // namespace dibhr
