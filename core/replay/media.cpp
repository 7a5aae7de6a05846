// The files a session was recorded over.
#include "core/replay/media.hpp"

#include <optional>
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
