// The desktop's dialog for opening files: one at a time; a thread of its own waits for it.
#pragma once

#include <memory>
#include <optional>

#include "app/desktop/call_off.hpp"
#include "app/desktop/file_dialog.hpp"
#include "app/viewer/errand.hpp"

namespace dibhr {

/// For the window's thread; no function waits.
class DesktopDialog {
  public:
    /// The task group must outlive it.
    explicit DesktopDialog(Errands& errands) : asking_(errands) {}
    /// Closes an open dialog.
    ~DesktopDialog() { call_off(); }
    DesktopDialog(const DesktopDialog&) = delete;
    DesktopDialog& operator=(const DesktopDialog&) = delete;

    [[nodiscard]] bool open() const { return off_ != nullptr; }

    /// Opens the dialog; only while none is open. Same folder and file types as the window's own.
    void ask(const std::filesystem::path& folder, unsigned long x11_window);

    /// The answer, once; nothing before it comes, and nothing after call_off().
    [[nodiscard]] std::optional<FileAnswer> take();

    void call_off();

  private:
    std::shared_ptr<CallOff> off_{};  // shared with the thread that waits; null: none is open
    Errand<FileAnswer> asking_;
};

}  // namespace dibhr
