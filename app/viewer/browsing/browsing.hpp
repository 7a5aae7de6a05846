// Reads folders and previews for the Open dialog on other threads; opens a folder's next file.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/folder.hpp"
#include "app/viewer/browsing/recording_folders.hpp"
#include "app/viewer/task_group.hpp"
#include "core/video/frames/frame_window.hpp"
#include "render/gl_objects.hpp"

namespace dibhr {

class Browsing {
  public:
    /// The task group must outlive it.
    explicit Browsing(TaskGroup& tasks);
    ~Browsing();
    Browsing(const Browsing&) = delete;
    Browsing& operator=(const Browsing&) = delete;

    /// Shows or hides the dialog.
    void toggle(ViewerState& state);

    /// The folder in which a dialog begins: that of the shown file.
    [[nodiscard]] std::filesystem::path first_folder(const ViewerState& state) const;

    /// Shows the dialog with the content of that folder.
    void show(const std::filesystem::path& folder, ViewerState& state);

    /// Opens the file that is `entries` after the shown one (before it: < 0), once its folder was
    /// read. False while the folder is still being read for the last call.
    [[nodiscard]] bool read_neighbours(int entries, const ViewerState& state);

    /// Reads another folder for the dialog.
    void go_to(const std::filesystem::path& folder, OpenDialog& dialog);
    /// Computes the completion of the typed path (Tab).
    void complete(const std::string& typed, const OpenDialog& dialog);
    /// Looks up the entered file, which advance() then opens.
    void enter(const TypedFile& entered, const OpenDialog& dialog);

    /// Once a turn: takes the results of the other threads. Returns a notice, if any.
    [[nodiscard]] std::optional<std::string> advance(ViewerState& state);

  private:
    struct Read {
        std::filesystem::path file{};
        std::shared_ptr<const ColourImage> colour{}, depth{};
        std::string text{};
        bool opens{false};
    };
    using Stop = std::shared_ptr<std::atomic<bool>>;  // true: the preview is not wanted any more
    using Clock = std::chrono::steady_clock;

    static Read read_preview(const FolderEntry& entry, const Stop& stop);
    void mark_recordings(OpenDialog& dialog);
    void take_folder(OpenDialog& dialog);
    void take_typed(ViewerState& state);
    void advance_preview(OpenDialog& dialog);
    [[nodiscard]] std::string open_neighbour(const Folder& folder, ViewerState& state) const;

    std::filesystem::path sample_folder_;
    std::shared_ptr<const ColourImage> colour_{}, depth_{};
    ColourTexture colour_texture_{}, depth_texture_{};
    std::filesystem::path wanted_{};  // the entry whose preview is shown, read or waited for
    Clock::time_point wanted_at_{};
    bool waits_{false};  // for the choice to rest
    Stop stop_{};
    int neighbour_offset_{0};
    std::string entered_{};  // what is looked up
    int entered_in_{0};      // OpenDialog::line at enter(); a result for another line is dropped
    BackgroundTask<Folder> folder_;
    BackgroundTask<Completion> completion_;
    BackgroundTask<std::optional<FolderEntry>> typed_;
    BackgroundTask<Read> preview_;
    RecordingFolders recordings_;
    BackgroundTask<Folder> neighbours_;
};

}  // namespace dibhr
