// What `dibhr study check` says: what a study will be, and whether this machine and its device are
// ready for it.
#pragma once

#include "core/study/protocol.hpp"

namespace dibhr {

/// Prints conditions, blocks, trials and minutes, and what of it may not be meant.
void print_protocol(const Protocol& protocol);

/// Prints which device is attached, how punctual the clock is, and for each condition what a force
/// device makes of it: what is stiffer than it can stand, and the least stability margin. Takes a
/// second.
void print_readiness(const Protocol& protocol);

}  // namespace dibhr
