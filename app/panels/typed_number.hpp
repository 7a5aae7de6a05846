// A number that is typed into a row of the panels.
#pragma once

#include <functional>

namespace dibhr {

/// A slider or drag of ImGui, named `name`, drawn by `draw`. A number typed into it is read here,
/// with decimal point or comma: ImGui ignores a comma, and so reads 0,7 as 7. A text that is no
/// number leaves the value unchanged. Returns whether a number is being typed.
bool number_item(const char* name, const char* format, double& value,
                 const std::function<void()>& draw);

}  // namespace dibhr
