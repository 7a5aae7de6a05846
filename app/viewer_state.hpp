// What the window shows and what a person changes in it: plain data that every panel reads and
// edits.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/haptic_loop.hpp"
#include "app/settings.hpp"
#include "app/window_gui.hpp"
#include "core/session/recorder.hpp"
#include "core/video/media.hpp"
#include "core/video/player.hpp"
#include "device/device.hpp"

namespace dibhr {

/// The last seconds of the force's length, one value a tick, for the strip chart.
struct ForceHistory {
    static constexpr std::size_t kTicks = 4000;

    std::array<float, kTicks> newton{};
    std::size_t next{0};  ///< the oldest value, overwritten by the next one

    void add(double value_newton) {
        newton[next] = static_cast<float>(value_newton);
        next = (next + 1) % kTicks;
    }
};

/// Files a person wants to see; an empty depth is found beside the colour file.
struct OpenRequest {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
    bool in_any_order{false};  ///< dropped together: which is which is found out
};

/// Text fields of the panels.
struct TextFields {
    static constexpr std::size_t kLength = 1024;
    using Field = std::array<char, kLength>;

    Field colour{};
    Field depth{};
    Field bump{};
    int ask_for_keyboard{0};  ///< Ctrl+O: pictures left in which the colour field asks for the keyboard
};

/// What a panel asks the viewer to do after the picture.
struct Requests {
    std::optional<OpenRequest> open{};
    std::optional<std::filesystem::path> bump{};  ///< empty path: no bump map
    bool reset_view{false};
    bool screenshot{false};
    bool full_screen{false};
    bool quit{false};
};

struct ViewerState {
    Settings settings{};  ///< live: panels write here, the next tick and picture use it
    bool force_enabled{true};
    std::shared_ptr<const BumpMap> bump{};
    std::filesystem::path bump_file{};

    // Shown only.
    DeviceSpecification device{};
    MediaDescription media{};
    PlaybackStatus playback{};
    HapticState haptic{};
    std::optional<RealtimeGrants> grants{};
    std::optional<RecorderStatus> recording{};
    std::filesystem::path recording_file{};
    ForceHistory forces{};
    double pictures_per_s{0.0};
    bool opening{false};
    bool touched{false};  ///< there has been a contact: the first hint has done its work

    bool help_open{false};
    std::string message{};  ///< shown in a box until it is closed
    std::string notice{};   ///< shown for a while at the bottom
    double notice_until_s{0.0};
    TextFields fields{};
    Requests requests{};
    Fonts fonts{};
    float scale{1.0F};         ///< screen pixels of a layout pixel
    float window_width{1.0F};  ///< [px]
};

}  // namespace dibhr
