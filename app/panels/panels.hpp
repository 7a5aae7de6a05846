// The panels, each in a file of its own. They draw, and edit the state they are given.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "core/haptics/surface.hpp"
#include "core/video/playing/transport.hpp"
#include "render/relief_paint.hpp"

namespace dibhr {

/// `player` null: the video of a replay, which goes by itself.
void draw_video_panel(ViewerState& state, Transport* player);
/// What the depth's levels mean, to be changed; part of the Video panel.
void draw_depth_rows(ViewerState& state);
/// Puts what the panel says of the file that is open now into the rows that are typed.
void show_depth_words(ViewerState& state);
/// The same in one line, which opens them when it is clicked.
void draw_depth_line(ViewerState& state);
void draw_surface_panel(ViewerState& state);
/// How high a pixel stands, "12.3 px, 1.74 mm", and what its depth is in the file's own words,
/// "0.512 m (level 173.0)"; empty where nothing is known of that.
[[nodiscard]] std::string elevation_text(const ViewerState& state, const PixelShown& pixel);
[[nodiscard]] std::string depth_text(const ViewerState& state, const PixelShown& pixel);
/// As many digits after the point for all of a depth's values, in its unit, so that a quarter of
/// its range has two.
[[nodiscard]] int depth_digits(const DepthMeaning& meaning);
void draw_touch_panel(ViewerState& state);
void draw_device_panel(ViewerState& state);
void draw_loop_panel(ViewerState& state);

/// Recording: start, stop, who, notes and marks, and how it goes.
void draw_session_panel(ViewerState& state);

/// Parts of the Device panel, of a device that is in sight: what it does and needs, with the guided
/// homing and the firmware; then its rows by topic.
void draw_force_device(ViewerState& state, const DeviceNews& news);
void draw_homing_guide(const std::vector<HomedAxis>& axes);
void draw_force_device_settings(ViewerState& state, const DeviceNews& news);

/// Starts and ends a clip of the window, as wide as there is room.
void draw_clip_button(ViewerState& state);

/// In a replay: whose it is, what was felt at the moment shown, its marks.
void draw_replay_panel(ViewerState& state, Transport& replay);

/// The column at the right with all that applies to what plays: a video, or a session. Its width in
/// pixels is panel_column_width().
void draw_panel_column(ViewerState& state, Transport& transport);
[[nodiscard]] float panel_column_width(const ViewerState& state);

/// Of the bar under the relief [px].
[[nodiscard]] float bottom_bar_height(const ViewerState& state);
/// The bar under the relief: play, time line, time and frame, force switch; of a replay, contacts
/// and marks on the time line. While the panels are hidden it comes when the pointer does, and the
/// force switch stays.
void draw_bottom_bar(ViewerState& state, Transport& transport);

/// Whether the colour picture and the depth are shown above the relief, and how high they are [px];
/// 0: they are not.
[[nodiscard]] bool shows_panes(const ViewerState& state);
[[nodiscard]] float panes_height(const ViewerState& state);
/// What their depth is painted with; without them, what the relief is.
[[nodiscard]] ReliefPaint depth_paint(const ViewerState& state);
/// The pixel of the grid under a place of the window; nothing: it is beside the panes.
[[nodiscard]] std::optional<Vec3> place_on_panes(const ViewerState& state, glm::dvec2 position_px);
void draw_panes(const ViewerState& state);

/// How far the ruler's points are apart, or what to do next; of a ruler that is on.
[[nodiscard]] std::string ruler_text(const ViewerState& state);
/// Its points and its line, on the relief seen by that camera; nothing when it is off.
void draw_ruler(const ViewerState& state, const glm::dmat4& clip_from_grid);

/// The brush that lays touch maps on the relief.
void draw_paint_panel(ViewerState& state);
/// Its edge on the relief seen by that camera; nothing when it is off.
void draw_brush(const ViewerState& state, const glm::dmat4& clip_from_grid);

/// Over the relief: the force in numbers, notices; `now_s` counts from the start.
void draw_overlay(const ViewerState& state, double now_s);

/// That a clip is made. `drawn` is called when all but that has been drawn, in Gui::end(): until
/// then it must last.
void draw_over_pictures(const ViewerState& state, const std::function<void()>& drawn);

/// What there is to find out with the mouse.
enum class Hint { touch, press_deeper };
/// For who has not done it yet; `alpha` 0 .. 1 fades it out.
void draw_hint(const ViewerState& state, Hint hint, float alpha);

/// The update that is explained: on the relief, as far as steps were taken, and what the last one
/// did in words, with its buttons. `clip_from_grid` is the relief's camera, `surface` what is felt.
void draw_explanation(ViewerState& state, const DepthSurface& surface,
                      const glm::dmat4& clip_from_grid);

/// What to do where nothing is open.
void draw_nothing_open(ViewerState& state);

/// Over the relief, which goes on with the usual values: what protects the hand less in the
/// settings file, to be agreed to.
void draw_doubts(ViewerState& state);

/// Over the relief, which goes on: a video of colour alone, and the depth that is made for it.
void draw_depth_offer(ViewerState& state);

/// The window's own dialog for opening files.
void draw_open_dialog(ViewerState& state);

/// The help sheet and the message box, on top of everything.
void draw_help_sheet(ViewerState& state);
void draw_message_box(ViewerState& state);

/// The strip chart of the force, as wide as there is room.
void draw_strip_charts(ViewerState& state);

/// "Force on" or "Force off", as a large switch of the given width.
void draw_force_switch(ViewerState& state, float width);

}  // namespace dibhr
