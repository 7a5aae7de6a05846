// Suggests a name for a mistyped one.
#pragma once

#include <string>
#include <vector>

namespace dibhr {

/// "; did you mean --friction?": the name with the fewest letters changed, added, removed or
/// swapped with their neighbour, at most a third of them. Empty: no name is near.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& names);

/// "is none of dibhr, pga; did you mean dibhr?", of a word that is none of the names.
[[nodiscard]] std::string none_of(const std::string& word, const std::vector<std::string>& names);

}  // namespace dibhr
