// The panels, each in a file of its own. They draw, and edit the state they are given.
#pragma once

#include "app/viewer_state.hpp"

namespace dibhr {

void draw_video_panel(ViewerState& state, Player& player);
void draw_surface_panel(ViewerState& state);
void draw_touch_panel(ViewerState& state);
void draw_device_panel(ViewerState& state);
void draw_loop_panel(ViewerState& state);

/// The column at the right with all of the above. Its width in pixels is panel_column_width().
void draw_panel_column(ViewerState& state, Player& player);
[[nodiscard]] float panel_column_width(const ViewerState& state);

/// The bar under the relief: play, time line, time and frame, force switch.
void draw_transport_bar(ViewerState& state, Player& player);

/// Over the relief: the force in numbers, notices; `now_s` counts from the start.
void draw_overlay(const ViewerState& state, double now_s);

/// How to touch, for who has not touched yet; `alpha` 0 .. 1 fades it out.
void draw_hint(const ViewerState& state, float alpha);

/// The help sheet and the message box, on top of everything.
void draw_help_sheet(ViewerState& state);
void draw_message_box(ViewerState& state);

/// The strip chart of the force, as wide as there is room.
void draw_force_chart(const ViewerState& state);

/// "Force on" or "Force off", as a large switch of the given width.
void draw_force_switch(ViewerState& state, float width);

}  // namespace dibhr
