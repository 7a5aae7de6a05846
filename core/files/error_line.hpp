// How the program says on a terminal what went wrong: one line on stderr.
#pragma once

#include <string>
#include <string_view>

namespace dibhr {

/// Whatever a file says, on one line and without what a terminal would obey.
[[nodiscard]] std::string one_line(std::string_view text);

/// "dibhr: `message`", on one line.
void print_error_line(std::string_view message);
/// "dibhr: warning: `sentence`", on one line; nothing for an empty one.
void print_warning(std::string_view sentence);

}  // namespace dibhr
