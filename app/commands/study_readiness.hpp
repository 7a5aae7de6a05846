// Whether this machine and its device are ready for a study.
#pragma once

#include "core/study/protocol.hpp"

namespace dibhr {

/// Prints which device is attached, how punctual the clock is, and for each condition what a force
/// device makes of it: what is stiffer than it can stand, and the least stability margin. Takes a
/// second.
void print_readiness(const Protocol& protocol);

}  // namespace dibhr
