// Looks for recordings among folders.
#include "app/viewer/browsing/recording_folders.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <utility>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/files.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/sources/media_names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

struct RecordingFolders::Found {
    std::atomic<bool> stops{false};
    std::mutex mutex{};
    std::vector<FoundRecording> folders{};
};

namespace {

constexpr int kMostNames = 300;  // looked at in a folder

bool opens(const FolderEntry& folder) {
    try {
        return open_request(request_for(folder)) != nullptr;
    } catch (const std::exception&) {  // it is a folder to look into
        return false;
    }
}

/// Folders of colour and depth in it, and what scanner apps call them.
bool names_part(const fs::path& folder) {
    return named_depth(folder) || named_colour(folder) || folder.filename() == "keyframes";
}

}  // namespace

bool may_be_recording(const fs::path& folder) {
    const std::vector<std::string> endings = endings_that_open();
    std::error_code failed;
    int names = 0;
    for (fs::directory_iterator entries(folder, failed);
         !failed && entries != fs::directory_iterator() && names < kMostNames;
         entries.increment(failed), ++names) {
        const fs::path& entry = entries->path();
        std::error_code unknown;
        if (entries->is_directory(unknown)
                ? names_part(entry)
                : std::ranges::find(endings, lower_case(entry.extension().string())) !=
                      endings.end())
            return true;
    }
    return false;
}

int folders_beside_frames(const fs::path& folder) {
    std::error_code failed;
    int folders = 0;
    int names = 0;
    for (fs::directory_iterator entries(folder, failed);
         !failed && entries != fs::directory_iterator() && names < kMostNames;
         entries.increment(failed), ++names) {
        std::error_code unknown;
        const bool hidden = entries->path().filename().string().starts_with('.');
        if (!hidden && entries->is_directory(unknown) && !names_part(entries->path())) ++folders;
    }
    return folders;
}

void RecordingFolders::stop() {
    if (found_) found_->stops = true;
    found_.reset();
}

void RecordingFolders::search(const Folder& folder) {
    stop();
    found_ = std::make_shared<Found>();
    search_.restart([entries = folder.entries, found = found_] {
        for (const FolderEntry& entry : entries) {
            if (found->stops) return false;
            if (entry.kind != FileKind::folder || !may_be_recording(entry.file)) continue;
            if (!opens(entry)) continue;
            const int folders = folders_beside_frames(entry.file);
            const std::lock_guard lock(found->mutex);
            found->folders.push_back({entry.file, folders});
        }
        return true;
    });
}

std::vector<FoundRecording> RecordingFolders::take() {
    if (!found_) return {};
    const std::lock_guard lock(found_->mutex);
    return std::exchange(found_->folders, {});
}

}  // namespace dibhr
