// The name of a recording: that of its depth, without the word depth.
#include "core/video/sources/beside_recording.hpp"

#include <string_view>

#include "core/files/names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// "cup" of cup_depth.mp4, "depth" of depth.mp4, "take" of the folder take/.
std::string recording_name(const fs::path& place) {
    std::string stem = is_folder(place) ? place.filename().string() : place.stem().string();
    const std::string small = lower_case(stem);
    constexpr std::string_view kWord = "depth";
    const std::size_t at = small.rfind(kWord);
    if (at == std::string::npos) return stem;
    std::string name = stem;
    name.erase(at, kWord.size());
    const auto is_joint = [](char c) { return c == '_' || c == '-' || c == '.' || c == ' '; };
    while (!name.empty() && is_joint(name.back())) name.pop_back();
    while (!name.empty() && is_joint(name.front())) name.erase(0, 1);
    return name.empty() ? stem : name;
}

}  // namespace

fs::path beside_recording(const fs::path& depth, const std::string& ending) {
    const fs::path place = depth.has_filename() ? depth : depth.parent_path();
    const fs::path name = is_folder(place) ? place.filename() : place.stem();
    const fs::path whole = place.parent_path() / (name.string() + ending);
    return is_file(whole) ? whole : place.parent_path() / (recording_name(place) + ending);
}

}  // namespace dibhr
