// Labels over the relief: text on a rounded background, readable over any picture.
#pragma once

#include <imgui.h>

#include <string>

#include "app/panels/viewer_state.hpp"

namespace dibhr {

/// The background of a label.
void draw_ground(ImVec2 low, ImVec2 size, float alpha = 1.0F,
                 ImDrawList& list = *ImGui::GetBackgroundDrawList());

/// The size of a label with its background [px]. `widest`: it is wrapped at that; 0: not wrapped.
[[nodiscard]] ImVec2 label_size(const std::string& text, float widest = 0.0F,
                                ImVec2 pad = ImGui::GetStyle().FramePadding);

/// Draws a label. Returns its height [px].
float label(const std::string& text, ImVec2 low, float alpha, float widest = 0.0F,
            ImDrawList& list = *ImGui::GetBackgroundDrawList(),
            ImVec2 pad = ImGui::GetStyle().FramePadding);

/// The caption of the shown moment, centred above the bar.
void draw_caption(const ViewerState& state);

/// The region under the finger by its name, and once the finger rests by its text. Returns the
/// height with the gap below [px]; 0: nothing is touched that has a name.
float draw_region(const ViewerState& state, ImVec2 low, float widest);

}  // namespace dibhr
