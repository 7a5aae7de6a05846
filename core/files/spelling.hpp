// What somebody may have meant who mistyped a name.
#pragma once

#include <string>
#include <vector>

namespace dibhr {

/// "; did you mean --friction?": the name that is reached from the word with the fewest letters
/// changed, added, left away or swapped with their neighbour, at most a third of them. Empty: none
/// is near.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& names);

}  // namespace dibhr
