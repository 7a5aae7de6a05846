// What a participant sees of a study beside the relief: pages, questions, and what is pressed
// there.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/study/study_run.hpp"

namespace dibhr {

/// What a person does at a step, by key, mouse or the grip's buttons.
struct StudyPress {
    enum class Kind : std::uint8_t {
        go_on,   ///< leaves a page, an interval, feedback, a break; "equal" of an adjustment
        choose,  ///< answer `which`
        rate,    ///< `value`
        mark,    ///< moves the mark of a scale to `value`, without answering
        feel,    ///< interval `which`: once more at a question; at an adjustment the other one
        turn,    ///< the parameter, by `value` of its range
        scroll,  ///< a page, down by `value` lines
        agree,   ///< to StudyShown::to_agree
        early,   ///< would answer, but came before the question was on the screen
        ask_to_leave,
        stay,
        leave
    };

    Kind kind{Kind::go_on};
    int which{0};
    double value{0.0};
};

/// What the pages show beside the run's own step.
struct StudyShown {
    bool waits{false};          ///< an interval whose surface is not there yet
    bool asks_to_leave{false};  ///< the participant pressed Escape
    bool before_start{false};   ///< the program has begun, and nobody has called for the step yet
    std::string to_agree{};     ///< what the study takes away, before its start; empty: nothing
    bool first_picture{false};  ///< of the page that is shown
    float scroll{0.0F};         ///< of it since the last picture, down by so many lines
    double left_share{1.0};     ///< of the time of an interval or an answer; 1 without a limit
    bool has_limit{false};
    std::optional<double> mark{};  ///< on a scale; nothing: not chosen yet
    bool by_mouse{false};          ///< no force device touches
    std::string device_words{};    ///< what the device needs; empty: nothing
    std::uintptr_t picture{0};     ///< texture of the page's picture; 0: none
    int picture_columns{1}, picture_rows{1};
};

/// Whether the question is answered on a line instead of by one button each.
[[nodiscard]] bool has_wide_scale(const Question& question) noexcept;

/// Into ImGui's picture, over all of it. What was clicked.
[[nodiscard]] std::optional<StudyPress> draw_study(const StudyRun& run, const StudyShown& view);

/// Whether the mouse is over something to click: elsewhere it touches the relief.
[[nodiscard]] bool mouse_is_over_button();

/// A key that went down.
struct StudyKey {
    std::string name{};  ///< as name_of(Key) has it, or the character typed
    bool shift{false};
    bool early{false};  ///< before what is asked now was on the screen
};

/// What it does; nothing: nothing.
[[nodiscard]] std::optional<StudyPress> press_of_key(const StudyRun& run, const StudyShown& view,
                                                     const StudyKey& key);

/// The button whose long press does something else than its press, at an adjustment.
inline constexpr int kLongPressButton = 2;

/// A button of the grip that went down.
struct StudyButton {
    int number{0};      ///< from 0
    bool held{false};   ///< for a second
    bool early{false};  ///< as StudyKey::early
};

/// What it does: the answers by number; the first one also goes on. On a scale
/// the first two put the mark there, then move it, and the third one answers; at an adjustment the
/// first two turn, the third one feels the other or, held, says equal.
[[nodiscard]] std::optional<StudyPress> press_of_button(const StudyRun& run, const StudyShown& view,
                                                        const StudyButton& button);

struct EndedPress {
    bool held{false};                            ///< long
    std::chrono::steady_clock::time_point at{};  ///< it began, or had been held for long enough
};

/// Tells a long press of that button from a short one, when it is let go of or has been held for a
/// second.
class LongPress {
  public:
    using Clock = std::chrono::steady_clock;

    void begin(Clock::time_point now) noexcept { since_ = now; }
    void forget() noexcept { since_.reset(); }
    /// Once it is known whether it was long; then it is forgotten.
    [[nodiscard]] std::optional<EndedPress> ended(Clock::time_point now, bool down) noexcept;

  private:
    std::optional<Clock::time_point> since_{};
};

}  // namespace dibhr
