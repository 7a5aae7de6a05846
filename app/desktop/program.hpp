// Starts other programs, without a shell.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace dibhr {

/// Where what it prints goes: descriptors; negative: nowhere.
struct ProgramOutput {
    int output{-1};
    int errors{-1};
};

/// Starts a program, found on PATH, as the first of a group of processes of its own, with nothing
/// to read. 0: it could not be started.
[[nodiscard]] pid_t start_program(std::vector<std::string> words, const ProgramOutput& printed);

}  // namespace dibhr
