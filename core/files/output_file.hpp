// An output file that appears whole or not at all; "-" is standard output.
#pragma once

#include <filesystem>
#include <string_view>

namespace dibhr {

/// Whoever read standard output has enough: the program ends quietly.
struct OutputClosed {};

/// What is written goes to a file beside the target, which takes the target's place at commit().
/// Without commit() nothing remains and an existing target stays as it was. A target that is no
/// ordinary file (a pipe, /dev/null) is written directly.
class OutputFile {
  public:
    /// Throws InputError when the target cannot be written.
    explicit OutputFile(const std::filesystem::path& target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Throws InputError, e.g. when the disk is full, and OutputClosed when the reading end is
    /// gone.
    void write(std::string_view bytes);

    /// Throws InputError when the target cannot be replaced.
    void commit();

  private:
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path target_;
    std::filesystem::path temporary_{};  ///< empty when written directly
    int file_{-1};
    bool owned_{false};
};

}  // namespace dibhr
