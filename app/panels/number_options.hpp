// A slider for an entry of the option table.
#pragma once

#include <string_view>

#include "core/haptics/parameters.hpp"

namespace dibhr {

/// Draws the row of the option called `name`, with its label, unit, range and help.
void draw_option(std::string_view name, TouchParameters& parameters);

}  // namespace dibhr
