// Output of `dibhr study check`: a summary of the study, and whether this machine and its device
// are ready for it.
#pragma once

#include "core/study/protocol.hpp"

namespace dibhr {

/// Prints conditions, blocks, trials and minutes, and warns of possible mistakes.
void print_protocol(const Protocol& protocol);

/// Prints which device is attached, how late ticks are, for each attached kind of force device the
/// conditions that exceed its stiffness and the least stability margin (of the others in one line),
/// and in the last line whether the study can be run here. Takes a second.
void print_readiness(const Protocol& protocol);

}  // namespace dibhr
