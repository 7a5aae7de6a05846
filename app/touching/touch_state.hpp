// What touches, what is touched, and what came of it: plain data of a window, which a TouchSession
// fills, and panels show and edit.
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
#include "core/session/recorder.hpp"
#include "core/session/tick_record.hpp"
#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "device/force_device.hpp"

namespace dibhr {

/// What the strip charts can show, and what of the last seconds they do show.
enum class Strip { force, penetration, speed, energy, lateness };
inline constexpr std::size_t kStrips = 5;

/// The last ticks, one value of each kind a tick.
struct StripHistory {
    static constexpr std::size_t kTicks = 4000;

    std::array<std::array<float, kTicks>, kStrips> values{};
    std::size_t next{0};  ///< the oldest value, overwritten by the next one
    double given_millijoule{0.0};

    void add(const TickStrip& strip) {
        if (std::isfinite(strip.given_millijoule))
            given_millijoule += static_cast<double>(strip.given_millijoule);
        const std::array<float, kStrips> now{
            strip.force_newton, strip.penetration_mm, strip.speed_mm_per_s,
            static_cast<float>(given_millijoule), strip.lateness_us};
        for (std::size_t k = 0; k < kStrips; ++k) values[k][next] = now[k];
        next = (next + 1) % kTicks;
    }
    /// `age` ticks before the last one.
    [[nodiscard]] float before(Strip strip, std::size_t age) const {
        return values[static_cast<std::size_t>(strip)][(next + kTicks - 1 - age) % kTicks];
    }
};

/// A line to type into.
using TextField = std::array<char, 1024>;

/// What a person types of a recording.
struct SessionFields {
    TextField participant{};  ///< kept with it
    TextField note{};
    TextField tag{};  ///< of the next mark
};

/// What the window shows of a recording that is going on.
struct RecordingNews {
    RecorderStatus status{};
    std::filesystem::path file{};
    double time_s{0.0};                ///< since it began
    std::vector<SessionMark> marks{};  ///< times since it began
};

/// What the window shows of a replay.
struct ReplayNews {
    std::filesystem::path file{};
    std::string participant{}, note{}, started{}, device{};
    std::vector<SessionMark> marks{};  ///< times as the ticks'
    SessionPlayback playback{};
    TickRecord tick{};                     ///< as recorded
    std::int64_t tick_count{0};            ///< its number as people count: from 0
    bool computes{false};                  ///< other parameters were chosen
    bool computed{false};                  ///< what is shown was computed through them
    const ContactBand* contacts{nullptr};  ///< null: not yet summed up
};

/// What the window shows of a force device that is looked for.
struct DeviceNews {
    std::size_t kind{0};  ///< its place in force_device_kinds()
    DeviceState state{};
    bool asked{false};               ///< the state is the device's answer; before, anything may be
    bool was_ready{false};           ///< in this run: when it is not now, it was lost
    std::vector<DeviceLine> kept{};  ///< what a service keeps of it for all programs
};

struct TouchState {
    // What a person chooses.
    bool force_enabled{true};
    std::uint32_t centred{0};  ///< counts the wishes to forget the clutch's shift
    std::shared_ptr<const BumpMap> bump{};
    std::filesystem::path bump_file{};
    Material material{};  ///< chosen last; numbers and bump map may have been changed since
    SessionFields session_fields{};

    // Shown only.
    bool in_front{true};  ///< the window; false: people work in another one
    DeviceSpecification device{};
    std::vector<DeviceNews> devices{};  ///< that are looked for, in the order of their kinds
    bool needs_person{false};           ///< a device: until the Device panel is in sight
    HapticState haptic{};
    bool catching_up{false};  ///< the proxy is, or was a moment ago: long enough to be read
    std::vector<AlgorithmProxy> others{};  ///< for the same goal; empty: not asked for, or unknown
    StripHistory strips{};
    std::optional<RealtimeGrants> grants{};
    std::optional<RecordingNews> recording{};
    std::string recording_trouble{};        ///< why the last recording broke off
    std::filesystem::path recorded_file{};  ///< the last one; empty: none yet
    std::optional<ReplayNews> replay{};     ///< nothing: a hand touches
    SoundOutput::State sound{SoundOutput::State::quiet};
    bool moves_coils{false};  ///< of a game pad
    PadNews pads{};

    /// What is seen is what is felt: a changed one is on its way. `chosen`: of the settings.
    [[nodiscard]] const SurfaceShape& shape(const TouchParameters& chosen) const noexcept {
        return haptic.touchable ? haptic.shape : chosen.shape;
    }
};

/// Files a person wants to see; an empty depth is found beside the colour file.
struct OpenRequest {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
    bool in_any_order{false};  ///< dropped together: which is which is found out
    DepthRequest request{usual_depth_request()};
    bool chosen{false};  ///< other words on the panel, to be kept once they have opened it
    double at_s{0.0};    ///< where to go on [s]
    bool paused{false};  ///< and to stand still there
    bool again{false};   ///< what is live has changed: it is tried until it comes
};

/// What is opened, and how it plays.
struct MediaState : MediaDescription {
    PlaybackStatus playback{};
    OpenRequest opened{};  ///< how it was opened
    std::vector<RecentFile> recent{};
    bool opening{false};
    bool as_recorded{false};  ///< the depth, while its key is held

    void describe(const MediaDescription& now) { static_cast<MediaDescription&>(*this) = now; }
};

/// What a TouchSession works on; it is the window's, and outlives the session.
struct TouchedState {
    const Settings& settings;
    TouchState& touch;
    MediaState& media;
};

}  // namespace dibhr
