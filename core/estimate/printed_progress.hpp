// Reads the progress of a program from the lines that it prints: "7/24", "frame 7 of 24", bars.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace dibhr {

class PrintedProgress {
  public:
    /// Takes the program's output, in pieces of any length.
    void take(const std::string& text);

    /// The last line that is not blank; each state of a redrawn bar counts as a line.
    [[nodiscard]] const std::string& last_line() const noexcept { return last_; }

    /// 7 of "7/24" or "7 of 24" in the last lines, if its total is `all`, or one more or less.
    /// Other totals belong to other work, as files that are loaded.
    [[nodiscard]] std::optional<std::size_t> done_of(std::size_t all) const;

  private:
    void note();  ///< reads the present line, as far as it has arrived

    std::string line_{};
    std::string last_{};
    std::size_t done_{0}, of_{0};  ///< of the last count
};

}  // namespace dibhr
