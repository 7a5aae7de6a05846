// The Loop panel: strip charts, and how well the 1 kHz loop keeps its time.
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

void draw_loop_panel(ViewerState& state) {
    if (!section(state, "Loop", state.settings.panels.loop)) return;
    ImGui::PushID("loop");
    const HapticState& haptic = state.touch.haptic;
    const LoopSecond& second = haptic.second;
    draw_strip_charts(state);
    fact_row("Rate",
             formatted("%.1f per second", second.rate_hz) + (haptic.rests ? ", at rest" : ""),
             "Ticks of the haptic loop: 1000 per second, and 125 while the mouse touches nothing");
    fact_row("Worst tick", formatted("%.3f ms late (last second)", second.worst_lateness_ms),
             "By how much the worst tick missed its deadline");
    fact_row("Late ticks",
             std::to_string(second.late_ticks) + " of " + std::to_string(second.ticks),
             "Ticks that began later than the next tick's deadline");
    fact_row("Update",
             formatted("%.2f us, worst %.1f us", second.update_us, second.worst_update_us),
             "How long the algorithm takes to find proxy and force");
    fact_row("Moves", formatted("%.2f per update", second.moves),
             "Triangles, edges and vertices that the proxy visits on its way");
    if (haptic.bounds_met > 0) {
        fact_row(
            "Catching up",
            std::to_string(haptic.bounds_met) + " of " + std::to_string(second.ticks) + " ticks",
            "Updates that ended before the proxy had caught up with its goal");
    }
    fact_row("Decoding", formatted("%.1f ms a frame", state.media.playback.decode_ms),
             "Reading and cleaning a frame of the video");
    fact_row("Pictures", formatted("%.0f per second", state.ui.cost.pictures_per_s),
             "How often this window is drawn: only when something in it changes");
    fact_row("Processor", formatted("%.1f %% of a core", 100.0 * state.ui.cost.core_share),
             "Processor time of the whole program in the last second");
    fact_row("Priority", state.touch.grants ? state.touch.grants->priority->get().answer : "asking",
             "Whether the system runs the haptic loop before other programs");
    fact_row("Memory lock", state.touch.grants ? state.touch.grants->memory_lock.answer : "asking",
             "Whether the system keeps the program's memory from being moved to the disk");
    ImGui::PopID();
}

}  // namespace dibhr
