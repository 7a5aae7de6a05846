// `dibhr info`: what a media or session file holds.
#pragma once

#include <filesystem>
#include <vector>

namespace dibhr {

/// Describes each file on standard output; says on stderr, in one line each, which could not be
/// read. 0 when all could be, else 1.
int run_info(const std::vector<std::filesystem::path>& files);

}  // namespace dibhr
