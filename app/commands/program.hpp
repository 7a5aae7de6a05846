// The program as a function, for its main() and for the tests' build of it.
#pragma once

#include "app/commands/command_line.hpp"

namespace dibhr {

/// Runs the command line. The exit code: 0 on success, 1 on a failure, which is printed as one line
/// on stderr, 2 on bad usage. Changes the process's streams and its heap, so only main() may call
/// it.
int run_program(int argc, char** argv, const PictureHook& after_picture = {});

}  // namespace dibhr
