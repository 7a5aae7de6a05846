// Lets game pads rumble with what is touched, away from all other threads.
#pragma once

#include <memory>
#include <thread>
#include <vector>

#include "app/sound/pads.hpp"
#include "app/sound/touch_source.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// What is known of game pads.
struct PadNews {
    enum class State { off, no_session, looking };

    State state{State::off};  ///< no_session: without a desktop session none is looked for
    std::vector<FoundPad> found{};

    /// One of them has voice coils.
    [[nodiscard]] bool has_coils() const;

    bool operator==(const PadNews&) const = default;
};

/// From construction to destruction. While it is on it looks for pads twice a second, and tells
/// those that are there a hundred times a second how strongly to rumble. That there is none, or no
/// longer, is no error. No pad moves the hand.
class PadOutput {
  public:
    /// Off at first.
    explicit PadOutput(const std::shared_ptr<TouchSource>& source);
    /// The motors stop. Waits half a second for a pad at most: one that hangs is left alone.
    ~PadOutput();
    PadOutput(const PadOutput&) = delete;
    PadOutput& operator=(const PadOutput&) = delete;

    /// The window thread's. `coils_move`: by sound, so that pads which have them need not rumble.
    void choose(const SoundMaterial& material, bool on, bool coils_move);

    /// The window thread's.
    [[nodiscard]] PadNews news() const;

  private:
    class Work;

    std::shared_ptr<Work> work_;  // with the thread, which may outlive this
    SoundMaterial chosen_{};
    std::thread thread_;
};

}  // namespace dibhr
