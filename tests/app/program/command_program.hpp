// Runs the real program from a test, in a folder of its own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

struct ProgramResult {
    int exit_code{-1};  ///< 128 + signal when it was killed
    std::string output{};
    std::string errors{};
    std::size_t peak_memory_bytes{0};  ///< resident
    double cpu_s{0.0};                 ///< of all its threads
};

/// Runs `dibhr ARGUMENTS` inside `folder`, which has its settings and its data, too, without a
/// display and without a keyboard. It is forked from a process that has loaded it, or, with a
/// `host`, a program and its own arguments, started by that.
ProgramResult run_dibhr(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& host = {});

/// What it says at a terminal, both streams; `environment`: "NAME=value" on top of this process's.
std::string run_dibhr_at_terminal(const TemporaryFolder& folder,
                                  const std::vector<std::string>& arguments,
                                  const std::vector<std::string>& environment);

/// Runs a shell command inside `folder`; fails the test when it does not end with 0.
void run_shell(const TemporaryFolder& folder, const std::string& command);

std::vector<std::string> split(const std::string& text, char separator);

/// A depth image whose level at column i is `first + slope * i`, as PNG.
void write_depth_png(const std::filesystem::path& file, int columns, int rows, int first,
                     int slope = 0);

}  // namespace dibhr::test
