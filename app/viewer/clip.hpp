// A clip of the view: start, stop, and what is told of it.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/errand.hpp"
#include "app/window/last_words.hpp"
#include "core/clip/clip_recorder.hpp"

namespace dibhr {

class ViewerClip {
  public:
    using Clock = ClipRecorder::Clock;

    /// Both outlive it. `words` keep what there is of a clip when the program hangs at its end.
    ViewerClip(Errands& errands, LastWords& words) : errands_(errands), words_(words) {}
    /// What there is of a clip is kept when an error ends the program.
    ~ViewerClip();
    ViewerClip(const ViewerClip&) = delete;
    ViewerClip& operator=(const ViewerClip&) = delete;

    /// Throws InputError when the file cannot be made.
    void start(const std::filesystem::path& file, ClipName name, PictureOf of);
    /// The clip ends now, its file a little later.
    void stop();
    /// One goes on or is being finished.
    [[nodiscard]] bool active() const { return recorder_ != nullptr; }
    /// It is being finished.
    [[nodiscard]] bool stopped() const { return recorder_ && end_; }

    /// Whether it wants a picture of that part of the window that is drawn now.
    [[nodiscard]] bool wants(PictureOf of, Clock::time_point now) const;
    void add(ColourImage picture, Clock::time_point now);

    /// Once a picture: how it goes, into `state`; a notice once it is finished. Throws InputError,
    /// once, when it broke off.
    [[nodiscard]] std::optional<std::string> take_news(ViewerState& state);

    /// At the end of the program: waits for the file, not for ever. Throws InputError when a clip
    /// broke off, or is not finished after that.
    void finish(ClipEnd how);

  private:
    void wait_for(std::unique_ptr<ClipRecorder> over, ClipEnd how);
    void tell_words();
    void forget_words();

    Errands& errands_;
    LastWords& words_;
    std::unique_ptr<ClipRecorder> recorder_{};  // null: no clip
    std::filesystem::path file_{};
    ClipName name_{ClipName::replaces};
    bool in_words_{false};
    PictureOf of_{PictureOf::window};
    std::optional<Clock::time_point> begin_{};  // of the first picture
    std::optional<Clock::time_point> end_{};
    Clock::time_point last_{};
    std::string failure_{};  // of the first clip that broke off
};

}  // namespace dibhr
