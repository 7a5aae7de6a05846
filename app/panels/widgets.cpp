// Rows and icons of the panels.
#include "app/panels/widgets.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>

#include "app/panels/panels.hpp"
#include "app/panels/typed_number.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/live/live_name.hpp"

namespace dibhr {

namespace {

constexpr float kLabelShare = 0.40F;  // of a row's width
constexpr const char* kSlideByMouse = "Drag, or Ctrl+click to type a number";
constexpr const char* kSlideKeys = "\nLeft and right change it, Enter types a number";

/// The colour of warnings, readable on the theme's background.
ImU32 warning_colour() {
    const bool on_dark = ImGui::GetStyleColorVec4(ImGuiCol_Text).x > 0.5F;
    return on_dark ? IM_COL32(242, 184, 97, 255) : IM_COL32(146, 84, 0, 255);
}

const char* open_word(bool open) {
    return open ? "open" : "closed";
}

/// Draws the label and moves the cursor to the begin of the row's value.
void row_label(const char* label, const char* help) {
    const float begin = ImGui::GetCursorPosX();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    add_tooltip(help);
    ImGui::SameLine(begin + width * kLabelShare);
}

/// The space for the arrow at the right end of each row; kept free while the arrow is hidden, so
/// that rows stay aligned.
float arrow_width() {
    return ImGui::GetFrameHeight();
}

/// The width of a row's value, without the arrow.
float value_width() {
    return ImGui::GetContentRegionAvail().x - arrow_width() - ImGui::GetStyle().ItemInnerSpacing.x;
}

/// The words of a row's number: "Stiffness, slider, 0.50 N/mm".
ItemWords number_words(const char* label, const char* format, double value) {
    std::array<char, 64> text{};
    ImGui::DataTypeFormatString(text.data(), static_cast<int>(text.size()), ImGuiDataType_Double,
                                &value, format);
    return {label, "slider", text.data()};
}

/// The value that many steps of the arrow keys away: a step is a hundredth of the slider.
double after_steps(const NumberRow& row, double value, int steps) {
    constexpr int kUsualDigits = 3;
    constexpr double kTimes = 1.05;
    const double digit = std::pow(10.0, -ImParseFormatPrecision(row.format, kUsualDigits));
    const double least = std::max(digit, 0.01 * (row.highest - row.lowest));
    double wanted = value + steps * least;
    if (row.logarithmic && value > 0.0) {
        wanted = value * std::pow(kTimes, steps);
        if (std::abs(wanted - value) < digit) wanted = value + steps * digit;
    }
    wanted = std::round(wanted / digit) * digit;
    return std::clamp(wanted, row.lowest, std::max(row.highest, value));
}

bool restore_arrow(bool changed) {
    ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
    if (!changed) {
        ImGui::Dummy({arrow_width(), arrow_width()});
        return false;
    }
    return icon_button("put back", Icon::restore, "Back to the default");
}

/// The name, shortened in its middle if it needs more than two lines of that width.
std::string on_two_lines(const std::string& name, float width) {
    const auto is_within = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    std::string text = name;
    for (std::size_t less = 4; less < name.size(); less += 4) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
        if (size.y < 2.5F * ImGui::GetTextLineHeight()) break;
        std::size_t begin = (name.size() - less) / 2;
        std::size_t end = begin + less;
        while (begin > 0 && is_within(name[begin])) --begin;  // letters stay whole
        while (end < name.size() && is_within(name[end])) ++end;
        text = name.substr(0, begin) + "..." + name.substr(end);
    }
    return text;
}

/// The slider covers the useful range; a typed number may go up to the option's limit.
double slider_end(const TouchNumber& option, double standard) {
    return std::min(option.highest, standard > 0.0 ? 4.0 * standard : option.highest / 4.0);
}

std::string format_of(const TouchNumber& option, double end) {
    const char* digits = end >= 200.0  ? "%.0f"
                         : end >= 10.0 ? "%.1f"
                         : end >= 1.0  ? "%.2f"
                                       : "%.3f";
    return option.unit.empty() ? digits : std::string(digits) + " " + std::string(option.unit);
}

/// "Size of a pixel under the hand (--pixel-pitch)"
template <typename Entry>
std::string help_of(const Entry& entry) {
    return std::string(entry.help) + " (--" + std::string(entry.name) + ")";
}

void draw_entry(const TouchChoice& choice, TouchParameters& parameters, TouchParameters& usual) {
    std::visit(
        [&](auto* chosen) {
            choice_row(std::string(choice.label).c_str(), name_table(*chosen), *chosen,
                       help_of(choice).c_str(), *std::get<decltype(chosen)>(choice.in(usual)));
        },
        choice.in(parameters));
}

void draw_entry(const TouchSwitch& entry, TouchParameters& parameters, TouchParameters& usual) {
    flag_row(std::string(entry.label).c_str(), entry.in(parameters), entry.in(usual),
             help_of(entry).c_str());
}

void draw_entry(const TouchNumber& option, TouchParameters& parameters, TouchParameters& usual) {
    const double end = slider_end(option, option.standard());
    const std::string label(option.label);
    const std::string format = format_of(option, end);
    const std::string help = help_of(option);
    if (number_row({.label = label.c_str(),
                    .format = format.c_str(),
                    .lowest = option.lowest,
                    .highest = end,
                    .standard = option.in(usual),
                    .help = help.c_str(),
                    .zero = option.zero},
                   option.in(parameters))) {
        keep_in_range(parameters);
    }
}

}  // namespace

void begin_card(const ViewerState& state, const char* title, float widest_em) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float room = display.x - panel_column_width(state);
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({0.5F * room, panes_height(state) + 0.08F * display.y},
                            ImGuiCond_Always, {0.5F, 0.0F});
    ImGui::SetNextWindowSize({std::max(std::min(widest_em * em, room - em), 8.0F * em), 0.0F});
    ImGui::Begin(title, nullptr, kTitledWindow | ImGuiWindowFlags_NoFocusOnAppearing);
}

bool section(const ViewerState& state, const char* title, bool& open, bool* wanted) {
    const bool asked = wanted != nullptr && std::exchange(*wanted, false);
    open = open || asked;
    ImGui::Spacing();
    ImGui::SetNextItemOpen(open, ImGuiCond_Always);
    ImGui::PushFont(state.ui.fonts.heading);
    open = ImGui::CollapsingHeader(title);
    item::reach(ItemKeys::press, [&] { return ItemWords{title, "section", open_word(open)}; });
    ImGui::PopFont();
    if (asked) ImGui::SetScrollHereY(0.0F);
    return open;
}

namespace {

/// Where a slider stands, along the last item's lower edge: the number above it stays readable.
void draw_slider_mark(const NumberRow& row, double value) {
    const double share = row.logarithmic
                             ? std::log(value / row.lowest) / std::log(row.highest / row.lowest)
                             : (value - row.lowest) / (row.highest - row.lowest);
    if (!std::isfinite(share)) return;
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    const bool lively = ImGui::IsItemHovered() || ImGui::IsItemActive();
    const ImU32 colour = ImGui::GetColorU32(ImGuiCol_SliderGrabActive);
    const float line = 0.11F * (high.y - low.y);
    const float knob = 0.5F * ImGui::GetStyle().GrabMinSize;
    const float x =
        low.x + knob +
        static_cast<float>(std::clamp(share, 0.0, 1.0)) * (high.x - low.x - 2.0F * knob);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({low.x, high.y - line}, {x, high.y}, ImGui::GetColorU32(ImGuiCol_SliderGrab),
                       line, ImDrawFlags_RoundCornersBottomLeft);
    list.AddRectFilled({x - knob, high.y - (lively ? 2.4F : 1.9F) * line}, {x + knob, high.y},
                       colour, line);
}

}  // namespace

bool number_row(const NumberRow& row, double& value) {
    const double before = value;
    const bool named = row.zero != nullptr && !(std::abs(value) > 0.0);
    ImGui::PushID(row.label);
    row_label(row.label, row.help);
    ImGui::SetNextItemWidth(value_width() - row.beside);
    const char* const format = named ? row.zero : row.format;
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, 0);  // ImGui's lies under the number
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, 0);
    number_item("##value", row.format, value, [&] {
        ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &row.lowest, &row.highest,
                            format, row.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    });
    ImGui::PopStyleColor(2);
    draw_slider_mark(row, value);
    // ImGui rounds a dragged value to the shown digits, but a text instead of 0 has none.
    if (named && ImGui::IsMouseDown(ImGuiMouseButton_Left)) value = std::round(value);
    const bool by_keys =
        item::reach(ItemKeys::slide, [&] { return number_words(row.label, format, value); });
    if (by_keys) value = after_steps(row, value, item::steps().across);
    add_tooltip(by_keys ? (row.help + std::string(kSlideKeys)).c_str() : kSlideByMouse);
    if (restore_arrow(std::abs(value - row.standard) > 1e-9)) value = row.standard;
    ImGui::PopID();
    return std::abs(value - before) > 0.0;
}

Dragged dragged_row(const DraggedRow& row, std::span<double> values) {
    ImGui::PushID(row.label);
    row_label(row.label, row.help);
    bool stepped = false;
    ImGui::BeginGroup();
    ImGui::PushMultiItemsWidths(static_cast<int>(values.size()), value_width());
    for (std::size_t k = 0; k < values.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        if (k > 0) ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
        double& value = values[k];
        const bool typed = number_item("##value", row.format, value, [&] {
            ImGui::DragScalar("##value", ImGuiDataType_Double, &value, row.speed, &row.lowest,
                              &row.highest, row.format, ImGuiSliderFlags_AlwaysClamp);
        });
        if (typed) value = std::clamp(value, row.lowest, row.highest);
        if (item::reach(ItemKeys::slide,
                        [&] { return number_words(row.label, row.format, value); })) {
            const int steps = item::steps().across;
            value =
                std::clamp(value + steps * static_cast<double>(row.speed), row.lowest, row.highest);
            stepped = stepped || steps != 0;
        }
        ImGui::PopItemWidth();
        ImGui::PopID();
    }
    ImGui::EndGroup();
    const bool done = ImGui::IsItemDeactivatedAfterEdit() || stepped;
    add_tooltip(kSlideByMouse);
    const bool restore = restore_arrow(row.changed);
    ImGui::PopID();
    return restore ? Dragged::restore : done ? Dragged::done : Dragged::nothing;
}

bool flag_row(const char* label, bool& value, bool standard, const char* help) {
    const bool before = value;
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    ImGui::PushID(label);
    item::checkbox(label, &value);
    add_tooltip(help);
    if (value != standard) {
        ImGui::SameLine(right - arrow_width());
        if (icon_button("put back", Icon::restore, "Back to the default")) value = standard;
    }
    ImGui::PopID();
    return value != before;
}

void text_beside_flag(const std::string& text) {
    ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x * kLabelShare);
    draw_dimmed(text);
}

void desktop_dialog_box(OpenWith& with) {
    bool asks = with != OpenWith::window;
    if (item::checkbox("Use the desktop's dialog next time", &asks))
        with = asks ? OpenWith::automatic : OpenWith::window;
    add_tooltip("Files are chosen in the desktop's own dialog, where there is one (--open-dialog)");
}

bool index_row(const char* label, std::span<const char* const> names, int& chosen, const char* help,
               int standard) {
    const int before = chosen;
    ImGui::PushID(label);
    row_label(label, help);
    ImGui::SetNextItemWidth(value_width());
    item::list_box("##choice", label, names, chosen);
    add_tooltip(help);
    if (restore_arrow(chosen != standard)) chosen = standard;
    ImGui::PopID();
    return chosen != before;
}

bool text_field(const char* id, const char* hint, std::span<char> text, const char* help,
                bool enter, float width) {
    ImGui::SetNextItemWidth(width);
    const bool done = ImGui::InputTextWithHint(id, hint, text.data(), text.size(),
                                               enter ? ImGuiInputTextFlags_EnterReturnsTrue : 0);
    item::reach(ItemKeys::type, [&] { return ItemWords{hint, "text", text.data()}; });
    add_tooltip(help);
    return done;
}

bool text_row(const char* label, const std::string& hint, std::span<char> text, const char* help) {
    ImGui::PushID(label);
    row_label(label, help);
    bool done = text_field("##text", hint.c_str(), text, help, true, value_width());
    if (restore_arrow(text.front() != '\0')) {
        text.front() = '\0';
        done = true;
    }
    ImGui::PopID();
    return done;
}

float button_width(const char* label) {
    return ImGui::CalcTextSize(label).x + 2.0F * ImGui::GetStyle().FramePadding.x;
}

float half_width() {
    return 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
}

void report_button(ViewerState& state, const std::filesystem::path& session) {
    const ReportShown& report = state.ui.report;
    const bool makes = report.being_made;
    ImGui::BeginDisabled(makes);
    if (item::button(makes ? "Making it###report" : "Report###report", {-1.0F, 0.0F}))
        state.commands.push(MakeReport{session});
    ImGui::EndDisabled();
    const std::string made = report.session == session && !report.page.empty()
                                 ? "\nMade: " + report.page.string()
                                 : std::string();
    add_tooltip(
        ("One page: where, how long and how hard it was touched (dibhr report)" + made).c_str());
}

bool button_or_drop(const char* label, bool enabled, const char* dropped, float beside) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = item::button(label);
    ImGui::EndDisabled();
    const std::string text = formatted("or drop %s on the window", dropped);
    const float needed = ImGui::GetItemRectSize().x + ImGui::CalcTextSize(text.c_str()).x + beside +
                         2.0F * ImGui::GetStyle().ItemSpacing.x;
    if (needed > ImGui::GetContentRegionAvail().x) return pressed;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", text.c_str());
    return pressed;
}

void fact_row(const char* label, const std::string& value, const char* help) {
    const float begin = ImGui::GetCursorPosX();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::TextDisabled("%s", label);
    add_tooltip(help);
    const float label_end = ImGui::CalcTextSize(label).x + ImGui::GetStyle().ItemSpacing.x;
    const float fits_from = width - ImGui::CalcTextSize(value.c_str()).x;
    const float usual = std::max(width * kLabelShare, label_end);
    // Beside its label, a value that fits is on one line.
    ImGui::SameLine(begin + (fits_from < label_end ? usual : std::min(usual, fits_from)));
    ImGui::PushTextWrapPos(begin + width);
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopTextWrapPos();
    add_tooltip(help);
}

void file_row(const char* label, const std::filesystem::path& file) {
    const std::string whole = shown_source(file);
    const std::string name = is_live(file) ? whole : file.filename().string();
    const float width = ImGui::GetContentRegionAvail().x * (1.0F - kLabelShare);
    fact_row(label, on_two_lines(name, width), whole.c_str());
}

bool name_button(const std::string& name) {
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    const ImVec2 text = ImGui::CalcTextSize(name.c_str());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::Button("##button", {text.x + 2.0F * pad.x, text.y + 2.0F * pad.y});
    item::reach(ItemKeys::press, [&] { return ItemWords{name, "button", {}}; });
    ImGui::GetWindowDrawList()->AddText({at.x + pad.x, at.y + pad.y},
                                        ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
    return pressed;
}

bool name_selectable(const std::string& name, bool chosen, ImGuiSelectableFlags flags,
                     bool reached) {
    const bool pressed = ImGui::Selectable("##row", chosen, flags);
    if (reached) {
        item::reach(ItemKeys::press, [&] {
            return ItemWords{name, "entry", chosen ? "chosen" : ""};
        });
    }
    ImGui::SameLine(0.0F, 0.0F);
    ImGui::TextUnformatted(name.c_str());
    return pressed;
}

void draw_dimmed(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

void draw_warning(const std::string& text) {
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImU32 colour = warning_colour();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddTriangle({low.x + line * 0.5F, low.y + line * 0.1F},
                     {low.x + line * 0.02F, low.y + line * 0.92F},
                     {low.x + line * 0.98F, low.y + line * 0.92F}, colour, line * 0.09F);
    list.AddLine({low.x + line * 0.5F, low.y + line * 0.38F},
                 {low.x + line * 0.5F, low.y + line * 0.65F}, colour, line * 0.11F);
    list.AddCircleFilled({low.x + line * 0.5F, low.y + line * 0.78F}, line * 0.065F, colour);
    ImGui::Dummy({line, line});
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

bool subsection(const char* title) {
    ImGui::Spacing();
    const bool open = ImGui::TreeNodeEx(
        title, ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_NoTreePushOnOpen);
    item::reach(ItemKeys::press, [&] { return ItemWords{title, "section", open_word(open)}; });
    return open;
}

bool icon_button(const char* id, Icon icon, const char* help, bool lit, float times) {
    const float side = std::round(times * ImGui::GetFrameHeight());
    ImGui::PushID(id);
    const ImVec4 clear{0.0F, 0.0F, 0.0F, 0.0F};
    ImGui::PushStyleColor(ImGuiCol_Button, lit ? ImGui::GetStyleColorVec4(ImGuiCol_Button) : clear);
    const bool pressed = ImGui::Button("##icon", {side, side});
    item::reach(ItemKeys::press, [&] { return ItemWords{help, "button", lit ? "on" : ""}; });
    ImGui::PopStyleColor();
    ImGui::PopID();
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    draw_icon(*ImGui::GetWindowDrawList(), icon, {(low.x + high.x) * 0.5F, (low.y + high.y) * 0.5F},
              side * 0.25F, ImGui::GetColorU32(ImGuiCol_Text));
    add_tooltip(help);
    return pressed;
}

void play_button(bool playing, Transport& transport, const KeyTable& keys) {
    const std::string help = (playing ? "Pause" : "Play") + keys.in_brackets(Action::play_or_pause);
    if (icon_button("play", playing ? Icon::pause : Icon::play, help.c_str()))
        playing ? transport.pause() : transport.play();
}

void play_and_step_buttons(bool playing, Transport& transport, const KeyTable& keys,
                           const std::string& step, float gap) {
    const std::string back = "One " + step + " back" + keys.in_brackets(Action::step_back);
    const std::string forward = "One " + step + " forward" + keys.in_brackets(Action::step_forward);
    if (icon_button("back", Icon::step_back, back.c_str())) transport.step(-1);
    ImGui::SameLine(0.0F, gap);
    play_button(playing, transport, keys);
    ImGui::SameLine(0.0F, gap);
    if (icon_button("forward", Icon::step_forward, forward.c_str())) transport.step(1);
    ImGui::SameLine(0.0F, gap);
}

void speed_row(double speed, Transport& transport) {
    if (number_row({"Speed", "x %.2f", kSlowestSpeed, kFastestSpeed, 1.0, "[ slower, ] faster"},
                   speed))
        transport.set_speed(speed);
}

void draw_parameters(TouchTopic topic, TouchParameters& parameters, TouchParameters usual) {
    visit_touch_entries([&](const auto& entry) {
        if (entry.topic == topic) draw_entry(entry, parameters, usual);
    });
}

}  // namespace dibhr
