// The desktop's own dialog for opening files: through its portal, else through a helper program,
// each in a process of its own.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "app/desktop/call_off.hpp"

namespace dibhr {

/// One of the kinds of files that a person can have listed.
struct FileFilter {
    std::string name{};                   ///< "All files"
    std::vector<std::string> patterns{};  ///< "*.mp4", as a shell has them
};

struct FileQuestion {
    std::string title{};
    std::filesystem::path folder{};     ///< where to begin; whole
    std::vector<FileFilter> filters{};  ///< the first one holds
    unsigned long x11_window{0};        ///< over which the dialog is to stay; 0: not known
};

struct FileAnswer {
    enum class Of {
        nobody,     ///< there is no such dialog, it went away, or it did not answer
        cancelled,  ///< by the person, or the question was called off
        chosen
    };
    Of of{Of::nobody};
    std::vector<std::filesystem::path> files{};  ///< chosen, at least one; whole
};

/// How long the desktop may take.
struct DialogTimes {
    std::chrono::milliseconds bus{2000};     ///< the session bus, to take the connection
    std::chrono::milliseconds portal{2000};  ///< the portal, for its word that it will ask
    /// So quickly no person answers: it was the desktop that refused.
    std::chrono::milliseconds quickest_person{300};
};

/// Whether a desktop can be expected at all: a session bus, whose screen is the one that the window
/// is on. Asks nobody.
[[nodiscard]] bool has_desktop();

/// Waits for the person, or until it is called off: for a thread that may wait. By the portal, else
/// by a helper.
[[nodiscard]] FileAnswer ask_desktop(const FileQuestion& question, const CallOff& off);

// Its two ways.

/// org.freedesktop.portal.FileChooser on the session bus. Nobody, within a few seconds, where there
/// is none, it does not answer or it refuses; later, when it goes away. Called off, it closes its
/// dialog.
[[nodiscard]] FileAnswer ask_portal(const FileQuestion& question, const CallOff& off,
                                    const DialogTimes& times = {});

/// kdialog on KDE, zenity or qarma elsewhere, found on PATH. Called off, it is ended.
[[nodiscard]] FileAnswer ask_helper(const FileQuestion& question, const CallOff& off,
                                    const DialogTimes& times = {});

}  // namespace dibhr
