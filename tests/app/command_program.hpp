// Runs the real program from a test, in a folder of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr::test {

struct ProgramResult {
    int exit_code{-1};  ///< 128 + signal when it was killed
    std::string output{};
    std::string errors{};
};

/// A folder that goes away with the test; also the program's settings folder.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }
    /// Names of what is in it, sorted.
    [[nodiscard]] std::vector<std::string> names() const;

  private:
    std::filesystem::path path_{};
};

/// Runs `dibhr ARGUMENTS` inside `folder`, without a display and without a keyboard; `host`: a
/// program and its own arguments that starts it.
ProgramResult run_dibhr(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& host = {});

/// Runs a shell command inside `folder`; fails the test when it does not end with 0.
void run_shell(const TemporaryFolder& folder, const std::string& command);

void write_text(const std::filesystem::path& file, const std::string& text);
std::string read_text(const std::filesystem::path& file);

std::vector<std::string> split(const std::string& text, char separator);

/// A depth image whose level at column i is `first + slope * i`, as PNG.
void write_depth_png(const std::filesystem::path& file, int columns, int rows, int first,
                     int slope = 0);

}  // namespace dibhr::test
