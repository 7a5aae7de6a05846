// Opens the dialog on a thread that may outlive the window, until the dialog is closed.
#include "app/viewer/desktop_dialog.hpp"

#include <utility>

#include "app/settings/folder.hpp"

namespace dibhr {

namespace {

/// Portals and helpers compare case-sensitively.
std::vector<std::string> patterns_of_recordings() {
    std::vector<std::string> patterns;
    for (const std::string& ending : endings_that_open()) {
        std::string large = ending;
        for (char& c : large)
            if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
        patterns.push_back("*" + ending);
        patterns.push_back("*" + large);
    }
    return patterns;
}

}  // namespace

void DesktopDialog::ask(const std::filesystem::path& folder, unsigned long x11_window) {
    cancellation_ = std::make_shared<Cancellation>();
    const FileQuestion question{
        .title = "Open a recording, or colour and depth together",
        .folder = folder,
        .filters = {{"Recordings", patterns_of_recordings()}, {"All files", {"*"}}},
        .x11_window = x11_window};
    asking_.restart(
        [question, cancellation = cancellation_] { return ask_desktop(question, *cancellation); });
}

std::optional<FileAnswer> DesktopDialog::take() {
    if (!open()) return std::nullopt;
    auto answer = asking_.take();
    if (answer) cancellation_.reset();
    return answer;
}

void DesktopDialog::cancel() {
    if (const auto cancellation = std::exchange(cancellation_, nullptr)) cancellation->cancel();
}

}  // namespace dibhr
