// The desktop's dialog for opening files: one at a time; a thread of its own waits for it.
#pragma once

#include <memory>
#include <optional>

#include "app/desktop/cancellation.hpp"
#include "app/desktop/file_dialog.hpp"
#include "app/viewer/task_group.hpp"

namespace dibhr {

/// For the window's thread; no function waits.
class DesktopDialog {
  public:
    /// The task group must outlive it.
    explicit DesktopDialog(TaskGroup& tasks) : asking_(tasks) {}
    /// Closes an open dialog.
    ~DesktopDialog() { cancel(); }
    DesktopDialog(const DesktopDialog&) = delete;
    DesktopDialog& operator=(const DesktopDialog&) = delete;

    [[nodiscard]] bool open() const { return cancellation_ != nullptr; }

    /// Opens the dialog; only while none is open. Same folder and file types as the window's own.
    void ask(const std::filesystem::path& folder, unsigned long x11_window);

    /// The answer, once; nothing before it comes, and nothing after cancel().
    [[nodiscard]] std::optional<FileAnswer> take();

    void cancel();

  private:
    std::shared_ptr<Cancellation>
        cancellation_{};  // shared with the thread that waits; null: none is open
    BackgroundTask<FileAnswer> asking_;
};

}  // namespace dibhr
