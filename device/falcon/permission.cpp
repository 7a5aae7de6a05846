// What a person does when the system refuses them the Falcon.
#include "device/falcon/permission.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

namespace dibhr::falcon {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRule = "70-dibhr-falcon.rules";

// The folders that udev reads rules from (its manual page).
constexpr std::array<const char*, 5> kRuleFolders{"/etc/udev/rules.d", "/run/udev/rules.d",
                                                  "/usr/local/lib/udev/rules.d",
                                                  "/usr/lib/udev/rules.d", "/lib/udev/rules.d"};

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool rule_is_in_place() {
    return std::any_of(kRuleFolders.begin(), kRuleFolders.end(),
                       [](const char* folder) { return is_file(fs::path(folder) / kRule); });
}

/// Of the installed program, or of the sources it was built from.
fs::path rule_that_came_along() {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    const fs::path installed = program.parent_path().parent_path() / "lib" / "udev" / "rules.d";
    if (is_file(installed / kRule)) return installed / kRule;
    return fs::path(DIBHR_SOURCE_ASSETS) / kRule;
}

}  // namespace

std::string how_to_get_permission() {
    if (rule_is_in_place()) {
        return "log in at this machine itself, or join the group plugdev (sudo usermod -aG plugdev "
               "$USER, then log in again), and plug the Falcon in again";
    }
    return "run: sudo cp " + rule_that_came_along().string() +
           " /etc/udev/rules.d/ && sudo udevadm control --reload; then plug the Falcon in again";
}

}  // namespace dibhr::falcon
