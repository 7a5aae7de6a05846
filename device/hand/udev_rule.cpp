// Where udev rules are, and what to do with dibhr's.
#include "device/hand/udev_rule.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "device/hand/shell_word.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

/// The folders that udev reads rules from (its manual page).
constexpr std::array<const char*, 5> kRuleFolders{"/etc/udev/rules.d", "/run/udev/rules.d",
                                                  "/usr/local/lib/udev/rules.d",
                                                  "/usr/lib/udev/rules.d", "/lib/udev/rules.d"};

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool is_in_place(const std::string& rule) {
    return std::any_of(kRuleFolders.begin(), kRuleFolders.end(),
                       [&rule](const char* folder) { return is_file(fs::path(folder) / rule); });
}

/// The rule of the installed program, or of the sources it was built from.
fs::path rule_that_came_along(const std::string& rule) {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    const fs::path installed = program.parent_path().parent_path() / "lib" / "udev" / "rules.d";
    if (is_file(installed / rule)) return installed / rule;
    return fs::path(DIBHR_SOURCE_ASSETS) / rule;
}

}  // namespace

std::string how_to_get_permission(const std::string& rule, const std::string& device) {
    if (is_in_place(rule)) {
        return "log in at this machine itself, or join the group plugdev (sudo usermod -aG plugdev "
               "$USER, then log in again), and plug " +
               device + " in again";
    }
    return "run: sudo cp " + shell_word(rule_that_came_along(rule).string()) +
           " /etc/udev/rules.d/ && sudo udevadm control --reload; then plug " + device +
           " in again";
}

}  // namespace dibhr
