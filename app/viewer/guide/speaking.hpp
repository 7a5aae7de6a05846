// What the window says: messages, notices, and what is under the finger.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/sound/speaker.hpp"

namespace dibhr {

/// What can be spoken of a moment.
struct Spoken {
    std::string message{};  ///< of the box
    std::string notice{};   ///< in words; empty: none is shown
    std::string lead{};     ///< what the first start shows
    std::string focus{};    ///< the part of a panel that has the keyboard: "Mute, check box"
    std::string value{};    ///< and its value; spoken after it, or alone where only it has changed
    std::string help{};     ///< its tooltip, once the keyboard rests on it
    std::string region{};   ///< the name of what is under the finger
    std::string text{};     ///< and its text, once the finger rests
    std::string caption{};  ///< of the recording

    bool operator==(const Spoken&) const = default;
};

/// The text that changed and matters most; empty: nothing new is to be said. Texts that end are not
/// news.
[[nodiscard]] std::string news_of(const Spoken& now, const Spoken& before);

class ViewerSpeaking {
  public:
    /// Once a turn. Speaks what is new, in place of what is older, while `on`; help waits until the
    /// text before is spoken. Returns a line on why nothing can be spoken, once.
    [[nodiscard]] std::optional<std::string> follow(Spoken now, double now_s, bool on);
    /// Says the last news again; `on` as of the last turn.
    void repeat();

  private:
    std::unique_ptr<Speaker> speaker_{};  // null: off
    Spoken last_{};
    std::string said_{};
    double focus_since_s_{0.0};  // the item has the keyboard
};

/// Of the window's state at that time.
[[nodiscard]] Spoken spoken_of(const ViewerState& state, double now_s);

}  // namespace dibhr
