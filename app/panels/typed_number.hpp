// A number that is typed into a row of the panels.
#pragma once

#include <functional>

namespace dibhr {

/// A slider or drag of ImGui, named `name`, that `draw` draws; what is typed into it is read here.
/// Its decimal sign is a point or a comma: ImGui leaves the comma out, and so makes 7 of 0,7. Text
/// that is no number leaves the value as it was before. Returns whether a number is being typed.
bool number_item(const char* name, const char* format, double& value,
                 const std::function<void()>& draw);

}  // namespace dibhr
