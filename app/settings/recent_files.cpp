// Which files were opened before.
#include "app/settings/recent_files.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <system_error>

#include "core/error.hpp"
#include "core/files/machine.hpp"
#include "core/files/output_file.hpp"
#include "core/video/live/live_name.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostKept = 12;
constexpr std::size_t kLongestLine = 16384;  // two paths and more
constexpr const char* kOwnBytes = "\t\n";    // end of a path, end of a line

fs::path whole(const fs::path& file) {
    return file.empty() || is_live(file) ? file : fs::absolute(file).lexically_normal();
}

}  // namespace

fs::path recent_files_path() {
    return program_folder("XDG_STATE_HOME", ".local/state") / "recent";
}

std::vector<RecentFile> read_recent_files(const fs::path& file) {
    std::vector<RecentFile> files;
    std::ifstream in(file, std::ios::binary);
    for (std::string line; files.size() < kMostKept && std::getline(in, line);) {
        const std::size_t tab = line.find('\t');
        if (tab == std::string::npos || tab == 0 || line.size() > kLongestLine) continue;
        files.push_back({line.substr(0, tab), line.substr(tab + 1)});
    }
    return files;
}

std::vector<RecentFile> with_first(const RecentFile& opened, std::vector<RecentFile> files) {
    const RecentFile first{whole(opened.colour), whole(opened.depth)};
    const std::string names = first.colour.string() + first.depth.string();
    if (first.colour.empty() || names.find_first_of(kOwnBytes) != std::string::npos) return files;
    std::erase(files, first);
    files.insert(files.begin(), first);
    files.resize(std::min(files.size(), kMostKept));
    return files;
}

void add_recent_file(const RecentFile& opened, const fs::path& file) {
    const std::vector<RecentFile> before = read_recent_files(file);
    const std::vector<RecentFile> files = with_first(opened, before);
    if (files == before) return;
    std::error_code failed;  // reported when the file is opened
    make_folders(file.parent_path(), failed);
    OutputFile out(file);
    for (const RecentFile& kept : files)
        out.write(kept.colour.string() + "\t" + kept.depth.string() + "\n");
    out.commit();
}

fs::path expand_home(const std::string& text) {
    if (text == "~") return home_folder();
    return text.starts_with("~/") ? home_folder() / text.substr(2) : fs::path(text);
}

}  // namespace dibhr
