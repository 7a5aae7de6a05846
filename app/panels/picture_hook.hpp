// Follows the window from outside, picture by picture.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "app/panels/viewer_state.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Where a participant of a study is.
struct StudyPlace {
    int step{0};          ///< a StudyStep
    int trial{0};         ///< number of the running trial, from 0
    int interval{0};      ///< of it, from 0
    bool waits{false};    ///< the interval's surface is not there yet
    bool leaving{false};  ///< the participant is asked whether to leave
    bool agrees{false};   ///< whoever leads it is asked whether it may protect the hand less
    /// When what is asked was on the screen; nothing: it is not yet.
    std::optional<std::chrono::steady_clock::time_point> seen_since{};
};

/// A picture that the window has just shown; valid during the call.
struct PictureShown {
    const Settings& settings;
    const TouchState& touch;
    const MediaState& media;
    const DepthBlend& surface;
    const UiState* ui{nullptr};        ///< the viewer's; null: it is a study's window
    const StudyPlace* study{nullptr};  ///< null: it is the viewer's
};

/// Called on the window's thread after each picture. The tests' build of the program follows the
/// window by it; the shipped program passes none.
using PictureHook = std::function<void(const PictureShown&)>;

}  // namespace dibhr
