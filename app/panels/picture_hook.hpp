// A hook that observes the window after each turn of its loop.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "app/panels/viewer_state.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// The position of a participant in a study.
struct StudyPosition {
    int step{0};               ///< a StudyStep
    int trial{0};              ///< number of the running trial, from 0
    int interval{0};           ///< of the trial, from 0
    bool waits{false};         ///< the interval's surface is not ready
    bool leaving{false};       ///< the participant is asked whether to leave
    bool asks_consent{false};  ///< the experimenter is asked whether the study may protect less
    /// When the question appeared on the screen; nothing: not yet.
    std::optional<std::chrono::steady_clock::time_point> seen_since{};
};

/// The picture that the window shows; valid during the call.
struct PictureShown {
    const Settings& settings;
    const TouchState& touch;
    const MediaState& media;
    const DepthBlend& surface;
    const UiState* ui{nullptr};           ///< the viewer's; null in a study's window
    const StudyPosition* study{nullptr};  ///< null in the viewer's window
    bool drawn{true};  ///< in this turn; false: it would look the same, or nobody can see it
};

/// Called on the window's thread after each turn of its loop. The tests' build of the program
/// observes the window by it; the shipped program sets none.
using PictureHook = std::function<void(const PictureShown&)>;

}  // namespace dibhr
