// Keeps one file for each media, in the form of a sidecar.
#include "core/video/sources/kept_choices.hpp"

#include <cstdint>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/video/live/live_name.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// The same path for each way to name a file: from another folder, through a link, with a slash.
std::string whole_path(const fs::path& media) {
    if (is_live(media)) return media.string();
    std::error_code failed;
    const fs::path named = fs::absolute(media, failed);
    fs::path whole = fs::weakly_canonical(named, failed);
    if (failed) whole = named;
    return (whole.has_filename() ? whole : whole.parent_path()).string();
}

[[noreturn]] void refuse(const std::string& why) {
    throw InputError("what was chosen is not kept: " + why);
}

void write_choice(const fs::path& file, const fs::path& media, const DepthStatement& choice) {
    std::error_code failed;
    make_folders(file.parent_path(), failed);
    if (failed)
        refuse("the folder " + shown(file.parent_path()) + " cannot be written (" +
               failed.message() + "); make it writable");
    try {
        write_file(file, "# Chosen in the window for " + shown(whole_path(media)) +
                             ";\n# delete this file to forget it.\n" + toml_of(choice));
    } catch (const InputError& error) {
        refuse(error.what());
    }
}

}  // namespace

fs::path kept_choice_of(const fs::path& folder, const fs::path& media) {
    constexpr std::size_t kLongestName = 100;  // with the digits below any file system's limit
    constexpr std::size_t kDigits = 16;
    const std::string path = whole_path(media);
    const std::string digits =
        sha256_of({reinterpret_cast<const std::uint8_t*>(path.data()), path.size()});
    return folder / (fs::path(path).stem().string().substr(0, kLongestName) + "-" +
                     digits.substr(0, kDigits) + ".toml");
}

void keep_choice(const fs::path& folder, const fs::path& media, const DepthStatement& choice) {
    const fs::path file = kept_choice_of(folder, media);
    if (!(choice == DepthStatement{})) return write_choice(file, media, choice);
    std::error_code failed;
    fs::remove(file, failed);
    if (failed)
        throw InputError("what was chosen before is still kept: " + shown(file) +
                         " cannot be removed (" + failed.message() + "); delete it");
}

DepthRequest with_kept_choice(DepthRequest request, const fs::path& media) {
    if (!request.find_out || request.kept_in.empty() || media.empty()) return request;
    if (const auto kept = read_statement(kept_choice_of(request.kept_in, media)))
        request.panel.fill_in(*kept);
    return request;
}

}  // namespace dibhr
