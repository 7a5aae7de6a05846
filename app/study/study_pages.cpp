// The pages, drawn with ImGui over the whole window.
#include "app/study/study_pages.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "app/study/page_layout.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

using Press = std::optional<StudyPress>;
using Kind = StudyPress::Kind;

constexpr int kMostButtonsInARow = 9;
constexpr const char* kOrdinals[]{"The first", "The second", "The third"};

FootPart go_on_part(const char* label = "Go on  (Enter)") {
    return button_part({.labels = {label}}, [](int) { return StudyPress{Kind::go_on}; });
}

PageBody body_of(const StudyShown& view, std::vector<PageText> texts, float top) {
    return {.texts = std::move(texts),
            .top = top,
            .first_picture = view.first_picture,
            .scroll = view.scroll};
}

/// `align`: a short text is centred over its button, instructions are flush left.
Press draw_text_page(const StudyPage& page, const StudyShown& view, const char* button,
                     LineAlign align = LineAlign::left) {
    PageBody body =
        body_of(view, {{.text = page.text, .align = align}}, page.picture.empty() ? 0.26F : 0.08F);
    if (!page.picture.empty()) {
        body.picture = view.picture;
        body.picture_columns = view.picture_columns;
        body.picture_rows = view.picture_rows;
    }
    std::vector<FootPart> foot{go_on_part(button)};
    if (!view.device_words.empty()) foot.push_back(note_part(view.device_words));
    return draw_page(body, foot);
}

/// Progress of the study, and the rest of a time limit.
void draw_bars(const StudyRun& run, const StudyShown& view) {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float width = ImGui::GetWindowWidth();
    const float high = 0.28F * em();
    const auto bar = [&](float top, double share, ImGuiCol colour) {
        list.AddRectFilled({0.0F, top}, {width, top + high}, ImGui::GetColorU32(ImGuiCol_FrameBg));
        list.AddRectFilled({0.0F, top}, {static_cast<float>(share) * width, top + high},
                           ImGui::GetColorU32(colour));
    };
    bar(0.0F, run.share_done(), ImGuiCol_SliderGrab);
    if (view.has_limit)
        bar(ImGui::GetWindowHeight() - high, view.left_share, ImGuiCol_SliderGrabActive);
}

/// Labels over the relief, from the upper edge down.
void draw_labels(const std::vector<std::string>& texts) {
    float top = 1.0F * em();
    for (const std::string& text : texts)
        if (!text.empty()) top = draw_label(text, top) + 0.4F * em();
}

/// A label in the middle; `times` larger for announcements.
void draw_in_the_middle(const std::string& text, float times = 1.0F) {
    if (!text.empty()) draw_label(text, 0.42F * ImGui::GetWindowHeight(), times);
}

Press draw_interval(const StudyRun& run, const StudyShown& view) {
    constexpr float kAnnounced = 2.0F;
    const int count = run.block().intervals();
    const std::string number = std::to_string(run.interval() + 1);
    if (view.waits) {
        draw_in_the_middle(count > 1 ? number : "Ready", kAnnounced);
        return std::nullopt;
    }
    if (count > 1) draw_labels({number + " of " + std::to_string(count)});
    draw_in_the_middle(view.device_words);
    return draw_at_bottom(std::array{
        go_on_part(run.block().interval_s > 0.0 ? "Enough  (Enter)" : "Go on  (Enter)")});
}

/// The labels of a scale's two ends, each under its end. `left`, `wide`: of the scale [px].
FootPart ends_part(const std::string& lowest, const std::string& highest, float left, float wide) {
    const TextBlock low = text_block(lowest, 0.46F * wide);
    const TextBlock high = text_block(highest, 0.46F * wide);
    return {std::max(low.size.y, high.size.y), [=]() -> Press {
                const ImVec2 at = ImGui::GetCursorScreenPos();
                draw_text(low, {at.x + left, at.y}, LineAlign::left);
                draw_text(high, {at.x + left + wide - high.size.x, at.y}, LineAlign::right);
                return std::nullopt;
            }};
}

/// A scale as a line from `at` on, with the value over the mark; no mark: not set yet.
Press draw_line(const Question& question, const StudyShown& view, ImVec2 at, float wide) {
    const float knob = 0.5F * em();
    const float middle = at.y + 2.0F * em();
    const double lowest = question.lowest;
    const double range = question.highest - lowest;
    ImGui::SetCursorScreenPos({at.x - knob, middle - 1.4F * knob});
    ImGui::InvisibleButton("line", {wide + 2.0F * knob, 2.8F * knob});
    Press press;
    if (ImGui::IsItemActive()) {
        const auto share = static_cast<double>((ImGui::GetMousePos().x - at.x) / wide);
        press = StudyPress{Kind::mark, 0, std::round(lowest + std::clamp(share, 0.0, 1.0) * range)};
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool lit = ImGui::IsItemHovered() && view.pointer_moved;
    const ImU32 ink = ImGui::GetColorU32(lit ? ImGuiCol_ButtonActive : ImGuiCol_ButtonHovered);
    const auto bar = [&](float x, float width, float high) {
        list.AddRectFilled({x, middle - high}, {x + width, middle + high}, ink);
    };
    const float thin = 0.12F * em();
    bar(at.x, wide, thin);
    bar(at.x - thin, 2.0F * thin, knob);
    bar(at.x + wide - thin, 2.0F * thin, knob);
    if (!view.mark) return press;
    const float x = at.x + static_cast<float>((*view.mark - lowest) / range) * wide;
    list.AddCircleFilled({x, middle}, knob, ImGui::GetColorU32(ImGuiCol_SliderGrabActive));
    const TextBlock number = text_block(short_text(*view.mark), wide);
    draw_text(number, {x - 0.5F * number.size.x, at.y}, LineAlign::middle);
    return press;
}

void add_line(const Question& question, const StudyShown& view, std::vector<FootPart>& foot) {
    const float wide = std::min(0.7F * ImGui::GetWindowWidth(), 40.0F * em());
    const float left = 0.5F * (ImGui::GetWindowWidth() - wide);
    foot.push_back({2.5F * em(), [&question, &view, left, wide] {
                        const ImVec2 at = ImGui::GetCursorScreenPos();
                        return draw_line(question, view, {at.x + left, at.y}, wide);
                    }});
    foot.push_back(ends_part(std::to_string(question.lowest) + "\n" + question.lowest_label,
                             std::to_string(question.highest) + "\n" + question.highest_label, left,
                             wide));
    const double value = view.mark.value_or(0.0);
    foot.push_back(button_part({.labels = {"Answer  (Enter)"}, .enabled = view.mark.has_value()},
                               [value](int) {
                                   return StudyPress{Kind::rate, 0, value};
                               }));
}

/// A button for each number, all in one row.
void add_numbers(const Question& question, const StudyShown& view, std::vector<FootPart>& foot) {
    constexpr float kSpace = 0.8F;  // between two buttons [em]
    const int count = question.highest - question.lowest + 1;
    const float room =
        0.93F * ImGui::GetWindowWidth() / em() - kSpace * static_cast<float>(count - 1);
    ButtonGroup group{.least_width = std::min(3.0F, room / static_cast<float>(count)),
                      .space = 0.5F};
    for (int value = question.lowest; value <= question.highest; ++value)
        group.labels.push_back(std::to_string(value));
    if (view.mark) group.marked = static_cast<int>(std::lround(*view.mark)) - question.lowest;
    foot.push_back(button_part(group, [lowest = question.lowest](int which) {
        return StudyPress{Kind::rate, 0, static_cast<double>(lowest + which)};
    }));
    const float wide = em() * (static_cast<float>(count) * (group.least_width + kSpace) - kSpace);
    foot.push_back(ends_part(question.lowest_label, question.highest_label,
                             0.5F * (ImGui::GetWindowWidth() - wide), wide));
}

std::vector<std::string> choices_of(const StudyRun& run) {
    const Block& block = run.block();
    std::vector<std::string> labels;
    if (block.form == TrialForm::explore) {
        for (std::size_t k = 0; k < block.question.answers.size(); ++k)
            labels.push_back(block.question.answers[k] + "  (" + std::to_string(k + 1) + ")");
    } else {
        for (int k = 0; k < block.intervals(); ++k)
            labels.push_back(std::string(kOrdinals[k]) + "  (" + std::to_string(k + 1) + ")");
    }
    return labels;
}

FootPart again_part(const Block& block) {
    ButtonGroup group;
    for (int k = 0; k < block.intervals(); ++k)
        group.labels.push_back(block.intervals() > 1 ? "Feel " + std::to_string(k + 1) + " again"
                                                     : "Feel it again");
    return button_part(group, [](int which) { return StudyPress{Kind::feel, which}; });
}

Press draw_question(const StudyRun& run, const StudyShown& view) {
    const Block& block = run.block();
    std::vector<FootPart> foot;
    if (block.form == TrialForm::rating) {
        if (has_wide_scale(block.question))
            add_line(block.question, view, foot);
        else
            add_numbers(block.question, view, foot);
        foot.push_back(note_part(
            view.by_mouse ? "Left and Right choose, Enter answers"
                          : "Left and Right choose, Enter answers. Buttons of the grip: 1 lower, 2 "
                            "higher, 3 answer"));
    } else {
        foot.push_back(button_part({.labels = choices_of(run)}, [](int which) {
            return StudyPress{Kind::choose, which};
        }));
    }
    if (block.again) foot.push_back(again_part(block));
    // A resting pointer must not light an answer as if it were chosen.
    const bool lights = view.pointer_moved || has_wide_scale(block.question);
    const ImGuiCol lit = lights ? ImGuiCol_ButtonHovered : ImGuiCol_Button;
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(lit));
    const Press press = draw_page(body_of(view, {{block.question.text, 1.25F}}, 0.3F), foot);
    ImGui::PopStyleColor();
    return press;
}

/// Of an adjustment's two intervals the first is the one to match; it is felt first, once.
Press draw_adjustment(const StudyRun& run, const StudyShown& view) {
    const bool own = run.interval() == 1;
    const bool begun = run.step() == StudyStep::adjust;
    if (view.waits) {
        draw_labels({run.block().question.text});
        draw_in_the_middle(own ? "Yours" : "The one to match", 2.0F);
        return std::nullopt;
    }
    draw_labels({run.block().question.text,
                 own ? "This one is yours: turn it" : "This one is to be matched"});
    draw_in_the_middle(view.device_words);
    if (!begun) return draw_at_bottom(std::array{go_on_part("Feel yours  (Enter)")});
    std::vector<FootPart> foot;
    if (own)
        foot.push_back(button_part({.labels = {"Less  (Down)", "More  (Up)"}}, [](int which) {
            return StudyPress{Kind::turn, 0, which == 0 ? -0.02 : 0.02};
        }));
    foot.push_back(button_part(
        {.labels = {own ? "Feel the other  (1)" : "Feel yours  (2)", "They are equal  (Enter)"}},
        [other = 1 - run.interval()](int which) {
            return which == 0 ? StudyPress{Kind::feel, other} : StudyPress{Kind::go_on};
        }));
    if (!view.by_mouse)
        foot.push_back(note_part(
            "Buttons of the grip: 1 less, 2 more, 3 feel the other; hold 3 when they are equal"));
    return draw_at_bottom(foot);
}

Press draw_leaving(const StudyShown& view) {
    const PageBody body = body_of(
        view,
        {{"Leave the study?"},
         {.text = "All answers so far are kept. It goes on here the next time.", .dimmed = true}},
        0.3F);
    return draw_page(
        body, std::array{button_part({.labels = {"Stay  (Escape)", "Leave  (L)"}}, [](int which) {
            return StudyPress{which == 0 ? Kind::stay : Kind::leave};
        })});
}

Press draw_feedback(const StudyRun& run, const StudyShown& view) {
    const AnsweredTrial& last = run.last();
    const bool answered = last.answer.choice >= 0 || last.answer.number;
    const char* const words = !answered                    ? "The time was over."
                              : last.right.value_or(false) ? "Right."
                                                           : "Not this time.";
    return draw_page(body_of(view, {{words, 1.6F}}, 0.36F), std::array{go_on_part()});
}

/// Asks the experimenter for consent, before all else.
Press draw_consent(const StudyShown& view) {
    const PageBody body =
        body_of(view,
                {{"This study protects the hand less than usual:\n\n" + view.consent_text +
                  "\nWhoever leads the study agrees to that here, once."}},
                0.2F);
    return draw_page(
        body, std::array{button_part({.labels = {"Agree  (A)", "Leave  (Escape)"}}, [](int which) {
            return StudyPress{which == 0 ? Kind::agree : Kind::ask_to_leave};
        })});
}

/// Before the first trial after the program's start.
Press draw_start(const StudyRun& run, const StudyShown& view) {
    const std::string text = run.answered().empty()
                                 ? "Begin whenever you like."
                                 : "It goes on where it stopped.\n\nBegin whenever you like.";
    return draw_text_page({.text = text}, view, "Begin  (Enter)", LineAlign::middle);
}

bool is_felt(StudyStep step) {
    return step == StudyStep::interval || step == StudyStep::adjust;
}

Press draw_step(const StudyRun& run, const StudyShown& view) {
    switch (run.step()) {
        case StudyStep::instructions:
        case StudyStep::block_instructions:
            return draw_text_page(run.page(), view, "Begin  (Enter)");
        case StudyStep::interval:
        case StudyStep::adjust:
            return run.trial().form == TrialForm::adjust ? draw_adjustment(run, view)
                                                         : draw_interval(run, view);
        case StudyStep::question:
            return draw_question(run, view);
        case StudyStep::feedback:
            return draw_feedback(run, view);
        case StudyStep::pause:
            return draw_text_page({.text = "Time for a break.\n\nGo on whenever you like."}, view,
                                  "Go on  (Enter)", LineAlign::middle);
        case StudyStep::thanks:
            return draw_text_page(
                run.page().empty() ? StudyPage{.text = "That was all. Thank you!"} : run.page(),
                view, "Close  (Enter)");
        case StudyStep::finished:
            break;
    }
    return std::nullopt;
}

}  // namespace

bool has_wide_scale(const Question& question) noexcept {
    return question.highest - question.lowest >= kMostButtonsInARow || question.lowest < 0 ||
           question.highest > 9;
}

std::optional<StudyPress> draw_study(const StudyRun& run, const StudyShown& view) {
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    const bool over_relief = !view.asks_to_leave && !view.before_start && is_felt(run.step());
    ImGui::Begin("study", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
                     (over_relief ? ImGuiWindowFlags_NoBackground : ImGuiWindowFlags_None));
    const Press press = view.asks_to_leave           ? draw_leaving(view)
                        : !view.consent_text.empty() ? draw_consent(view)
                        : view.before_start          ? draw_start(run, view)
                                                     : draw_step(run, view);
    draw_bars(run, view);
    ImGui::End();
    return press;
}

bool mouse_is_over_button() {
    return ImGui::IsAnyItemHovered() || ImGui::IsAnyItemActive();
}

}  // namespace dibhr
