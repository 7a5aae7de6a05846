// Whether there is a desktop, and which way to open its dialog is used.
#include "app/desktop/file_dialog.hpp"

#include <string_view>
#include <system_error>

#include "core/files/machine.hpp"

namespace dibhr {

namespace {

/// In the places where sd_bus_open_user() looks for the bus.
bool has_session_bus() {
    const std::string_view address = environment_variable("DBUS_SESSION_BUS_ADDRESS");
    if (!address.empty()) return address != "disabled:";
    const std::string_view folder = environment_variable("XDG_RUNTIME_DIR");
    std::error_code unknown;
    return !folder.empty() &&
           std::filesystem::exists(std::filesystem::path(folder) / "bus", unknown);
}

}  // namespace

bool has_desktop() {
    // Over SSH the session bus belongs to the machine's own screen, where nobody may be.
    const bool from_afar = !environment_variable("SSH_CONNECTION").empty();
    return has_session_bus() && !from_afar;
}

FileAnswer ask_desktop(const FileQuestion& question, const Cancellation& cancellation) {
    FileAnswer answer;
    if (has_desktop()) answer = ask_portal(question, cancellation);
    if (answer.outcome == FileAnswer::Outcome::unavailable)
        answer = ask_helper(question, cancellation);
    return answer;
}

}  // namespace dibhr
