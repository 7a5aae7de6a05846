// What keys and the grip's buttons do at each step.
#include <cmath>

#include "app/study/study_pages.hpp"

namespace dibhr {

namespace {

using Press = std::optional<StudyPress>;
using Kind = StudyPress::Kind;

/// By how many lines a page's text goes down; those of a question leave Up and Down to its answers.
Press scroll_key(const StudyRun& run, std::string_view key) {
    constexpr double kLine = 2.0;
    constexpr double kPage = 12.0;
    if (key == "Page up") return StudyPress{Kind::scroll, 0, -kPage};
    if (key == "Page down") return StudyPress{Kind::scroll, 0, kPage};
    if (run.step() == StudyStep::question) return std::nullopt;
    if (key == "Up") return StudyPress{Kind::scroll, 0, -kLine};
    if (key == "Down") return StudyPress{Kind::scroll, 0, kLine};
    return std::nullopt;
}

/// "3" of a digit.
std::optional<int> digit_of(std::string_view key) {
    if (key.size() != 1 || key[0] < '0' || key[0] > '9') return std::nullopt;
    return key[0] - '0';
}

Press answer_by_digit(const StudyRun& run, int digit) {
    const Block& block = run.block();
    if (block.form == TrialForm::rating) {
        if (has_wide_scale(block.question)) return std::nullopt;
        const StudyAnswer answer{.number = static_cast<double>(digit)};
        return run.takes(answer) ? Press(StudyPress{Kind::rate, 0, *answer.number}) : std::nullopt;
    }
    const StudyAnswer answer{.choice = digit - 1};
    return digit >= 1 && run.takes(answer) ? Press(StudyPress{Kind::choose, digit - 1})
                                           : std::nullopt;
}

/// The first press puts the mark into the middle, whichever way it points.
StudyPress moved_mark(const Question& question, const StudyShown& view, double by) {
    const double middle = std::round(0.5 * (question.lowest + question.highest));
    return {Kind::mark, 0, view.mark ? *view.mark + by : middle};
}

/// Nobody answers what they have not chosen.
Press rate(const StudyShown& view) {
    return view.mark ? Press(StudyPress{Kind::rate, 0, *view.mark}) : std::nullopt;
}

Press question_key(const StudyRun& run, const StudyShown& view, std::string_view key, bool shift) {
    if (const auto digit = digit_of(key)) return answer_by_digit(run, *digit);
    const Block& block = run.block();
    if (block.form == TrialForm::rating) {
        const double step = shift ? 10.0 : 1.0;
        if (key == "Enter") return rate(view);
        if (key == "Left" || key == "Down") return moved_mark(block.question, view, -step);
        if (key == "Right" || key == "Up") return moved_mark(block.question, view, step);
        return std::nullopt;
    }
    const bool of_two = block.form == TrialForm::two_interval ||
                        (block.form == TrialForm::explore && block.question.answers.size() == 2);
    if (of_two && key == "Left") return StudyPress{Kind::choose, 0};
    if (of_two && key == "Right") return StudyPress{Kind::choose, 1};
    return std::nullopt;
}

Press adjustment_key(const StudyRun& run, std::string_view key, bool shift) {
    const double step = shift ? 0.002 : 0.02;
    if (key == "1") return StudyPress{Kind::feel, 0};
    if (key == "2") return StudyPress{Kind::feel, 1};
    if (key == "Tab") return StudyPress{Kind::feel, 1 - run.interval()};
    if (key == "Enter") return StudyPress{Kind::go_on};
    if (run.interval() == 0) return std::nullopt;
    if (key == "Up" || key == "Right") return StudyPress{Kind::turn, 0, step};
    if (key == "Down" || key == "Left") return StudyPress{Kind::turn, 0, -step};
    return std::nullopt;
}

}  // namespace

std::optional<StudyPress> press_of_key(const StudyRun& run, const StudyShown& view,
                                       std::string_view key, bool shift) {
    if (view.asks_to_leave) {
        if (key == "Esc" || key == "Enter") return StudyPress{Kind::stay};
        if (key == "l" || key == "L") return StudyPress{Kind::leave};
        return std::nullopt;
    }
    if (key == "Esc") return StudyPress{Kind::ask_to_leave};
    if (view.waits) return std::nullopt;  // for the surface, or the next step
    if (!view.before_start && run.step() == StudyStep::adjust)
        return adjustment_key(run, key, shift);
    if (!view.before_start && run.step() == StudyStep::question) {
        if (const auto press = question_key(run, view, key, shift)) return press;
    } else if (key == "Enter" || key == " ") {
        return StudyPress{Kind::go_on};
    }
    return scroll_key(run, key);
}

std::optional<StudyPress> press_of_button(const StudyRun& run, const StudyShown& view, int button,
                                          bool held) {
    if (view.waits || view.asks_to_leave) return std::nullopt;
    if (view.before_start) return button == 0 ? Press(StudyPress{Kind::go_on}) : std::nullopt;
    if (run.step() == StudyStep::question && run.block().form == TrialForm::rating) {
        if (button == 2) return rate(view);
        if (button > 2) return std::nullopt;
        return moved_mark(run.block().question, view, button == 0 ? -1.0 : 1.0);
    }
    if (run.step() == StudyStep::question) return answer_by_digit(run, button + 1);
    if (run.step() == StudyStep::adjust) {
        if (button == kLongPressButton && held) return StudyPress{Kind::go_on};
        if (button == kLongPressButton) return StudyPress{Kind::feel, 1 - run.interval()};
        if (button > kLongPressButton || run.interval() == 0) return std::nullopt;
        return StudyPress{Kind::turn, 0, button == 0 ? -0.02 : 0.02};
    }
    return button == 0 ? Press(StudyPress{Kind::go_on}) : std::nullopt;
}

std::optional<bool> LongPress::ended(Clock::time_point now, bool down) noexcept {
    constexpr std::chrono::seconds kLong{1};
    if (!since_) return std::nullopt;
    const bool held = now - *since_ >= kLong;
    if (down && !held) return std::nullopt;
    forget();
    return held;
}

}  // namespace dibhr
