// Starts other programs, without a shell.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace dibhr {

/// Descriptors for the program's stdout and stderr; negative: discarded.
struct ProgramOutput {
    int output{-1};
    int errors{-1};
};

/// Starts a program, found on PATH, in a process group of its own, with an empty stdin. 0: it could
/// not be started.
[[nodiscard]] pid_t start_program(std::vector<std::string> command, const ProgramOutput& printed);

}  // namespace dibhr
