// Recording from the window: start, stop, marks, and what is told of it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "app/window/last_words.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/session/recorder.hpp"
#include "core/video/media.hpp"

namespace dibhr {

class ViewerRecording {
  public:
    /// `ticks` outlives it: the haptic loop's end.
    ViewerRecording(TickRing& ticks, LastWords& words) : ticks_(ticks), words_(words) {}

    /// A video that ticks will refer to by the number given back.
    [[nodiscard]] std::uint32_t opened(const MediaDescription& media);

    /// Throws InputError when the file cannot be made.
    void start(const std::filesystem::path& file, ViewerState& state);
    /// Closes the file. A short notice; empty when writing had broken off.
    std::string stop(ViewerState& state);
    [[nodiscard]] bool active() const { return recorder_ != nullptr; }

    /// Parameters that the next tick will have; to be called before it gets them.
    void hand_over(const HapticSettings& settings, const std::filesystem::path& bump_file);

    /// The touch maps that ticks refer to by that version; to be called once they are known, also
    /// after the ticks.
    void maps(std::uint32_t version, std::vector<SessionMap> maps);

    /// Marks this moment with the tag that was typed. A short notice.
    std::string mark(ViewerState& state);

    /// Once a picture: how it goes, into `state`; what a person typed, into the file. A recording
    /// that broke off ends.
    void take_news(ViewerState& state);

    /// At the end of the program; waits so long for sums of large files. Throws InputError when a
    /// recording broke off.
    void finish(std::chrono::milliseconds for_sums = Recorder::kPatience);

    /// Of the thread that writes: silent while that waits for the disk.
    [[nodiscard]] const Heartbeat& heart() const noexcept { return heart_; }

  private:
    void tell_media(std::uint32_t number, const MediaDescription& media);
    void break_off(ViewerState& state, const std::string& failure);
    [[nodiscard]] double now_s() const;

    /// Lets the recorder go.
    void leave();

    TickRing& ticks_;
    LastWords& words_;
    Heartbeat heart_{};                       // before the recorder, which beats it
    std::vector<MediaDescription> opened_{};  // what the frames' media numbers mean, from 1 on
    std::unique_ptr<Recorder> recorder_{};    // null: not recording
    /// The last touch maps that were felt; a recording may begin with them.
    std::uint32_t maps_version_{0};
    std::vector<SessionMap> maps_{};
    std::uint64_t told_version_{0};           // of the parameters
    std::string participant_{}, note_{};      // as told
    std::string falcon_serial_{};             // known only when it has been found
    std::chrono::steady_clock::time_point start_{};
    std::string failure_{};  // of the first recording that broke off
};

}  // namespace dibhr
