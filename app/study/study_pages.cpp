// The pages, drawn with ImGui over the whole window.
#include "app/study/study_pages.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

using Press = std::optional<StudyPress>;
using Kind = StudyPress::Kind;

constexpr int kMostButtonsInARow = 9;
constexpr const char* kOrdinals[]{"The first", "The second", "The third"};

float em() {
    return ImGui::GetFontSize();
}

void gap(float ems) {
    ImGui::Dummy({0.0F, ems * em()});
}

/// Text in a column in the middle, as wide as can be read.
void column_text(const std::string& text, bool quiet = false) {
    const float width = ImGui::GetWindowWidth();
    const float most = std::min(0.8F * width, 36.0F * em());
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, most);
    ImGui::SetCursorPosX(0.5F * (width - size.x));
    const float left = ImGui::GetCursorPosX();
    ImGui::PushTextWrapPos(left + most + 1.0F);
    if (quiet)
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        ImGui::SetCursorPosX(left);
        ImGui::TextUnformatted(line.c_str());
        gap(0.15F);
    }
    if (quiet) ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
}

/// Side by side in the middle, one of them marked; which was clicked.
std::optional<int> buttons(const std::vector<std::string>& labels, float least_ems = 6.0F,
                           int marked = -1) {
    const float gap = 0.8F * em();
    std::vector<float> widths;
    float all = -gap;
    for (const std::string& label : labels) {
        const float width =
            std::max(least_ems * em(), ImGui::CalcTextSize(label.c_str()).x + 2.0F * em());
        widths.push_back(width);
        all += width + gap;
    }
    // One under the other where they do not fit.
    const bool row = all < 0.94F * ImGui::GetWindowWidth();
    std::optional<int> clicked;
    ImGui::SetCursorPosX(0.5F * (ImGui::GetWindowWidth() - all));
    for (std::size_t k = 0; k < labels.size(); ++k) {
        if (!row) ImGui::SetCursorPosX(0.5F * (ImGui::GetWindowWidth() - widths[k]));
        if (row && k > 0) ImGui::SameLine(0.0F, gap);
        ImGui::PushID(static_cast<int>(k));
        const bool lit = static_cast<int>(k) == marked;
        if (lit) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(ImGuiCol_SliderGrab));
        if (ImGui::Button(labels[k].c_str(), {widths[k], 2.4F * em()}))
            clicked = static_cast<int>(k);
        if (lit) ImGui::PopStyleColor();
        ImGui::PopID();
    }
    return clicked;
}

void down_to(float share) {
    ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), share * ImGui::GetWindowHeight()));
}

Press go_on_button(const char* label = "Go on  (Enter)") {
    return buttons({label}) ? Press(StudyPress{Kind::go_on}) : std::nullopt;
}

void draw_picture(const StudyShown& view) {
    if (view.picture == 0) return;
    const float high = 0.42F * ImGui::GetWindowHeight();
    const float wide = 0.8F * ImGui::GetWindowWidth();
    const float factor = std::min(wide / static_cast<float>(view.picture_columns),
                                  high / static_cast<float>(view.picture_rows));
    const ImVec2 size{factor * static_cast<float>(view.picture_columns),
                      factor * static_cast<float>(view.picture_rows)};
    ImGui::SetCursorPosX(0.5F * (ImGui::GetWindowWidth() - size.x));
    ImGui::Image(texture_id<ImTextureID>(view.picture), size);
    gap(0.8F);
}

Press draw_page(const StudyPage& page, const StudyShown& view, const char* button) {
    down_to(page.picture.empty() ? 0.26F : 0.08F);
    draw_picture(view);
    column_text(page.text);
    gap(1.6F);
    return go_on_button(button);
}

/// How far the study is, and what is left of a limit.
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

/// Over the relief: text on a ground of its own.
void label_at(const std::string& text, float centre_y, bool large = false) {
    ImGui::SetWindowFontScale(large ? 2.0F : 1.0F);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float x = 0.5F * (ImGui::GetWindowWidth() - size.x);
    const float pad = 0.5F * em();
    ImGui::GetWindowDrawList()->AddRectFilled(
        {x - 2.0F * pad, centre_y - 0.5F * size.y - pad},
        {x + size.x + 2.0F * pad, centre_y + 0.5F * size.y + pad},
        ImGui::GetColorU32(ImGuiCol_PopupBg), 0.4F * em());
    ImGui::SetCursorPos({x, centre_y - 0.5F * size.y});
    ImGui::TextUnformatted(text.c_str());
    ImGui::SetWindowFontScale(1.0F);
}

Press draw_interval(const StudyRun& run, const StudyShown& view) {
    const int count = run.block().intervals();
    const std::string number = std::to_string(run.interval() + 1);
    const float height = ImGui::GetWindowHeight();
    if (view.waits) {
        label_at(count > 1 ? number : "Ready", 0.45F * height, true);
        return std::nullopt;
    }
    if (count > 1) label_at(number + " of " + std::to_string(count), 2.0F * em());
    if (!view.device_words.empty()) label_at(view.device_words, 0.5F * height);
    ImGui::SetCursorPosY(height - 4.2F * em());
    return go_on_button(run.block().interval_s > 0.0 ? "Enough  (Enter)" : "Go on  (Enter)");
}

Press draw_scale(const Question& question, const StudyShown& view) {
    const float wide = std::min(0.7F * ImGui::GetWindowWidth(), 40.0F * em());
    const float left = 0.5F * (ImGui::GetWindowWidth() - wide);
    Press press;
    float value = static_cast<float>(view.mark);
    ImGui::SetCursorPosX(left);
    ImGui::SetNextItemWidth(wide);
    if (ImGui::SliderFloat("##scale", &value, static_cast<float>(question.lowest),
                           static_cast<float>(question.highest), "%.0f"))
        press = StudyPress{Kind::mark, 0, std::round(value)};
    ImGui::SetCursorPosX(left);
    ImGui::TextUnformatted(
        (std::to_string(question.lowest) + "  " + question.lowest_label).c_str());
    const std::string high = question.highest_label + "  " + std::to_string(question.highest);
    ImGui::SameLine(left + wide - ImGui::CalcTextSize(high.c_str()).x);
    ImGui::TextUnformatted(high.c_str());
    gap(1.6F);
    if (buttons({"Answer  (Enter)"})) press = StudyPress{Kind::rate, 0, view.mark};
    return press;
}

Press draw_ratings(const Question& question, const StudyShown& view) {
    std::vector<std::string> labels;
    for (int value = question.lowest; value <= question.highest; ++value)
        labels.push_back(std::to_string(value));
    Press press;
    const int marked = static_cast<int>(std::lround(view.mark)) - question.lowest;
    if (const auto clicked = buttons(labels, 3.0F, marked))
        press = StudyPress{Kind::rate, 0, static_cast<double>(question.lowest + *clicked)};
    if (!question.lowest_label.empty() || !question.highest_label.empty()) {
        gap(0.4F);
        column_text(std::to_string(question.lowest) + ": " + question.lowest_label + "        " +
                        std::to_string(question.highest) + ": " + question.highest_label,
                    true);
    }
    return press;
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

Press draw_question(const StudyRun& run, const StudyShown& view) {
    const Block& block = run.block();
    down_to(0.3F);
    ImGui::SetWindowFontScale(1.25F);
    column_text(block.question.text);
    ImGui::SetWindowFontScale(1.0F);
    gap(1.6F);
    Press press;
    if (block.form == TrialForm::rating) {
        press = has_wide_scale(block.question) ? draw_scale(block.question, view)
                                               : draw_ratings(block.question, view);
        if (!view.by_mouse) {
            gap(0.6F);
            column_text("On the grip: lower, higher, answer", true);
        }
    } else if (const auto clicked = buttons(choices_of(run))) {
        press = StudyPress{Kind::choose, *clicked};
    }
    if (!block.again) return press;
    gap(1.6F);
    std::vector<std::string> again;
    again.reserve(static_cast<std::size_t>(block.intervals()));
    for (int k = 0; k < block.intervals(); ++k)
        again.push_back(block.intervals() > 1 ? "Feel " + std::to_string(k + 1) + " again"
                                              : "Feel it again");
    ImGui::PushID("again");
    if (const auto clicked = buttons(again)) press = StudyPress{Kind::feel, *clicked};
    ImGui::PopID();
    return press;
}

Press draw_adjustment(const StudyRun& run, const StudyShown& view) {
    const float height = ImGui::GetWindowHeight();
    label_at(run.block().question.text, 2.0F * em());
    if (view.waits) {
        label_at(run.interval() == 0 ? "The one to match" : "Yours", 0.45F * height, true);
        return std::nullopt;
    }
    label_at(run.interval() == 0 ? "This one is to be matched" : "This one is yours: turn it",
             4.6F * em());
    if (!view.device_words.empty()) label_at(view.device_words, 0.5F * height);
    Press press;
    ImGui::SetCursorPosY(height - 7.4F * em());
    if (run.interval() == 1) {
        if (const auto clicked = buttons({"Less  (Down)", "More  (Up)"}))
            press = StudyPress{Kind::turn, 0, *clicked == 0 ? -0.02 : 0.02};
    }
    ImGui::SetCursorPosY(height - 4.2F * em());
    ImGui::PushID("equal");
    const std::vector<std::string> labels{
        run.interval() == 0 ? "Feel yours  (2)" : "Feel the other  (1)", "They are equal  (Enter)"};
    if (const auto clicked = buttons(labels)) {
        press =
            *clicked == 0 ? StudyPress{Kind::feel, 1 - run.interval()} : StudyPress{Kind::go_on};
    }
    ImGui::PopID();
    if (!view.by_mouse) {
        ImGui::SetCursorPosY(height - 1.6F * em());
        column_text("On the grip: less, more, the other; hold the third when they are equal", true);
    }
    return press;
}

Press draw_leaving() {
    down_to(0.3F);
    column_text("Leave the study?");
    gap(0.6F);
    column_text("All answers so far are kept. It goes on here the next time.", true);
    gap(1.6F);
    const auto clicked = buttons({"Stay  (Escape)", "Leave  (L)"});
    if (!clicked) return std::nullopt;
    return StudyPress{*clicked == 0 ? Kind::stay : Kind::leave};
}

Press draw_step(const StudyRun& run, const StudyShown& view) {
    switch (run.step()) {
        case StudyStep::instructions:
        case StudyStep::block_instructions: {
            const Press press = draw_page(run.page(), view, "Begin  (Enter)");
            if (!view.device_words.empty()) {
                gap(1.2F);
                column_text(view.device_words, true);
            }
            return press;
        }
        case StudyStep::interval:
            return draw_interval(run, view);
        case StudyStep::adjust:
            return draw_adjustment(run, view);
        case StudyStep::question:
            return draw_question(run, view);
        case StudyStep::feedback: {
            const bool right = run.last().right.value_or(false);
            down_to(0.36F);
            ImGui::SetWindowFontScale(1.6F);
            column_text(right ? "Right." : "Not this time.");
            ImGui::SetWindowFontScale(1.0F);
            gap(1.6F);
            return go_on_button();
        }
        case StudyStep::pause:
            return draw_page({.text = "Time for a break.\n\nGo on whenever you like."}, view,
                             "Go on  (Enter)");
        case StudyStep::thanks:
            return draw_page(
                run.page().empty() ? StudyPage{.text = "That was all. Thank you!"} : run.page(),
                view, "Close  (Enter)");
        case StudyStep::finished:
            break;
    }
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

Press question_key(const StudyRun& run, const StudyShown& view, std::string_view key, bool shift) {
    if (const auto digit = digit_of(key)) return answer_by_digit(run, *digit);
    const Block& block = run.block();
    if (block.form == TrialForm::rating) {
        const double step = shift ? 10.0 : 1.0;
        if (key == "Enter") return StudyPress{Kind::rate, 0, view.mark};
        if (key == "Left" || key == "Down") return StudyPress{Kind::mark, 0, view.mark - step};
        if (key == "Right" || key == "Up") return StudyPress{Kind::mark, 0, view.mark + step};
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

bool has_wide_scale(const Question& question) noexcept {
    return question.highest - question.lowest >= kMostButtonsInARow || question.lowest < 0 ||
           question.highest > 9;
}

std::optional<StudyPress> draw_study(const StudyRun& run, const StudyShown& view) {
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    const bool over_relief = !view.asks_to_leave &&
                             (run.step() == StudyStep::interval || run.step() == StudyStep::adjust);
    ImGui::Begin("study", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoBringToFrontOnFocus |
                     (over_relief ? ImGuiWindowFlags_NoBackground : ImGuiWindowFlags_None));
    const Press press = view.asks_to_leave ? draw_leaving() : draw_step(run, view);
    draw_bars(run, view);
    ImGui::End();
    return press;
}

bool mouse_is_over_button() {
    return ImGui::IsAnyItemHovered() || ImGui::IsAnyItemActive();
}

std::optional<StudyPress> press_of_key(const StudyRun& run, const StudyShown& view,
                                       std::string_view key, bool shift) {
    if (view.asks_to_leave) {
        if (key == "Esc" || key == "Enter") return StudyPress{Kind::stay};
        if (key == "l" || key == "L") return StudyPress{Kind::leave};
        return std::nullopt;
    }
    if (key == "Esc") return StudyPress{Kind::ask_to_leave};
    if (view.waits) return std::nullopt;  // for the surface, or the next step
    if (run.step() == StudyStep::question) return question_key(run, view, key, shift);
    if (run.step() == StudyStep::adjust) return adjustment_key(run, key, shift);
    if (key == "Enter" || key == " ") return StudyPress{Kind::go_on};
    return std::nullopt;
}

std::optional<StudyPress> press_of_button(const StudyRun& run, const StudyShown& view, int button,
                                          bool held) {
    if (view.waits || view.asks_to_leave) return std::nullopt;
    if (run.step() == StudyStep::question && run.block().form == TrialForm::rating) {
        if (button == 2) return StudyPress{Kind::rate, 0, view.mark};
        if (button > 2) return std::nullopt;
        return StudyPress{Kind::mark, 0, view.mark + (button == 0 ? -1.0 : 1.0)};
    }
    if (run.step() == StudyStep::question) return answer_by_digit(run, button + 1);
    if (run.step() == StudyStep::adjust) {
        if (button == kTwoFoldButton && held) return StudyPress{Kind::go_on};
        if (button == kTwoFoldButton) return StudyPress{Kind::feel, 1 - run.interval()};
        if (button > kTwoFoldButton || run.interval() == 0) return std::nullopt;
        return StudyPress{Kind::turn, 0, button == 0 ? -0.02 : 0.02};
    }
    return button == 0 ? Press(StudyPress{Kind::go_on}) : std::nullopt;
}

}  // namespace dibhr
