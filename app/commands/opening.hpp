// Opening the files of the command line beside the window.
#pragma once

#include <exception>
#include <memory>
#include <optional>

#include "app/viewer/opening_window.hpp"
#include "app/viewer/task_group.hpp"
#include "app/viewer/viewer.hpp"
#include "app/window/shutdown_watchdog.hpp"

namespace dibhr {

/// May wait for disk and network: not for the window's thread. Throws InputError, unless the window
/// opens without the files, too, and can open others.
[[nodiscard]] OpenedFiles open_files(const ViewOptions& options);

/// The window, `begin`: when the program started. Null: there is no display or no OpenGL, and
/// `trouble` is the error.
[[nodiscard]] std::unique_ptr<OpeningWindow> open_window(const ViewOptions& options,
                                                         OpeningWindow::Time begin,
                                                         std::exception_ptr& trouble);

/// The files, once they are open. Nothing: a person or a signal ended the program before. Throws
/// what open_files() threw. `window` may be null.
[[nodiscard]] std::optional<OpenedFiles> wait_for_files(BackgroundTask<OpenedFiles>& opening,
                                                        OpeningWindow* window,
                                                        const ShutdownWatchdog& shutdown);

}  // namespace dibhr
