// State of touching and of the media: plain data of a window. A TouchSession fills it, panels show
// and edit it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/material.hpp"
#include "app/settings/recent_files.hpp"
#include "app/settings/settings.hpp"
#include "app/sound/pad_output.hpp"
#include "app/sound/sound_output.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/surface.hpp"
#include "core/loop/device.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/loop/tick_strip.hpp"
#include "core/realtime/tick_timer.hpp"
#include "core/replay/session_player.hpp"
#include "core/session/felt_surface.hpp"
#include "core/session/recorder.hpp"
#include "core/session/tick_record.hpp"
#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "device/force_device.hpp"

namespace dibhr {

/// The values that strip charts can show.
enum class Strip { force, penetration, speed, energy, lateness };
inline constexpr std::size_t kStrips = 5;

/// The last ticks, one value of each kind a tick.
struct StripHistory {
    static constexpr std::size_t kTicks = 4000;

    std::array<std::array<float, kTicks>, kStrips> values{};
    std::size_t next{0};  ///< the oldest value, overwritten by the next one
    double work_millijoule{0.0};

    void add(const TickStrip& strip) {
        if (std::isfinite(strip.work_millijoule))
            work_millijoule += static_cast<double>(strip.work_millijoule);
        const std::array<float, kStrips> now{
            strip.force_newton, strip.penetration_mm, strip.speed_mm_per_s,
            static_cast<float>(work_millijoule), strip.lateness_us};
        for (std::size_t k = 0; k < kStrips; ++k) values[k][next] = now[k];
        next = (next + 1) % kTicks;
    }
    /// `age` ticks before the last one.
    [[nodiscard]] float before(Strip strip, std::size_t age) const {
        return values[static_cast<std::size_t>(strip)][(next + kTicks - 1 - age) % kTicks];
    }
};

/// A line to type into.
using TextField = std::array<char, 4096>;  // a path, or 600 letters of any script

/// What a person types about a recording.
struct SessionFields {
    TextField participant{};  ///< stored as a fact of the recording
    TextField note{};
    TextField tag{};  ///< of the next mark
};

/// What the window shows of a recording that is going on.
struct RecordingInfo {
    RecorderStatus status{};
    std::filesystem::path file{};
    double time_s{0.0};                ///< since it began
    std::vector<SessionMark> marks{};  ///< times since it began
};

/// What the window shows of a replay.
struct ReplayInfo {
    std::filesystem::path file{};
    std::string participant{}, note{}, started{}, device{};
    std::vector<SessionMark> marks{};  ///< times as the ticks'
    SessionPlayback playback{};
    TickRecord tick{};                     ///< as recorded
    std::int64_t tick_count{0};            ///< number of the tick in the file, from 0
    bool computes{false};                  ///< other parameters were chosen
    bool computed{false};                  ///< the shown tick was computed with them
    const ContactBand* contacts{nullptr};  ///< null: not yet computed
};

/// What the window shows of a force device that is looked for.
struct DeviceInfo {
    std::size_t kind{0};  ///< index in force_device_kinds()
    DeviceState state{};
    bool answered{false};            ///< `state` came from the device; before, its state is unknown
    bool was_ready{false};           ///< at some time in this run; not ready now: lost
    std::vector<DeviceLine> kept{};  ///< settings that a service stores for all programs
};

struct TouchState {
    // What a person chooses.
    bool force_enabled{true};
    bool depth_in_question{false};  ///< what the depth means is being asked: no force
    std::uint32_t centre_count{0};  ///< counts requests to centre the workspace
    std::shared_ptr<const BumpMap> bump{};
    std::filesystem::path bump_file{};
    Material material{};  ///< last choice; its values may have been changed since
    SessionFields session_fields{};
    SurfaceRecording record_surface{SurfaceRecording::tiles};  ///< of the next recording
    bool record_preview{true};                                 ///< pictures beside the surface

    // Shown only.
    bool in_front{true};  ///< the window is; false: another window is in front
    DeviceSpecification device{};
    std::vector<DeviceInfo> devices{};  ///< the devices in use, in the order of their kinds
    bool needs_person{false};           ///< a device does; reset when its panel is visible
    HapticState haptic{};
    bool catching_up{false};               ///< the proxy is, or was within the last 0.3 s
    std::vector<AlgorithmProxy> others{};  ///< for the same goal; empty: off, or unknown
    StripHistory strips{};
    std::optional<RealtimeGrants> grants{};
    std::optional<RecordingInfo> recording{};
    std::string recording_trouble{};        ///< why the last recording broke off
    std::filesystem::path recorded_file{};  ///< the last one; empty: none yet
    std::optional<ReplayInfo> replay{};     ///< nothing: a hand touches
    SoundOutput::State sound{SoundOutput::State::quiet};
    bool moves_coils{false};  ///< of a game pad
    PadInfo pads{};

    /// The last tick's shape, so that the picture shows what is felt. `chosen`: the settings.
    [[nodiscard]] const SurfaceShape& shape(const TouchParameters& chosen) const noexcept {
        return haptic.touchable ? haptic.shape : chosen.shape;
    }
};

/// Files to open; an empty depth is searched beside the colour file.
struct OpenRequest {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
    bool in_any_order{false};  ///< dropped together: colour and depth are told apart
    DepthRequest request{usual_depth_request()};
    bool chosen{false};     ///< depth statements of the panel, saved once the file is open
    double at_s{0.0};       ///< where to begin [s]
    bool paused{false};     ///< begin paused
    bool reconnect{false};  ///< a live source changed its form: retry until it opens
};

/// The open media, and how it plays.
struct MediaState : MediaDescription {
    PlaybackStatus playback{};
    OpenRequest opened{};  ///< the request that opened it
    std::vector<RecentFile> recent{};
    bool opening{false};
    bool as_recorded{false};  ///< raw depth is shown, while its key is held

    void describe(const MediaDescription& now) { static_cast<MediaDescription&>(*this) = now; }
};

/// References to the window's state that a TouchSession uses; it must outlive the session.
struct TouchStateRefs {
    const Settings& settings;
    TouchState& touch;
    MediaState& media;
};

}  // namespace dibhr
