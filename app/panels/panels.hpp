// The panels, each in a file of its own. They draw the state and edit it.
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

/// `player` null: the video of a replay, which follows the session.
void draw_video_panel(ViewerState& state, Transport* player);
/// Rows that show and edit what the depth's levels mean; part of the Video panel.
void draw_depth_rows(ViewerState& state);
/// Fills the typed rows with the panel's statements on the depth that is open now.
void fill_depth_fields(ViewerState& state);
/// The depth's meaning in one line; a click on it opens the rows.
void draw_depth_line(ViewerState& state);
void draw_surface_panel(ViewerState& state);
/// A pixel's elevation, "12.3 px, 1.74 mm", and its depth in the file's own unit, "0.512 m (level
/// 173.0)"; the depth is empty if its meaning is not known.
[[nodiscard]] std::string elevation_text(const ViewerState& state, const PixelShown& pixel);
[[nodiscard]] std::string depth_text(const ViewerState& state, const PixelShown& pixel);
/// Digits after the point for a depth's values in its unit: so many that a quarter of its range has
/// two significant ones.
[[nodiscard]] int depth_digits(const DepthMeaning& meaning);
void draw_touch_panel(ViewerState& state);
/// Whether the outlines of named regions are felt; a row of the Touch panel where there are any.
void draw_outlines_row(ViewerState& state);
void draw_device_panel(ViewerState& state);
void draw_loop_panel(ViewerState& state);

/// Recording: start, stop, participant, notes and marks, and its progress.
void draw_session_panel(ViewerState& state);

/// Parts of the Device panel, for a device that attached_or_expected() accepts: its state and what
/// it needs, with the guided homing and the firmware; then its settings by topic.
void draw_force_device(ViewerState& state, const DeviceInfo& info);
void draw_homing_guide(const std::vector<HomedAxis>& axes);
void draw_force_device_settings(ViewerState& state, const DeviceInfo& info);

/// A button that starts or ends a clip of the window, as wide as there is room.
void draw_clip_button(ViewerState& state);

/// In a replay: the session's facts, the touch at the shown moment, its marks.
void draw_replay_panel(ViewerState& state, Transport& replay);

/// The ground of the column at the right, over all that was drawn under the panels so far.
void draw_panel_ground(const ViewerState& state);
/// The column at the right, with all panels for the video or the session that plays. Its width in
/// pixels is panel_column_width().
void draw_panel_column(ViewerState& state, Transport& transport);
[[nodiscard]] float panel_column_width(const ViewerState& state);

/// Seven buttons with pictures at the left edge of the relief: open, play, record, explain, paint,
/// measure, save a clip. Hidden with the panels, while an update is explained, and where there is
/// no room.
void draw_toolbar(ViewerState& state);
/// Where the toolbar is in the window [px]; nothing: hidden.
struct ToolbarPlace {
    float left{0.0F}, top{0.0F}, right{0.0F}, bottom{0.0F};
};
[[nodiscard]] std::optional<ToolbarPlace> toolbar_place(const ViewerState& state);

/// The height of the bar under the relief [px].
[[nodiscard]] float bottom_bar_height(const ViewerState& state);
/// The bar under the relief: play, time line, time and frame, force switch; in a replay, contacts
/// and marks on the time line. While the panels are hidden, the bar appears only near the pointer;
/// the force switch always stays.
void draw_bottom_bar(ViewerState& state, Transport& transport);

/// Whether the panes (colour picture and depth) are shown above the relief, and their height [px];
/// 0: hidden.
[[nodiscard]] bool shows_panes(const ViewerState& state);
[[nodiscard]] float panes_height(const ViewerState& state);
/// The paint of the panes' depth; without panes, that of the relief.
[[nodiscard]] ReliefPaint depth_paint(const ViewerState& state);
/// The grid pixel under a place of the window; nothing: outside the panes.
[[nodiscard]] std::optional<Vec3> place_on_panes(const ViewerState& state, glm::dvec2 position_px);
void draw_panes(const ViewerState& state);

/// The distance of the ruler's points, or the next step for the person. The ruler must be on.
[[nodiscard]] std::string ruler_text(const ViewerState& state);
/// Draws the ruler's points and line over the relief of that camera, if the ruler is on.
void draw_ruler(const ViewerState& state, const glm::dmat4& clip_from_grid);

/// The settings of the brush that paints touch maps on the relief.
void draw_paint_panel(ViewerState& state);
/// Draws the brush's edge over the relief of that camera, if the brush is on.
void draw_brush(const ViewerState& state, const glm::dmat4& clip_from_grid);

/// Over the relief: the force in numbers, notices; `now_s` counts from the start.
void draw_overlay(const ViewerState& state, double now_s);

/// Shows a person at the first start what to do: marks over the relief and the panels, and a button
/// that skips them, if somebody is led. `clip_from_grid` is the relief's camera.
void draw_lead(ViewerState& state, const glm::dmat4& clip_from_grid);

/// Shows that a clip is made. `drawn` is called in Gui::end(), when all but this label is drawn; it
/// must exist until then.
void draw_over_pictures(const ViewerState& state, const std::function<void()>& drawn);

/// Hints on the use of the mouse.
enum class Hint { touch, press_deeper };
/// For a person who has not done it yet. `alpha`: 0 .. 1, to fade it out.
void draw_hint(const ViewerState& state, Hint hint, float alpha);

/// The explained update: its steps up to the current one on the relief, and a text on that step
/// with buttons. `clip_from_grid` is the relief's camera, `surface` the touched one.
void draw_explanation(ViewerState& state, const DepthSurface& surface,
                      const glm::dmat4& clip_from_grid);

/// What is being opened, in the middle of a place that is so wide [px].
void draw_opening(const OpeningShown& opening, const Fonts& fonts, float width_px);

/// A hint how to open a file, while none is open.
void draw_nothing_open(ViewerState& state);

/// A card over the relief: settings of the file that protect the hand less, for a person to agree
/// to. Until then the defaults are in effect.
void draw_unsafe_settings(ViewerState& state);

/// A card over the relief, for a video without depth: depth can be made for it.
void draw_depth_offer(ViewerState& state);

/// A card over the window that asks which meaning of the depth is right, with a small relief of
/// each, while asks_depth() is true.
void draw_depth_question(ViewerState& state);
/// A few words for each alternative, which tell them apart: "Near is bright", "Millimetres, 0.4 to
/// 3.1 m".
[[nodiscard]] std::vector<std::string> labels_of(const std::vector<DepthAlternative>& alternatives);

/// The window's own dialog for opening files.
void draw_open_dialog(ViewerState& state);

/// The large buttons of a kiosk, in place of the bar under the relief.
void draw_kiosk(ViewerState& state);
/// From the lower edge of the window to above them [px]; 0: there is none.
[[nodiscard]] float kiosk_height(const ViewerState& state);

/// The help sheet and the message box, on top of everything.
void draw_help_sheet(ViewerState& state);
void draw_message_box(ViewerState& state);

/// The strip chart of the force, as wide as there is room.
void draw_strip_charts(ViewerState& state);

/// Why no force is sent although it is switched on, as a clause; empty: nothing holds it back.
[[nodiscard]] std::string why_held(const ViewerState& state);
/// The switch of the force, a large button of the given width.
void draw_force_switch(ViewerState& state, float width);
/// So wide that its text fits in every state.
[[nodiscard]] float force_switch_width();

}  // namespace dibhr
