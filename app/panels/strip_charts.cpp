// Strip charts of the last seconds of touch, one below the other with one time axis. They can be
// paused, and show the values under the pointer.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

constexpr double kTicksPerSecond = 1000.0;
constexpr float kHeight_lines = 5.0F;

struct StripKind {
    Strip strip;
    const char* name;
    const char* unit;
    float least;  ///< smallest full scale of the chart
    const char* help;
    bool ChartsShown::*shown;
};

constexpr std::array<StripKind, kStrips> kKinds{
    {{Strip::force, "Force", "N", 0.5F, "Length of the force sent", &ChartsShown::force},
     {Strip::penetration, "Penetration", "mm", 1.0F,
      "Distance from the goal to the proxy, in contact", &ChartsShown::penetration},
     {Strip::speed, "Speed", "mm/s", 20.0F, "Speed of the goal, in millimetres of the hand",
      &ChartsShown::speed},
     {Strip::energy, "Energy", "mJ", 1.0F,
      "Energy that the force has given to the hand, summed up; falling: the hand gives energy",
      &ChartsShown::energy},
     {Strip::lateness, "Lateness", "us", 100.0F, "How long after its deadline each tick began",
      &ChartsShown::lateness}}};

/// A chart's range of values, from bottom to top.
struct Range {
    float low{0.0F}, high{1.0F};
};

/// 1, 2 or 5 times a power of ten, not below `value`.
float round_above(float value) {
    const float power = std::pow(10.0F, std::floor(std::log10(value)));
    for (const float times : {1.0F, 2.0F, 5.0F}) {
        if (value <= times * power * 1.0001F) return times * power;
    }
    return 10.0F * power;
}

/// A range of round numbers around all values; it includes 0, but not for the energy, a sum.
Range range_of(const StripHistory& strips, const StripKind& kind) {
    const auto& values = strips.values[static_cast<std::size_t>(kind.strip)];
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    if (kind.strip != Strip::energy) return {0.0F, round_above(std::max(*highest, kind.least))};
    const float step = 0.5F * round_above(std::max(*highest - *lowest, kind.least));
    const float low = step * std::floor(*lowest / step);
    return {low, std::max(low + 2.0F * step, step * std::ceil(*highest / step))};
}

/// A chart's rectangle in the window.
struct ChartFrame {
    ImVec2 low{}, high{};  // upper left, lower right
    Range range{};

    [[nodiscard]] float width() const { return std::max(1.0F, high.x - low.x); }
    [[nodiscard]] float y_of(float value) const {
        const float part = (value - range.low) / (range.high - range.low);
        return high.y - std::clamp(part, 0.0F, 1.0F) * (high.y - low.y);
    }
    [[nodiscard]] float x_of(double age_ticks) const {
        return high.x - static_cast<float>(age_ticks / StripHistory::kTicks) * width();
    }
    [[nodiscard]] std::size_t age_at(float x) const {
        const float part = std::clamp((high.x - x) / width(), 0.0F, 1.0F);
        return std::min(static_cast<std::size_t>(part * StripHistory::kTicks),
                        StripHistory::kTicks - 1);
    }
};

/// A vertical line in each pixel column, from its lowest to its highest value: no peak is lost.
void draw_values(ImDrawList& list, const StripHistory& strips, Strip strip,
                 const ChartFrame& frame) {
    const auto columns = static_cast<std::size_t>(frame.width());
    const ImU32 colour = ImGui::GetColorU32(ImGuiCol_CheckMark);
    for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t begin = column * StripHistory::kTicks / columns;
        const std::size_t end = std::max(begin + 1, (column + 1) * StripHistory::kTicks / columns);
        float low = strips.before(strip, StripHistory::kTicks - 1 - begin);
        float high = low;
        for (std::size_t k = begin + 1; k < end; ++k) {
            const float value = strips.before(strip, StripHistory::kTicks - 1 - k);
            low = std::min(low, value);
            high = std::max(high, value);
        }
        const float x = frame.low.x + static_cast<float>(column);
        list.AddRectFilled({x, frame.y_of(high) - 1.0F}, {x + 1.0F, frame.y_of(low) + 0.5F},
                           colour);
    }
}

/// Three numbers at the left of the frame; the lowest one above its end, or `below`, beside it.
void draw_values_axis(ImDrawList& list, const ChartFrame& frame, float scale, bool below) {
    const float text = ImGui::GetTextLineHeight();
    const ImU32 quiet = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    const float middle = 0.5F * (frame.range.low + frame.range.high);
    list.AddLine({frame.low.x, frame.y_of(middle)}, {frame.high.x, frame.y_of(middle)},
                 ImGui::GetColorU32(ImGuiCol_Separator));
    for (const float value : {frame.range.low, middle, frame.range.high}) {
        const std::string label = formatted("%g", static_cast<double>(value));
        const float width = ImGui::CalcTextSize(label.c_str()).x;
        const float y = std::clamp(frame.y_of(value) - 0.5F * text, frame.low.y - 0.5F * text,
                                   frame.high.y - (below ? 0.5F : 1.0F) * text);
        list.AddText({frame.low.x - width - 4.0F * scale, y}, quiet, label.c_str());
    }
}

/// A line each second; labelled if `labels_y` is given.
void draw_time_axis(ImDrawList& list, const ChartFrame& frame, std::optional<float> labels_y) {
    constexpr int kSeconds = static_cast<int>(StripHistory::kTicks / kTicksPerSecond);
    for (int second = 0; second < kSeconds; ++second) {
        const float x = frame.x_of(second * kTicksPerSecond);
        list.AddLine({x, frame.low.y}, {x, frame.high.y}, ImGui::GetColorU32(ImGuiCol_Separator));
        if (!labels_y) continue;
        const std::string label = second == 0 ? "now" : formatted("-%d s", second);
        const float width = ImGui::CalcTextSize(label.c_str()).x;
        list.AddText({second == 0 ? x - width : x - 0.5F * width, *labels_y},
                     ImGui::GetColorU32(ImGuiCol_TextDisabled), label.c_str());
    }
}

/// The chart's name, or, under the pointer, its value there.
std::string chart_text(const StripKind& kind, const StripHistory& strips,
                       std::optional<std::size_t> age) {
    if (!age) return formatted("%s [%s]", kind.name, kind.unit);
    return formatted("%s %.3g %s, %.3f s ago", kind.name,
                     static_cast<double>(strips.before(kind.strip, *age)), kind.unit,
                     static_cast<double>(*age) / kTicksPerSecond);
}

/// The space for the numbers at the left of a chart's frame.
float gutter() {
    return 3.2F * ImGui::GetFontSize();
}

/// The title, the frame with the values, and the time under the last chart.
void draw_chart(const StripKind& kind, const StripHistory& strips, float scale, bool last,
                std::optional<std::size_t> age) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 high{low.x + ImGui::GetContentRegionAvail().x, low.y + kHeight_lines * line};
    const ChartFrame frame{{low.x + gutter(), low.y + 1.3F * line},
                           {high.x - 4.0F * scale, high.y - (last ? 1.2F * line : 0.2F * line)},
                           range_of(strips, kind)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0F * scale);
    draw_values_axis(list, frame, scale, last);
    draw_time_axis(list, frame, last ? std::optional(high.y - 1.05F * line) : std::nullopt);
    draw_values(list, strips, kind.strip, frame);
    if (age) {
        const float x = frame.x_of(static_cast<double>(*age));
        list.AddLine({x, frame.low.y}, {x, frame.high.y}, ImGui::GetColorU32(ImGuiCol_Text));
    }
    list.AddText({frame.low.x, low.y + 1.0F * scale},
                 ImGui::GetColorU32(age ? ImGuiCol_Text : ImGuiCol_TextDisabled),
                 chart_text(kind, strips, age).c_str());
    ImGui::Dummy({high.x - low.x, high.y - low.y});
}

/// The buttons in the upper right corner of the first chart.
void draw_buttons(ViewerState& state, ImVec2 corner) {
    const float gap = 2.0F * state.ui.scale;
    const char* const choose = "Charts";
    const char* const hold = state.ui.paused_strips ? "Go on" : "Pause";
    const ImVec2 below = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos(
        {corner.x - button_width(choose) - button_width(hold) - 2.0F * gap, corner.y + gap});
    if (item::small_button(hold)) {
        if (state.ui.paused_strips) {
            state.ui.paused_strips.reset();
        } else {
            state.ui.paused_strips = state.touch.strips;
        }
    }
    add_tooltip("The charts are held; touching goes on");
    ImGui::SameLine(0.0F, gap);
    if (item::small_button(choose)) ImGui::OpenPopup("charts");
    add_tooltip("Which charts are drawn");
    if (ImGui::BeginPopup("charts")) {
        for (const StripKind& kind : kKinds) {
            item::checkbox(kind.name, &(state.settings.charts.*kind.shown));
            add_tooltip(kind.help);
        }
        ImGui::EndPopup();
    }
    ImGui::SetCursorScreenPos(below);
}

}  // namespace

void draw_strip_charts(ViewerState& state) {
    ImGui::PushID("charts");
    const StripHistory& strips =
        state.ui.paused_strips ? *state.ui.paused_strips : state.touch.strips;
    ChartsShown& shown = state.settings.charts;
    const auto is_shown = [&shown](const StripKind& kind) { return shown.*kind.shown; };
    if (std::none_of(kKinds.begin(), kKinds.end(), is_shown)) shown.force = true;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 high{low.x + ImGui::GetContentRegionAvail().x, state.ui.strips_end_y};
    std::optional<std::size_t> age;
    const float scale = state.ui.scale;
    if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high))
        age = ChartFrame{{low.x + gutter(), low.y}, {high.x - 4.0F * scale, high.y}, {}}.age_at(
            ImGui::GetMousePos().x);
    const auto last = std::find_if(kKinds.rbegin(), kKinds.rend(), is_shown);
    for (const StripKind& kind : kKinds) {
        if (is_shown(kind)) draw_chart(kind, strips, scale, &kind == &*last, age);
    }
    state.ui.strips_end_y = ImGui::GetCursorScreenPos().y;
    draw_buttons(state, {high.x, low.y});
    ImGui::PopID();
}

}  // namespace dibhr
