// The window thread's control of a clip of the view: start, stop, status.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/task_group.hpp"
#include "app/window/crash_note.hpp"
#include "core/clip/clip_recorder.hpp"

namespace dibhr {

class ViewerClip {
  public:
    using Clock = ClipRecorder::Clock;

    /// Both must outlive it. The crash note names an unfinished clip if the program hangs at exit.
    ViewerClip(TaskGroup& tasks, CrashNote& crash_note) : tasks_(tasks), crash_note_(crash_note) {}
    /// Finishes the clip if an error ends the program.
    ~ViewerClip();
    ViewerClip(const ViewerClip&) = delete;
    ViewerClip& operator=(const ViewerClip&) = delete;

    /// Throws InputError when the file cannot be made.
    void start(const std::filesystem::path& file, ClipNameConflict name, PictureOf of);
    /// Ends the clip now; the file is finished a little later.
    void stop();
    /// A clip is recorded, or its file is being finished.
    [[nodiscard]] bool active() const { return recorder_ != nullptr; }
    /// The file is being finished.
    [[nodiscard]] bool stopped() const { return recorder_ && end_; }

    /// Whether the clip needs the picture of now of this part of the window.
    [[nodiscard]] bool wants(PictureOf of, Clock::time_point now) const;
    void add(ColourImage picture, Clock::time_point now);

    /// Once a turn: copies the clip's status into `state`. Returns a notice once the clip is
    /// finished. Throws InputError, once, when it failed.
    [[nodiscard]] std::optional<std::string> poll(ViewerState& state);

    /// At the end of the program: waits for the file with a timeout. Throws InputError when a clip
    /// failed, or is not finished in time.
    void finish(ClipEnd how);

  private:
    void wait_for(std::unique_ptr<ClipRecorder> over, ClipEnd how);
    void set_crash_note();
    void clear_crash_note();

    TaskGroup& tasks_;
    CrashNote& crash_note_;
    std::unique_ptr<ClipRecorder> recorder_{};  // null: no clip
    std::filesystem::path file_{};
    ClipNameConflict name_{ClipNameConflict::replaces};
    bool in_crash_note_{false};
    PictureOf of_{PictureOf::window};
    std::optional<Clock::time_point> begin_{};  // time of the first picture
    std::optional<Clock::time_point> end_{};
    Clock::time_point last_{};
    std::string failure_{};  // of the first clip that failed
};

}  // namespace dibhr
