// The desktop's own dialog for opening files: through its portal, else through a helper program,
// each in a process of its own.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "app/desktop/cancellation.hpp"

namespace dibhr {

/// A kind of files that the dialog can list.
struct FileFilter {
    std::string name{};                   ///< "All files"
    std::vector<std::string> patterns{};  ///< "*.mp4", as a shell has them
};

struct FileQuestion {
    std::string title{};
    std::filesystem::path folder{};     ///< where to begin; absolute
    std::vector<FileFilter> filters{};  ///< the first one is active
    unsigned long x11_window{0};        ///< the dialog stays above it; 0: not known
};

struct FileAnswer {
    enum class Outcome {
        unavailable,  ///< no such dialog, or it was lost or did not answer
        cancelled,    ///< by the person, or by Cancellation
        chosen
    };
    Outcome outcome{Outcome::unavailable};
    std::vector<std::filesystem::path> files{};  ///< chosen, at least one; absolute
};

/// How long to wait for the desktop.
struct DialogTimeouts {
    std::chrono::milliseconds bus{2000};     ///< the session bus, to take the connection
    std::chrono::milliseconds portal{2000};  ///< the portal, to accept the request
    /// No person answers more quickly: a quicker answer is the desktop's refusal.
    std::chrono::milliseconds shortest_human_reply{300};
};

/// Whether there is a desktop: a session bus that belongs to the window's screen. Checks the
/// environment only.
[[nodiscard]] bool has_desktop();

/// Waits for the person or for cancel(), so call it on a thread that may wait. Uses the portal,
/// or else a helper program.
[[nodiscard]] FileAnswer ask_desktop(const FileQuestion& question,
                                     const Cancellation& cancellation);

// The two ways of ask_desktop().

/// org.freedesktop.portal.FileChooser on the session bus. Outcome::unavailable within a few seconds
/// if there is no portal, or it does not reply or refuses; later, if it is lost. cancel() closes
/// the dialog.
[[nodiscard]] FileAnswer ask_portal(const FileQuestion& question, const Cancellation& cancellation,
                                    const DialogTimeouts& timeouts = {});

/// kdialog on KDE, zenity or qarma elsewhere, found on PATH. cancel() ends the program.
[[nodiscard]] FileAnswer ask_helper(const FileQuestion& question, const Cancellation& cancellation,
                                    const DialogTimeouts& timeouts = {});

}  // namespace dibhr
