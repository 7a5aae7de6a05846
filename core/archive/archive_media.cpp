// The list and the copies of media.
#include "core/archive/archive_media.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <system_error>

#include "core/archive/archive_layout.hpp"
#include "core/archive/dictionary.hpp"
#include "core/error.hpp"
#include "core/files/content_files.hpp"
#include "core/files/csv_table.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/session/media_places.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Makes a copy piece by piece; `piece_done` after each.
void copy_file(const fs::path& from, const fs::path& to, const std::function<void()>& piece_done) {
    constexpr std::size_t kPiece_bytes = 1 << 20;
    std::ifstream in(from, std::ios::binary);
    std::string piece(kPiece_bytes, '\0');
    OutputFile out(to);
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0) {
        out.write({piece.data(), static_cast<std::size_t>(in.gcount())});
        piece_done();
    }
    if (in.bad()) throw InputError(from.string() + ": cannot be read; make it readable");
    out.commit();
}

bool can_be_read(const fs::path& place) {
    try {
        return std::ranges::all_of(content_files(place), [](const fs::path& file) {
            return std::ifstream(file).is_open();
        });
    } catch (const fs::filesystem_error&) {
        return false;
    }
}

/// Whether all names in a folder can stand in a manifest.
bool has_plain_names(const fs::path& place) {
    return std::ranges::all_of(content_files(place), [](const fs::path& file) {
        return plain_name(file.string()) == file.string();
    });
}

void copy_content(const fs::path& from, const fs::path& to, const std::function<void()>& done) {
    for (const fs::path& file : content_files(from)) {
        const fs::path target = is_folder(from) ? to / file.lexically_relative(from) : to;
        std::error_code failed;
        make_folders(target.parent_path(), failed);
        copy_file(file, target, done);
    }
}

/// Copies from the first place that has the content. Empty, or why it was not copied.
std::string copy_from(const std::vector<fs::path>& places, const FileContent& content,
                      const fs::path& to, const std::function<void()>& done) {
    if (content.sha256.empty()) return "the recording ended before its sum was known";
    std::string reason = "is not there; put it beside the session";
    for (const fs::path& place : places) {
        if (!is_file(place) && !is_folder(place)) continue;
        reason = "cannot be read; make it readable";
        if (!can_be_read(place)) continue;
        reason = "has changed since it was recorded; put the original beside the session";
        if (content_bytes(place) != content.bytes) continue;
        if (is_folder(place) && !has_plain_names(place)) return "has names with \\ or line breaks";
        copy_content(place, to, done);
        // Not the original's: what the archive holds must have the sum.
        if (has_content(to, content)) return {};
        fs::remove_all(to);
    }
    return reason;
}

}  // namespace

std::string ArchiveMedia::name_for(const FileContent& media, const fs::path& session) {
    const auto is_same = [&media](const Medium& one) {
        return plain_name(media.file.filename().string()) ==
                   plain_name(one.content.file.filename().string()) &&
               media.bytes == one.content.bytes && media.sha256 == one.content.sha256;
    };
    auto found = std::ranges::find_if(all_, is_same);
    if (found == all_.end()) {
        const auto is_taken = [this](const std::string& name) {
            return std::ranges::find(all_, name, &Medium::name) != all_.end();
        };
        // Not one of the list's own names.
        std::string name = free_name(media.file, [&](const std::string& wanted) {
            return is_taken(wanted) || wanted.empty() || wanted.starts_with("media.");
        });
        all_.push_back({.name = std::move(name), .content = media});
        found = std::prev(all_.end());
    }
    for (const fs::path& place : places_of(media, session))
        if (std::ranges::find(found->places, place) == found->places.end())
            found->places.push_back(place);
    return std::string("../../") + kFolder + "/" + found->name;
}

std::vector<std::string> ArchiveMedia::copy(const fs::path& archive,
                                            const std::function<void(double)>& progress) {
    std::vector<std::string> not_copied;
    double all_bytes = 1.0;
    double begun_bytes = 0.0;
    for (const Medium& one : all_) all_bytes += static_cast<double>(one.content.bytes);
    for (Medium& one : all_) {
        const std::string reason = copy_from(one.places, one.content, archive / kFolder / one.name,
                                             [&] { progress(begun_bytes / all_bytes); });
        begun_bytes += static_cast<double>(one.content.bytes);
        one.copied = reason.empty();
        if (!one.copied)
            not_copied.push_back(one.content.file.string() + ": is not in the archive: " + reason);
    }
    return not_copied;
}

void ArchiveMedia::write_list(const fs::path& archive) const {
    std::string rows = "name,bytes,sha256,head_bytes,copied\n";
    for (const Medium& one : all_)
        rows += csv_cell(one.name) + "," + std::to_string(one.content.bytes) + "," +
                one.content.sha256 + "," + std::to_string(one.content.head_bytes) + "," +
                (one.copied ? "yes" : "no") + "\n";
    write_table(archive, fs::path(kFolder) / "media.csv", rows, media_dictionary());
}

}  // namespace dibhr
