// The machine that a check runs on.
#pragma once

#include "core/files/json.hpp"

namespace dibhr {

/// Its system, kernel, processor and their number; what cannot be found out is left out.
[[nodiscard]] Json machine_facts();

}  // namespace dibhr
