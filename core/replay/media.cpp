// The files of sessions.
#include "core/replay/media.hpp"

#include <array>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& file) {
    std::error_code failed;
    return fs::is_regular_file(file, failed);
}

bool has_content(const fs::path& file, const SessionMedia& media) {
    std::error_code failed;
    if (fs::file_size(file, failed) != media.bytes || failed) return false;
    return sha256_of_file(file) == media.sha256;
}

}  // namespace

bool names_session(const std::filesystem::path& file) {
    if (file.extension() == ".dibhr") return true;
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(file, unknown)) return false;
    constexpr std::string_view kMagic = "SQLite format 3";  // SQLite's file format, section 1.3
    std::array<char, kMagic.size()> head{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), head.size());
    return stream.gcount() == static_cast<std::streamsize>(head.size()) &&
           std::string_view(head.data(), head.size()) == kMagic;
}

SessionMediaFinder::SessionMediaFinder(fs::path session, bool any_content)
    : session_(std::move(session)), any_content_(any_content) {}

fs::path SessionMediaFinder::find(const SessionMedia& media, const std::string& what) {
    if (media.file.empty()) {
        throw InputError(session_.string() + ": does not say over which " + what +
                         " it was recorded; record it again");
    }
    const fs::path beside = fs::absolute(session_).parent_path() / media.file.filename();
    std::optional<fs::path> found;
    for (const fs::path& candidate : {media.file, beside}) {
        if (!is_file(candidate)) continue;
        if (!media.sha256.empty() && has_content(candidate, media)) return candidate;
        if (!found) found = candidate;
    }
    if (!found) {
        throw InputError(
            session_.string() + ": the " + what + " it was recorded over, " + media.file.string() +
            ", is not there; put it back, or beside the session as " + beside.string());
    }
    if (media.sha256.empty()) {
        warn(found->string() + " is taken for the " + what +
             " of the recording, which ended before its content was known");
    } else if (any_content_) {
        warn(found->string() + " is not the " + what + " of the recording: it has changed");
    } else {
        throw InputError(found->string() + ": has changed since " + session_.filename().string() +
                         " was recorded over it; put the original beside the session as " +
                         beside.string() + ", or take it as it is with --any-media");
    }
    return *found;
}

void SessionMediaFinder::warn(const std::string& sentence) {
    warning_ += (warning_.empty() ? "" : "; ") + sentence;
}

}  // namespace dibhr
