// Recording what is touched: start, stop, marks, and what is told of it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/settings/keys.hpp"
#include "app/touching/touch_state.hpp"
#include "app/window/last_words.hpp"
#include "core/clip/live_recorder.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/session/recorder.hpp"
#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "device/hand/pose_ages.hpp"

namespace dibhr {

class TouchRecording {
  public:
    /// All outlive it; `ticks` is the haptic loop's end.
    TouchRecording(TickRing& ticks, LastWords& words, Player& player, const TouchedState& state)
        : ticks_(ticks), words_(words), player_(player), state_(state) {}

    /// A video that ticks will refer to by the number given back.
    [[nodiscard]] std::uint32_t opened(const MediaDescription& media);

    /// Throws InputError when the file cannot be made.
    void start(const std::filesystem::path& file);
    /// Of what is live: its video is kept beside the file, and ticks are recorded from the first
    /// frame of that on. Throws InputError.
    void start_live(const std::filesystem::path& file);
    /// Closes the file. A short notice, with the reason where nobody asked for it; empty when
    /// writing had broken off. With a video it is finished meanwhile: take_finished() tells.
    std::string stop(const std::string& reason = {});
    [[nodiscard]] bool active() const { return recorder_ != nullptr; }
    /// It is, or waits for the first frame of a video.
    [[nodiscard]] bool asked_for() const { return active() || waiting_; }
    /// The file of one that waits; else empty.
    [[nodiscard]] std::filesystem::path waits_with() const {
        return waiting_ ? waiting_->file : std::filesystem::path{};
    }
    [[nodiscard]] bool finishing() const { return finishing_.valid(); }
    [[nodiscard]] std::optional<std::string> take_finished();

    /// Parameters that the next tick will have; to be called before it gets them.
    void hand_over(const HapticSettings& settings);

    /// The touch maps that ticks refer to by that version; to be called once they are known, also
    /// after the ticks.
    void maps(std::uint32_t version, std::vector<SessionMap> maps);

    /// Marks `moment` with the tag that was typed. A short notice, which names a key of `keys`.
    std::string mark(const KeyTable& keys, std::chrono::steady_clock::time_point moment =
                                               std::chrono::steady_clock::now());

    /// Marks this moment. Nothing is recorded: does nothing.
    void mark(const std::string& tag);

    /// Once a picture: how it goes, into the state; what a person typed, into the file. A recording
    /// that broke off ends, and takes the force off.
    void poll();
    /// Why one has broken off since the last call; empty: none has.
    [[nodiscard]] std::string take_trouble() { return std::exchange(trouble_, {}); }

    /// At the end of the program; waits so long for sums of large files. Throws InputError when a
    /// recording broke off, or still waits.
    void finish(std::chrono::milliseconds for_sums = Recorder::kPatience);

    /// Of the thread that writes: silent while that waits for the disk.
    [[nodiscard]] const Heartbeat& heart() const noexcept { return heart_; }

  private:
    struct Opened {
        MediaDescription media{};
        bool grows{false};  ///< it is a video that is being recorded
    };
    /// Of a force device, in the file.
    struct ToldDevice {
        PoseAges ages_before{};      ///< when the recording began
        std::uint64_t ages_told{0};  ///< how many since then
        std::string id{};            ///< known only when it has been found
    };
    /// Until its first frame is there.
    struct Waiting {
        std::filesystem::path file{};
        std::uint32_t number{0};
    };

    void tell_media(std::uint32_t number, const Opened& opened);
    void begin_if_there();
    [[nodiscard]] std::string told(const RecorderStatus& recorded);
    void tell_devices();
    void break_off(const std::string& failure);
    [[nodiscard]] double now_s() const;

    /// Lets the recorder go.
    void leave();

    TickRing& ticks_;
    LastWords& words_;
    Player& player_;
    TouchedState state_;
    Heartbeat heart_{};                     // before the recorder, which beats it
    std::vector<Opened> opened_{};          // what the frames' media numbers mean, from 1 on
    std::unique_ptr<Recorder> recorder_{};  // null: not recording
    std::shared_ptr<LiveRecorder> live_{};  // null: what is touched is not live
    std::optional<Waiting> waiting_{};
    std::future<RecorderStatus> finishing_{};
    std::filesystem::path finishing_file_{};
    /// The last touch maps that were felt; a recording may begin with them.
    std::uint32_t maps_version_{0};
    std::vector<SessionMap> maps_{};
    std::uint64_t told_version_{0};           // of the parameters
    std::string participant_{}, note_{};      // as told
    std::vector<ToldDevice> told_devices_{};  // one a device that is looked for
    std::string device_{};                    // told of the session, where not the one asked for
    std::chrono::steady_clock::time_point start_{};
    std::string failure_{};  // of the first recording that broke off,
    std::string trouble_{};  // and of the last one, to be told
};

}  // namespace dibhr
