// A report of a session, made while the window goes on.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <filesystem>
#include <future>
#include <optional>
#include <string>

namespace dibhr {

/// Runs `dibhr report` as a program of its own, at low priority: its hours of ticks and its memory
/// are none of the hand's. One at a time.
class Reporting {
  public:
    Reporting() = default;
    ~Reporting();
    Reporting(const Reporting&) = delete;
    Reporting& operator=(const Reporting&) = delete;

    /// Into the folder SESSION-report beside the session. Gives back whether it could: one that is
    /// under way is not disturbed. Throws InputError when no program can be started.
    bool start(const std::filesystem::path& session);

    /// The page of one that is done. Throws InputError, once, when it failed.
    [[nodiscard]] std::optional<std::filesystem::path> take();

  private:
    std::future<std::filesystem::path> page_{};
    std::atomic<pid_t> running_{0};  // 0: none
};

/// Shows a page in the browser, where the desktop has one; says nothing where it has not.
void show_in_browser(const std::filesystem::path& page);

}  // namespace dibhr
