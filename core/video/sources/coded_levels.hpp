// Decodes depth in levels that are no distances (level_code.hpp); inside the room.
#pragma once

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

/// Decodes the levels of the code that is stated; else, if it may `find_out`, of that of its data
/// set or of its numbers, unless the statement says what the file's own levels mean. Throws
/// InputError where it has no levels of the stated code.
void decode_levels(Sources& sources, const DepthStatement& statement, bool find_out);

}  // namespace dibhr
