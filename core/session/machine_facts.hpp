// What a recording says of the machine it was made on.
#pragma once

#include "core/session/session_parts.hpp"

namespace dibhr {

/// "machine-cpu", "machine-kernel" and "machine-system"; what cannot be found out is left out.
[[nodiscard]] SessionFacts machine_facts();

}  // namespace dibhr
