// The window thread's control of a recording: start, stop, marks, facts, status.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/settings/keys.hpp"
#include "app/touching/touch_state.hpp"
#include "app/window/crash_note.hpp"
#include "core/clip/live_recorder.hpp"
#include "core/loop/felt_frames.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/session/recorder.hpp"
#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "device/hand/pose_ages.hpp"

namespace dibhr {

class TouchRecording {
  public:
    /// All arguments must outlive the object. The haptic loop writes `ticks`.
    TouchRecording(TickRing& ticks, CrashNote& crash_note, Player& player, FeltFrames& felt_frames,
                   const TouchStateRefs& state)
        : ticks_(ticks),
          crash_note_(crash_note),
          player_(player),
          felt_frames_(felt_frames),
          state_(state) {}

    /// Registers a video. Returns the number by which ticks refer to it.
    [[nodiscard]] std::uint32_t add_media(const MediaDescription& media);

    /// Throws InputError when the file cannot be made.
    void start(const std::filesystem::path& file);
    /// Records a live source: its video is saved beside the file, and ticks are recorded from its
    /// first saved frame on. Throws InputError.
    void start_live(const std::filesystem::path& file);
    /// Closes the file. Returns a notice, with `reason` where the user did not request the end;
    /// empty after a failure. A live video is finished by a thread: see take_finished().
    std::string stop(const std::string& reason = {});
    [[nodiscard]] bool active() const { return recorder_ != nullptr; }
    /// A recording is active, or waits for the first frame of a live video.
    [[nodiscard]] bool active_or_waiting() const { return active() || waiting_; }
    /// The file of a recording that waits for its first frame; else empty.
    [[nodiscard]] std::filesystem::path waiting_file() const {
        return waiting_ ? waiting_->file : std::filesystem::path{};
    }
    [[nodiscard]] bool finishing() const { return finishing_.valid(); }
    [[nodiscard]] std::optional<std::string> take_finished();

    /// Records parameters. Call it before they are published to the tick.
    void record_parameters(const HapticSettings& settings);

    /// Records the touch maps that ticks refer to by `version`. May be called after those ticks,
    /// once the maps are encoded.
    void maps(std::uint32_t version, std::vector<SessionMap> maps);

    /// Marks `moment` with the typed tag. Returns a notice, which may name a key of `keys`.
    std::string mark(const KeyTable& keys, std::chrono::steady_clock::time_point moment =
                                               std::chrono::steady_clock::now());

    /// Marks this moment. Does nothing without a recording.
    void mark(const std::string& tag);

    /// Once a turn: copies the recorder's status into the state and changed facts into the file.
    /// Ends a recording that failed, and switches the force off.
    void poll();
    /// Why a recording has failed since the last call; empty: none has.
    [[nodiscard]] std::string take_trouble() { return std::exchange(trouble_, {}); }

    /// At the end of the program. Waits at most `for_sums` for the hashes of large files. Throws
    /// InputError when a recording failed, or still waits for its first frame.
    void finish(std::chrono::milliseconds for_sums = Recorder::kPatience);

    /// Heartbeat of the thread that writes the file; no beats while that thread waits for the disk.
    [[nodiscard]] const Heartbeat& heart() const noexcept { return heart_; }

  private:
    struct KnownMedia {
        MediaDescription media{};
        bool grows{false};  ///< the video file is still being written
    };
    /// What the file has so far of a force device.
    struct RecordedDevice {
        PoseAges ages_before{};          ///< when the recording began
        std::uint64_t ages_recorded{0};  ///< number of poses in the ages last recorded
        std::string id{};                ///< empty until the device was found
    };
    /// Touch maps by their version.
    struct VersionOfMaps {
        std::uint32_t version{0};
        std::vector<SessionMap> maps{};
    };
    /// A live recording until its first frame comes.
    struct Waiting {
        std::filesystem::path file{};
        std::uint32_t number{0};
    };

    void record_maps(const VersionOfMaps& known);
    void record_media(std::uint32_t number, const KnownMedia& known);
    void start_at_first_frame();
    [[nodiscard]] std::string report_end(const RecorderStatus& recorded);
    void record_devices();
    void abort_recording(const std::string& failure);
    [[nodiscard]] double now_s() const;

    /// Ends the connection to recorder and live video.
    void release_recorder();

    TickRing& ticks_;
    CrashNote& crash_note_;
    Player& player_;
    FeltFrames& felt_frames_;
    TouchStateRefs state_;
    Heartbeat heart_{};                      // before recorder_, whose thread beats it
    std::vector<KnownMedia> known_media_{};  // by media number - 1
    std::unique_ptr<Recorder> recorder_{};   // null: not recording
    std::shared_ptr<LiveRecorder> live_{};   // null: the source is not live
    std::optional<Waiting> waiting_{};
    std::future<RecorderStatus> finishing_{};
    std::filesystem::path finishing_file_{};
    double finishing_s_{0.0};  // its length
    /// The last two that were in use: a recording begins with the last one, or as ticks still have
    /// the one before.
    std::vector<VersionOfMaps> last_maps_{};
    std::set<std::uint32_t> recorded_maps_{};         // their versions
    std::uint64_t recorded_version_{0};               // of the last recorded parameters
    std::string participant_{}, note_{};              // as recorded
    std::vector<RecordedDevice> recorded_devices_{};  // one for each of touch.devices
    std::string device_{};  // as recorded, where it is not the requested one
    std::chrono::steady_clock::time_point start_{};
    std::string failure_{};  // of the first recording that failed, for finish()
    std::string trouble_{};  // of the last one, for take_trouble()
};

}  // namespace dibhr
