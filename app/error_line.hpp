// How the program says what went wrong: one line on stderr.
#pragma once

#include <string_view>

namespace dibhr {

/// "dibhr: `message`"; line breaks in it become spaces.
void print_error_line(std::string_view message);

}  // namespace dibhr
