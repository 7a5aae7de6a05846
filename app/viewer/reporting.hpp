// A report of a session, made while the window goes on.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// Runs `dibhr report` as a program of its own, at low priority, so that its time and memory do not
/// disturb the haptic loop. One at a time. It goes on when the window is closed.
class Reporting {
  public:
    Reporting() = default;
    ~Reporting();
    Reporting(const Reporting&) = delete;
    Reporting& operator=(const Reporting&) = delete;

    /// Makes a report in the folder SESSION-report beside the session. False while another one is
    /// being made. Throws InputError when the program cannot be started.
    bool start(const std::filesystem::path& session);

    [[nodiscard]] bool running() const { return child_ != 0; }

    /// The page of a finished report, without waiting. Throws InputError, once, when it failed.
    [[nodiscard]] std::optional<std::filesystem::path> take();

  private:
    void read_errors();

    std::filesystem::path page_{};
    std::string errors_{};  // from the child's stderr
    pid_t child_{0};        // 0: none is running
    int error_pipe_{-1};    // read end of the pipe
};

/// Opens a page in the desktop's browser; does nothing where there is none.
void show_in_browser(const std::filesystem::path& page);

}  // namespace dibhr
