// The pictures on buttons, drawn as lines and shapes: sharp at every scale.
#pragma once

#include <imgui.h>

namespace dibhr {

enum class Icon {
    play,
    pause,
    step_back,
    step_forward,
    loop,
    restore,
    open,
    record,
    explain,
    paint,
    ruler,
    clip,
    close
};

/// Draws it within `r` pixels around `centre`.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 centre, float r, ImU32 colour);

}  // namespace dibhr
