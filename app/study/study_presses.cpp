// What keys and device buttons do at each step.
#include <cmath>
#include <cstdint>
#include <utility>

#include "app/study/study_pages.hpp"

namespace dibhr {

namespace {

using Press = std::optional<StudyPress>;
using Kind = StudyPress::Kind;

/// Keys that scroll a page's text. At a question Up and Down belong to the answers.
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

/// The value of a digit key.
std::optional<int> digit_of(std::string_view key) {
    if (key.size() != 1 || key[0] < '0' || key[0] > '9') return std::nullopt;
    return key[0] - '0';
}

Press answer_by_digit(const StudyRun& run, int digit) {
    const Block& block = run.block();
    if (block.form == TrialForm::rating) {
        if (has_wide_scale(block.question)) return std::nullopt;
        const StudyAnswer answer{.number = static_cast<double>(digit)};
        return run.would_accept(answer) ? Press(StudyPress{Kind::rate, 0, *answer.number})
                                        : std::nullopt;
    }
    const StudyAnswer answer{.choice = digit - 1};
    return digit >= 1 && run.would_accept(answer) ? Press(StudyPress{Kind::choose, digit - 1})
                                                  : std::nullopt;
}

/// The first press puts the mark into the middle, in either direction.
StudyPress moved_mark(const Question& question, const StudyShown& view, double by) {
    const double middle = std::round(0.5 * (question.lowest + question.highest));
    return {Kind::mark, 0, view.mark ? *view.mark + by : middle};
}

/// No answer without a mark.
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

Press adjustment_button(const StudyRun& run, const StudyButton& button) {
    if (button.number == kLongPressButton && button.held) return StudyPress{Kind::go_on};
    if (button.number == kLongPressButton) return StudyPress{Kind::feel, 1 - run.interval()};
    if (button.number > kLongPressButton || run.interval() == 0) return std::nullopt;
    return StudyPress{Kind::turn, 0, button.number == 0 ? -0.02 : 0.02};
}

Press question_button(const StudyRun& run, const StudyShown& view, int button) {
    if (run.block().form != TrialForm::rating) return answer_by_digit(run, button + 1);
    if (button == 2) return rate(view);
    if (button > 2) return std::nullopt;
    return moved_mark(run.block().question, view, button == 0 ? -1.0 : 1.0);
}

/// Part of a trial: none (a page), an interval before the question, or the question.
enum class Place : std::uint8_t { page, interval, question };

Place place_of(const StudyRun& run, const StudyShown& view) {
    if (view.before_start) return Place::page;
    if (run.step() == StudyStep::interval) return Place::interval;
    const bool answers = run.step() == StudyStep::question || run.step() == StudyStep::adjust;
    return answers ? Place::question : Place::page;
}

/// `goes_on`: the key continues outside a question; `answer`: its meaning at the question.
Press pressed(Place place, bool early, bool goes_on, const Press& answer) {
    if (place == Place::question && !early) return answer;
    if (place != Place::question && goes_on)
        return early ? std::nullopt : Press(StudyPress{Kind::go_on});
    return place != Place::page && answer ? Press(StudyPress{Kind::early}) : std::nullopt;
}

}  // namespace

std::optional<StudyPress> press_of_key(const StudyRun& run, const StudyShown& view,
                                       const StudyKey& key) {
    if (view.asks_to_leave) {
        if (key.early) return std::nullopt;
        if (key.name == "Esc" || key.name == "Enter") return StudyPress{Kind::stay};
        if (key.name == "l" || key.name == "L") return StudyPress{Kind::leave};
        return std::nullopt;
    }
    if (key.name == "Esc") return StudyPress{Kind::ask_to_leave};
    if (!view.consent_text.empty())
        return !key.early && (key.name == "a" || key.name == "A") ? Press(StudyPress{Kind::agree})
                                                                  : std::nullopt;
    const bool early = key.early || view.waits;  // waits for the surface or the next step
    const Place place = place_of(run, view);
    Press answer;
    if (place != Place::page)
        answer = run.trial().form == TrialForm::adjust
                     ? adjustment_key(run, key.name, key.shift)
                     : question_key(run, view, key.name, key.shift);
    const bool goes_on = key.name == "Enter" || key.name == " ";
    if (const Press press = pressed(place, early, goes_on, answer)) return press;
    const bool scrolls = !early && run.step() != StudyStep::adjust;
    return scrolls ? scroll_key(run, key.name) : std::nullopt;
}

std::optional<StudyPress> press_of_button(const StudyRun& run, const StudyShown& view,
                                          const StudyButton& button) {
    if (view.asks_to_leave || !view.consent_text.empty()) return std::nullopt;
    const Place place = place_of(run, view);
    Press answer;
    if (place != Place::page)
        answer = run.trial().form == TrialForm::adjust ? adjustment_button(run, button)
                                                       : question_button(run, view, button.number);
    return pressed(place, button.early || view.waits, button.number == 0, answer);
}

std::optional<EndedPress> LongPress::ended(Clock::time_point now, bool down) noexcept {
    constexpr std::chrono::seconds kLong{1};
    if (!since_) return std::nullopt;
    const bool held = now - *since_ >= kLong;
    if (down && !held) return std::nullopt;
    return EndedPress{
        held, *std::exchange(since_, std::nullopt) + (held ? kLong : std::chrono::seconds{0})};
}

}  // namespace dibhr
