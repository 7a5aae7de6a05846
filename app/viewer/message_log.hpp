// A log file of the messages that the window shows, with their times.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "app/viewer/task_group.hpp"

namespace dibhr {

/// Appends whole lines, written on another thread. For use by one thread.
class MessageLog {
  public:
    /// The task group must outlive it. Empty `file`: nothing is logged. Throws InputError where the
    /// file cannot be written, or is not such a log.
    MessageLog(std::filesystem::path file, TaskGroup& tasks);

    /// Adds one line: "2026-11-24 21:07:31.250 KIND: words".
    void append(std::string_view kind, std::string_view words);

    /// The same, unless the last line of that kind has the same words.
    void append_if_changed(const std::string& kind, const std::string& words);

    /// Once a turn: starts writing the new lines. Throws InputError, once, when that failed.
    void write();

    /// Waits, at most so long, until all lines are written. Ignores failures.
    void finish(std::chrono::milliseconds patience);

  private:
    std::filesystem::path file_;
    std::string waiting_{};
    std::map<std::string, std::string> last_{};  ///< by kind: the last words of append_if_changed()
    bool failed_{false};
    BackgroundTask<std::string> writing_;  // why writing failed; empty: it did not
};

}  // namespace dibhr
