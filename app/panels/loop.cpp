// The Loop panel: how well the 1 kHz loop keeps its time, and the strip chart of the force sent.
#include <algorithm>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

struct Area {
    ImVec2 low{};   // upper left
    ImVec2 high{};  // lower right
};

/// A round number of newtons that the whole chart fits under.
float top_of(const ForceHistory& forces) {
    const float highest = *std::max_element(forces.newton.begin(), forces.newton.end());
    for (const float top : {0.5F, 1.0F, 2.0F, 4.0F}) {
        if (highest <= top) return top;
    }
    return 8.0F;
}

/// One upright stroke a pixel column, from the lowest to the highest force in it: no peak is lost.
void draw_values(ImDrawList& list, const ForceHistory& forces, const Area& frame, float top) {
    const auto columns = static_cast<std::size_t>(std::max(1.0F, frame.high.x - frame.low.x));
    const float per_newton = (frame.high.y - frame.low.y) / top;
    const ImU32 colour = ImGui::GetColorU32(ImGuiCol_CheckMark);
    for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t begin = column * ForceHistory::kTicks / columns;
        const std::size_t end = std::max(begin + 1, (column + 1) * ForceHistory::kTicks / columns);
        float low = 1e9F;
        float high = 0.0F;
        for (std::size_t k = begin; k < end; ++k) {
            const float value = forces.newton[(forces.next + k) % ForceHistory::kTicks];
            low = std::min(low, value);
            high = std::max(high, value);
        }
        const float x = frame.low.x + static_cast<float>(column);
        list.AddRectFilled({x, frame.high.y - std::min(high, top) * per_newton - 1.0F},
                           {x + 1.0F, frame.high.y - std::min(low, top) * per_newton + 0.5F},
                           colour);
    }
}

}  // namespace

void draw_loop_panel(ViewerState& state) {
    if (!section(state, "Loop", state.settings.panels.loop)) return;
    ImGui::PushID("loop");
    const HapticState& haptic = state.haptic;
    const LoopSecond& second = haptic.second;
    draw_force_chart(state);
    fact_row("Rate", formatted("%.1f per second", second.rate_hz));
    fact_row("Worst tick", formatted("%.3f ms late (last second)", second.worst_lateness_ms));
    fact_row("Late ticks",
             std::to_string(haptic.late_ticks) + " of " + std::to_string(haptic.ticks));
    fact_row("Update",
             formatted("%.2f us, worst %.1f us", second.update_us, second.worst_update_us));
    fact_row("Moves", formatted("%.2f per update", second.moves));
    if (haptic.bounds_met > 0) {
        fact_row("Catching up", std::to_string(haptic.bounds_met) + " of " +
                                    std::to_string(haptic.ticks) + " ticks");
    }
    fact_row("Decoding", formatted("%.1f ms a frame", state.playback.decode_ms));
    fact_row("Pictures", formatted("%.0f per second", state.pictures_per_s));
    fact_row("Priority", state.grants ? state.grants->priority.answer : "asking");
    fact_row("Memory lock", state.grants ? state.grants->memory_lock.answer : "asking");
    ImGui::PopID();
}

void draw_force_chart(const ViewerState& state) {
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const Area frame{low, {low.x + ImGui::GetContentRegionAvail().x, low.y + 5.0F * line}};
    const float top = top_of(state.forces);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 quiet = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    list.AddRectFilled(frame.low, frame.high, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0F);
    const float middle = (frame.low.y + frame.high.y) * 0.5F;
    list.AddLine({frame.low.x, middle}, {frame.high.x, middle},
                 ImGui::GetColorU32(ImGuiCol_Separator));
    draw_values(list, state.forces, frame, top);
    list.AddText({frame.low.x + 6.0F, frame.low.y + 3.0F}, quiet,
                 formatted("Force, %g N", top).c_str());
    const std::string span =
        formatted("last %.0f s", static_cast<double>(ForceHistory::kTicks) / 1000.0);
    const float width = ImGui::CalcTextSize(span.c_str()).x;
    list.AddText({frame.high.x - width - 6.0F, frame.low.y + 3.0F}, quiet, span.c_str());
    ImGui::Dummy({frame.high.x - frame.low.x, frame.high.y - frame.low.y});
    explain("Length of the force sent at every tick");
}

}  // namespace dibhr
