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

/// The folder of a file, or of a folder of pictures.
fs::path folder_of(const fs::path& media) {
    return fs::path(whole_path(media)).parent_path();
}

/// NAME-DIGITS.toml; the digits are a hash of `path`.
fs::path choice_file(const fs::path& folder, const std::string& name, const std::string& path) {
    constexpr std::size_t kLongestName = 100;  // with the digits below any file system's limit
    constexpr std::size_t kDigits = 16;
    const std::string digits =
        sha256_of({reinterpret_cast<const std::uint8_t*>(path.data()), path.size()});
    return folder / (name.substr(0, kLongestName) + "-" + digits.substr(0, kDigits) + ".toml");
}

/// Writes or, where the choice is empty, removes `file`. `what`: for which files it was chosen.
void replace_choice(const fs::path& file, const std::string& what, const DepthStatement& choice) {
    std::error_code failed;
    if (choice == DepthStatement{}) {
        fs::remove(file, failed);
        if (failed)
            throw InputError("what was chosen before is still kept: " + shown(file) +
                             " cannot be removed (" + failed.message() + "); delete it");
        return;
    }
    make_folders(file.parent_path(), failed);
    if (failed)
        refuse("the folder " + shown(file.parent_path()) + " cannot be written (" +
               failed.message() + "); make it writable");
    try {
        write_file(file, "# Chosen in the window for " + what +
                             ";\n# delete this file to forget it.\n" + toml_of(choice));
    } catch (const InputError& error) {
        refuse(error.what());
    }
}

bool uses_kept_choices(const DepthRequest& request, const fs::path& media) {
    return request.find_out && !request.kept_in.empty() && !media.empty();
}

}  // namespace

fs::path kept_choice_of(const fs::path& folder, const fs::path& media) {
    const std::string path = whole_path(media);
    return choice_file(folder, fs::path(path).stem().string(), path);
}

void keep_choice(const fs::path& folder, const fs::path& media, const DepthStatement& choice) {
    replace_choice(kept_choice_of(folder, media), shown(whole_path(media)), choice);
}

fs::path kept_folder_choice_of(const fs::path& folder, const fs::path& media) {
    const fs::path files = folder_of(media) / "*";  // apart from a choice for the folder as media
    return choice_file(folder, folder_of(media).filename().string() + "-files", files.string());
}

void keep_folder_choice(const fs::path& folder, const fs::path& media,
                        const DepthStatement& choice) {
    replace_choice(kept_folder_choice_of(folder, media), "the files of " + shown(folder_of(media)),
                   choice);
}

DepthStatement kept_folder_choice(const DepthRequest& request, const fs::path& media) {
    if (!uses_kept_choices(request, media) || is_live(media)) return {};
    return read_statement(kept_folder_choice_of(request.kept_in, media)).value_or(DepthStatement{});
}

DepthRequest with_kept_choice(DepthRequest request, const fs::path& media) {
    if (request.panel_is_whole || !uses_kept_choices(request, media)) return request;
    if (const auto kept = read_statement(kept_choice_of(request.kept_in, media)))
        request.panel.fill_in(*kept);
    return request;
}

}  // namespace dibhr
