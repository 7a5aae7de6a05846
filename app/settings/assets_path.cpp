// Finds the files that come with the program.
#include "app/settings/assets_path.hpp"

#include <algorithm>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

fs::path sample_file(const fs::path& folder, const char* name) {
    fs::path file = folder / name;
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored)) return file;
    throw InputError("the built-in sample has no " + std::string(name) + " in " + folder.string() +
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
    return {sample_file(folder, "color.mp4"), sample_file(folder, "depth.mp4")};
}

fs::path shipped_materials_folder() {
    return assets_folder() / "materials";
}

fs::path shipped_studies_folder() {
    return assets_folder() / "studies";
}

fs::path shipped_limits_file() {
    return assets_folder() / "60-dibhr-realtime.conf";
}

std::vector<std::string> toml_names_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

}  // namespace dibhr
