// The pages and questions that a participant sees beside the relief, and the presses there.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/study/study_run.hpp"

namespace dibhr {

/// What a participant does at a step, by key, mouse or device buttons.
struct StudyPress {
    enum class Kind : std::uint8_t {
        go_on,   ///< leaves a page, an interval, feedback, a break; at an adjustment: "equal"
        choose,  ///< answer `which`
        rate,    ///< `value`
        mark,    ///< moves the mark of a scale to `value`, without answering
        feel,    ///< feel interval `which` again (question), or the other one (adjustment)
        turn,    ///< changes the parameter by `value` of its range
        scroll,  ///< scrolls a page down by `value` lines
        agree,   ///< to StudyShown::consent_text
        early,   ///< an answer before the question was on the screen
        ask_to_leave,
        stay,
        leave
    };

    Kind kind{Kind::go_on};
    int which{0};
    double value{0.0};
};

/// What the pages show in addition to the run's step.
struct StudyShown {
    bool waits{false};           ///< the interval's surface is not ready yet
    bool asks_to_leave{false};   ///< the participant pressed Escape
    bool before_start{false};    ///< the program has started; the participant has not begun
    std::string consent_text{};  ///< protections that the study weakens; empty: none
    bool first_picture{false};   ///< the shown page is new
    bool pointer_moved{true};    ///< since the question is on the screen
    float scroll{0.0F};          ///< lines to scroll down since the last picture
    double left_share{1.0};      ///< remaining share of a time limit; 1 without a limit
    bool has_limit{false};
    std::optional<double> mark{};  ///< mark on a scale; nothing: not set yet
    bool by_mouse{false};          ///< no force device touches
    std::string device_words{};    ///< message about the device; empty: none
    std::uintptr_t picture{0};     ///< texture of the page's picture; 0: none
    int picture_columns{1}, picture_rows{1};
};

/// Whether a rating is given on a line instead of by one button for each number.
[[nodiscard]] bool has_wide_scale(const Question& question) noexcept;

/// Draws over the whole window. Returns what was clicked.
[[nodiscard]] std::optional<StudyPress> draw_study(const StudyRun& run, const StudyShown& view);

/// Whether the mouse is over a control: elsewhere it touches the relief.
[[nodiscard]] bool mouse_is_over_button();

/// A key that went down.
struct StudyKey {
    std::string name{};  ///< name_of(Key), or the typed character
    bool shift{false};
    bool early{false};  ///< pressed before the current question was on the screen
};

/// What the key does; nothing: no effect.
[[nodiscard]] std::optional<StudyPress> press_of_key(const StudyRun& run, const StudyShown& view,
                                                     const StudyKey& key);

/// At an adjustment, a long press of this button differs from a short one.
inline constexpr int kLongPressButton = 2;

/// A press of a device button.
struct StudyButton {
    int number{0};      ///< from 0
    bool held{false};   ///< for a second
    bool early{false};  ///< as StudyKey::early
};

/// What the button does. Button n gives answer n; the first one also goes on. On a scale the first
/// two set and move the mark, and the third one answers. At an adjustment the first two change the
/// parameter; the third one feels the other interval or, held, answers "equal".
[[nodiscard]] std::optional<StudyPress> press_of_button(const StudyRun& run, const StudyShown& view,
                                                        const StudyButton& button);

struct EndedPress {
    bool held{false};                            ///< long
    std::chrono::steady_clock::time_point at{};  ///< begin of the press, or a second later if long
};

/// Tells a long press of kLongPressButton from a short one: on release, or after one second.
class LongPress {
  public:
    using Clock = std::chrono::steady_clock;

    void begin(Clock::time_point now) noexcept { since_ = now; }
    void forget() noexcept { since_.reset(); }
    /// The press, once it is known whether it is long; then it is reset.
    [[nodiscard]] std::optional<EndedPress> ended(Clock::time_point now, bool down) noexcept;

  private:
    std::optional<Clock::time_point> since_{};
};

}  // namespace dibhr
