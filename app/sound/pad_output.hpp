// Makes game pads rumble with the touch, on a thread of its own.
#pragma once

#include <memory>
#include <thread>
#include <vector>

#include "app/sound/pads.hpp"
#include "app/sound/touch_source.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// The game pads found, or why none is looked for.
struct PadInfo {
    enum class State { off, no_session, looking };

    State state{State::off};  ///< no_session: no desktop session, so no pad is looked for
    std::vector<FoundPad> found{};

    /// Whether a found pad has voice coils.
    [[nodiscard]] bool has_coils() const;

    bool operator==(const PadInfo&) const = default;
};

/// While switched on, its thread scans for pads twice a second, and sends them the strength of the
/// rumble a hundred times a second. A missing or lost pad is no error. Input from pads is ignored:
/// they do not move the hand.
class PadOutput {
  public:
    /// Starts switched off.
    explicit PadOutput(const std::shared_ptr<TouchSource>& source);
    /// Stops the motors. Waits at most half a second: a thread that hangs in a driver is detached.
    ~PadOutput();
    PadOutput(const PadOutput&) = delete;
    PadOutput& operator=(const PadOutput&) = delete;

    /// For the window's thread. `coils_move`: by sound; then pads that have coils do not rumble.
    void choose(const SoundMaterial& material, bool on, bool coils_move);

    /// For the window's thread.
    [[nodiscard]] PadInfo info() const;

  private:
    class Work;

    std::shared_ptr<Work> work_;  // shared with the thread, which may outlive this object
    SoundMaterial chosen_{};
    std::thread thread_;
};

}  // namespace dibhr
