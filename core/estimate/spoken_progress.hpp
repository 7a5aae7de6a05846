// How far a program says it is, in lines made for people: "7/24", "frame 7 of 24", bars.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace dibhr {

class SpokenProgress {
  public:
    /// What it has written, in pieces of any length.
    void take(const std::string& text);

    /// The last line that holds more than spaces, on one line; a bar that is drawn over itself
    /// counts as one.
    [[nodiscard]] const std::string& last_line() const noexcept { return last_; }

    /// "7/24" or "7 of 24" in the last lines, where it counts to `all`, or to one more or less;
    /// other counts are of other things, as of files that are loaded.
    [[nodiscard]] std::optional<std::size_t> done_of(std::size_t all) const;

  private:
    void note();  ///< what the line says, as far as it is there

    std::string line_{};
    std::string last_{};
    std::size_t done_{0}, of_{0};  ///< as last counted
};

}  // namespace dibhr
