// The desktop's dialog for opening files, beside the window: one at a time, waited for by a thread
// of its own.
#pragma once

#include <memory>
#include <optional>

#include "app/desktop/call_off.hpp"
#include "app/desktop/file_dialog.hpp"
#include "app/viewer/errand.hpp"

namespace dibhr {

/// For the window's thread, which never waits here.
class DesktopDialog {
  public:
    /// `errands` outlive it.
    explicit DesktopDialog(Errands& errands) : asking_(errands) {}
    /// Nobody wants to know any more: the dialog goes away.
    ~DesktopDialog() { call_off(); }
    DesktopDialog(const DesktopDialog&) = delete;
    DesktopDialog& operator=(const DesktopDialog&) = delete;

    [[nodiscard]] bool open() const { return off_ != nullptr; }

    /// Only while none is open. What it begins with and lists is that of the window's own.
    void ask(const std::filesystem::path& folder, unsigned long x11_window);

    /// The answer, once; nothing while there is none. None comes after call_off().
    [[nodiscard]] std::optional<FileAnswer> take();

    void call_off();

  private:
    std::shared_ptr<CallOff> off_{};  // also the asking thread's; null: none is open
    Errand<FileAnswer> asking_;
};

}  // namespace dibhr
