// Colours for who reads at a terminal.
#pragma once

#include <string>
#include <string_view>

namespace dibhr {

/// Whether that descriptor is a terminal that shows colours, and nobody said NO_COLOR
/// (no-color.org: any value but an empty one).
[[nodiscard]] bool shows_colours(int descriptor);

enum class Paint { heading, error, warning };

/// For that descriptor; where it shows no colours, the text as it is.
[[nodiscard]] std::string painted(std::string_view text, Paint paint, int descriptor);

}  // namespace dibhr
