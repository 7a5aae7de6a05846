// Finds the command that the arguments name, parses its options and runs it.
#pragma once

#include <string>
#include <vector>

namespace dibhr {

/// `arguments` without the program's own name. The exit code of the command; throws UsageError for
/// wrong arguments, Error for what the command could not do.
int run_command_line(const std::vector<std::string>& arguments);

}  // namespace dibhr
