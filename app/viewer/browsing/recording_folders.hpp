// Which folders are recordings: found out for the Open dialog, one after the other.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "app/settings/folder.hpp"
#include "app/viewer/task_group.hpp"

namespace dibhr {

/// Whether a folder may be a recording, by the names in it. Waits for the disk.
[[nodiscard]] bool may_be_recording(const std::filesystem::path& folder);

/// How many folders a recording's folder holds besides those of its own frames. Waits for the disk.
[[nodiscard]] int folders_beside_frames(const std::filesystem::path& folder);

/// A folder that is a recording.
struct FoundRecording {
    std::filesystem::path folder{};
    int folders{0};  ///< folders_beside_frames()
};

/// Opens each folder in a folder as the program would, on a thread of its own.
class RecordingFolders {
  public:
    /// The task group must outlive it.
    explicit RecordingFolders(TaskGroup& tasks) : search_(tasks) {}
    ~RecordingFolders() { stop(); }
    RecordingFolders(const RecordingFolders&) = delete;
    RecordingFolders& operator=(const RecordingFolders&) = delete;

    /// Begins with another folder; the search in the one before ends.
    void search(const Folder& folder);
    void stop();
    /// Those that were found since the last call.
    [[nodiscard]] std::vector<FoundRecording> take();

  private:
    struct Found;

    BackgroundTask<bool> search_;
    std::shared_ptr<Found> found_{};  // shared with the thread; null: no search yet
};

}  // namespace dibhr
