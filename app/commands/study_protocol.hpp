// What a study will be, as `dibhr study check` says it.
#pragma once

#include "core/study/protocol.hpp"

namespace dibhr {

/// Prints conditions, blocks, trials and minutes, and what of it may not be meant.
void print_protocol(const Protocol& protocol);

}  // namespace dibhr
