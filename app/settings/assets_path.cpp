// Finds the files that come with the program.
#include "app/settings/assets_path.hpp"

#include <string>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

fs::path file_starting_with(const fs::path& folder, const std::string& stem) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().stem() == stem) return entry.path();
    }
    throw InputError("the built-in sample has no " + stem + " file in " + folder.string() +
                     ": install the program again, or name a colour and a depth file");
}

/// `../share/dibhr` of the running program, else the `assets` of the source tree it was built from.
fs::path assets_folder() {
    std::error_code failed;
    const auto binary = fs::read_symlink("/proc/self/exe", failed);
    if (!failed) {
        auto installed = binary.parent_path().parent_path() / "share" / "dibhr";
        if (fs::is_directory(installed, failed)) return installed;
    }
    fs::path source = DIBHR_SOURCE_ASSETS;
    if (fs::is_directory(source, failed)) return source;
    throw InputError("the program's own files are missing (looked beside " + binary.string() +
                     "): install it again, or name a colour and a depth file");
}

}  // namespace

SampleFiles sample_files() {
    const auto folder = assets_folder() / "sample";
    return {file_starting_with(folder, "color"), file_starting_with(folder, "depth")};
}

fs::path shipped_materials_folder() {
    return assets_folder() / "materials";
}

}  // namespace dibhr
