// Sliders for the entries of the table of touch parameters.
#pragma once

#include "core/haptics/parameter_table.hpp"

namespace dibhr {

/// A row for each number of that topic, with its label, unit, range and help.
void draw_numbers(TouchTopic topic, TouchParameters& parameters);

}  // namespace dibhr
