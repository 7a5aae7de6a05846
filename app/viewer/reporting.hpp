// A report of a session, made while the window goes on.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// Runs `dibhr report` as a program of its own, at low priority: its hours of ticks and its memory
/// are none of the hand's. One at a time; it ends its work also when the window is closed.
class Reporting {
  public:
    Reporting() = default;
    ~Reporting();
    Reporting(const Reporting&) = delete;
    Reporting& operator=(const Reporting&) = delete;

    /// Into the folder SESSION-report beside the session. Gives back whether it could: one that is
    /// under way is not disturbed. Throws InputError when no program can be started.
    bool start(const std::filesystem::path& session);

    /// The page of one that is done, without waiting. Throws InputError, once, when it failed.
    [[nodiscard]] std::optional<std::filesystem::path> take();

  private:
    void take_what_is_said();

    std::filesystem::path page_{};
    std::string said_{};  // on its stderr
    pid_t child_{0};      // 0: none is under way
    int said_end_{-1};    // of the pipe
};

/// Shows a page in the browser, where the desktop has one; says nothing where it has not.
void show_in_browser(const std::filesystem::path& page);

}  // namespace dibhr
