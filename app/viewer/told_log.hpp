// Keeps in a file, with their time, the lines that a person is told.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "app/viewer/errand.hpp"

namespace dibhr {

/// Written away from the window's thread, whole lines, behind those that the file has. For one
/// thread.
class ToldLog {
  public:
    /// `errands` outlive it. Empty: nothing is kept. Throws InputError where the file cannot be
    /// written, or is something else than such lines.
    ToldLog(std::filesystem::path file, Errands& errands);

    /// One line: "2026-11-24 21:07:31.250 KIND: words".
    void keep(std::string_view kind, std::string_view words);

    /// The same, unless those words were kept last of that kind.
    void keep_change(const std::string& kind, const std::string& words);

    /// Once a picture: has written what was kept since. Throws InputError, once.
    void write();

    /// Waits, at most so long, until all is written. What cannot be is missed by nobody.
    void finish(std::chrono::milliseconds patience);

  private:
    std::filesystem::path file_;
    std::string waiting_{};
    std::map<std::string, std::string> last_{};  ///< of a kind whose changes are kept
    bool failed_{false};
    Errand<std::string> writing_;  // why it could not; empty: it could
};

}  // namespace dibhr
