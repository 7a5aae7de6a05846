// What the viewer draws of a moment: the relief with its marks, the panels, and saved pictures.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "app/panels/panels.hpp"
#include "app/touching/device_state.hpp"
#include "app/touching/scene.hpp"
#include "app/viewer/viewer.hpp"
#include "core/haptics/surface.hpp"
#include "core/video/sources/picture_files.hpp"
#include "render/gl_objects.hpp"

namespace dibhr {

namespace {

/// How long after its start the window waits for the first surface.
constexpr std::chrono::milliseconds kFirstSurface{100};

/// The frames of a video that is drawn at its own rate, and of a slow one moments between them.
DepthBlend in_steps(DepthBlend shown, double speed) {
    constexpr double kLongest_s = 0.05;
    const double lasts_s = (shown.to->time_s - shown.from->time_s) / speed;
    const double steps = std::max(1.0, std::floor(lasts_s / kLongest_s));
    shown.blend = std::min(std::floor(shown.blend * steps), steps - 1.0) / steps;
    return shown;
}

/// The pixel at a place in grid space; nothing beside the picture.
std::optional<PixelShown> pixel_at(Vec3 place, const ViewerState& state, const DepthBlend& shown) {
    if (!shown.makes_surface()) return {};
    const DepthImage& depth = *shown.with_in_betweens().from->drawn();
    const int i = static_cast<int>(std::lround(place.x));
    const int j = static_cast<int>(std::lround(place.y));
    if (i < 0 || j < 0 || i >= depth.columns || j >= depth.rows) return {};
    const DepthSurface surface = shown.drawn_surface(state.shape(), state.touch.bump.get());
    const auto& unseen = shown.with_in_betweens().nearest().unseen;
    return PixelShown{i, j, depth.at(i, j) / depth.highest_level, surface.elevation_at(i, j),
                      unseen && (*unseen)[depth.index(i, j)] != 0};
}

}  // namespace

/// The relief of this turn; valid during it.
SceneContent Viewer::prepare_scene() {
    camera_.set_projection(state_.settings.straight_view ? Camera::Projection::straight
                                                         : Camera::Projection::perspective);
    state_.ui.under_hand = pixel_at(state_.touch.haptic.touch.goal, state_, shown_);
    state_.ui.under_pointer.reset();
    if (pointed_at_) state_.ui.under_pointer = pixel_at(*pointed_at_, state_, shown_);
    if (state_.ui.ruler) {
        state_.ui.ruler->ends.clear();
        for (const Vec3& place : state_.ui.ruler->places)
            if (const auto end = pixel_at(place, state_, shown_))
                state_.ui.ruler->ends.push_back(*end);
    }
    SceneContent content = scene_content(state_.settings, state_.touch, shown_);
    content.look = state_.touch.material.look;
    if (state_.ui.explained) {  // hide the markers of the touch
        content.markers.visible = false;
        content.dent = {};
    }
    if (!state_.touch.replay) content.maps = painting_.drawn();
    if (state_.ui.brush.on) {
        content.relief_style.paint = ReliefPaint::video;
        content.colour = painting_.tinted(content.colour, state_);
        content.markers.visible = false;  // the mouse paints and does not touch
    }
    leave_trace(content.markers);
    return content;
}

/// Software draws a video that runs once a frame, not more often for a hand that moves meanwhile.
SceneMark Viewer::mark_scene(SceneContent content, glm::ivec2 viewport) const {
    const bool by_frame = software_ && video_runs() && shown_.makes_surface();
    if (by_frame) content.depth = in_steps(shown_, state_.media.playback.speed);
    SceneMark mark = scene_mark(content, camera_, viewport);
    return by_frame ? change_.with_drawn_hand(std::move(mark), std::chrono::steady_clock::now())
                    : mark;
}

void Viewer::leave_trace(TouchMarkers& markers) {
    if (!state_.settings.relief_style.trace || !shown_.makes_surface()) return;
    trace_.mark(shown_.drawn_surface(state_.shape(), state_.touch.bump.get()), now_s(), markers);
}

/// At first the surface comes within some ms, and a picture without it would delay the one with it.
bool Viewer::waits_for_surface(steady_clock::time_point now) const {
    const bool comes = !state_.media.depth_path.empty() && !state_.media.live;
    return comes && !shown_.makes_surface() && now < start_ + kFirstSurface;
}

/// Draws relief and panels if they differ from the last picture, or a clip or screenshot needs one,
/// and passes the picture on to these. False: nothing was drawn.
bool Viewer::draw_if_changed(const WindowInput& input) {
    if (input.damaged) change_.forget();
    const bool of_relief = wants_picture(PictureOf::relief);
    const bool of_window = wants_picture(PictureOf::window);
    const bool wanted = of_relief || of_window;
    if (!window_.visible() && !wanted) {
        change_.forget();
        return false;
    }
    const auto now = steady_clock::now();
    if (waits_for_surface(now) && !wanted) return false;
    explaining_.advance(shown_, state_, camera_, now_s());  // relief and marks from one view
    const glm::ivec2 viewport = relief_viewport();
    camera_.set_covered_below(kiosk_height(state_) / static_cast<float>(viewport.y));
    const Camera camera = camera_;  // the panels may move it for the next picture
    SceneContent content = prepare_scene();
    const bool saved = wanted || clip_.active();
    content.relief_style.coarse = content.relief_style.coarse || (!saved && pictures_pass());
    const SceneMark scene = mark_scene(content, viewport);
    const PanelChanges panels{input.any, gui_.in_use(), video_runs()};
    if (change_.waits(most_pictures_per_s(), panels, now) && !wanted) return false;
    if (!change_.may_differ(scene, panels, now) && !wanted) return false;
    ColourImage picture;
    // What is drawn after `read` is on the screen, but not in saved pictures.
    const std::function<void()> read = [&] {
        if (of_window) picture = read_framebuffer(window_.framebuffer_size());
    };
    lay_out_panels(input, read);
    if (!change_.take({scene, gui_.content()}, now) && !wanted) return false;
    scene_.draw(content, camera, viewport);
    follow_pointer();
    if (of_relief) deliver_picture(PictureOf::relief, read_framebuffer(viewport));
    beat();
    gui_.draw();
    if (of_window) deliver_picture(PictureOf::window, std::move(picture));
    beat();
    return true;
}

/// Lays out all panels, for Gui::draw(). `drawn` must exist until then: it is called when all is
/// drawn that saved pictures contain.
void Viewer::lay_out_panels(const WindowInput& input, const std::function<void()>& drawn) {
    gui_.begin(input, text_opens());
    panes_.show(shown_, state_);
    draw_panes(state_);
    const glm::ivec2 viewport = relief_viewport();
    const glm::dmat4 clip_from_grid =
        camera_.clip_from_grid(static_cast<double>(viewport.x) / viewport.y);
    draw_ruler(state_, clip_from_grid);
    draw_brush(state_, clip_from_grid);
    draw_toolbar(state_);
    if (state_.settings.panels_visible) draw_panel_column(state_, transport());
    draw_bottom_bar(state_, transport());
    const auto fade = [](float& alpha) { alpha = std::max(0.0F, alpha - 0.2F); };
    if (state_.ui.touched) fade(hint_alpha_);
    if (pressed_deeper_) fade(wheel_hint_alpha_);
    const bool mouse_touches =
        shown_.makes_surface() && !state_.ui.lead && !state_.touch.replay && touch_.by_mouse();
    if (mouse_touches && state_.ui.message.empty() && !state_.ui.explained && !state_.ui.ruler &&
        !state_.ui.brush.on && !state_.ui.depth_question) {
        draw_hint(state_, Hint::touch, hint_alpha_);
        const bool may_press_deeper =
            hint_alpha_ <= 0.0F && state_.touch.haptic.touch.proxy.contact;
        if (may_press_deeper) draw_hint(state_, Hint::press_deeper, wheel_hint_alpha_);
    }
    draw_overlay(state_, now_s());
    draw_nothing_open(state_);
    if (const auto opening = opening_shown())
        draw_opening(*opening, state_.ui.fonts,
                     state_.ui.window_width - panel_column_width(state_));
    draw_explained();
    draw_panel_ground(state_);
    draw_unsafe_settings(state_);
    draw_depth_offer(state_);
    asking_.draw_reliefs(shown_, touch_.media_number(), state_, scene_);
    draw_depth_question(state_);
    draw_open_dialog(state_);
    draw_help_sheet(state_);
    draw_message_box(state_);
    draw_lead(state_, clip_from_grid);
    draw_over_pictures(state_, drawn);
    gui_.end();
}

void Viewer::draw_explained() {
    if (!state_.ui.explained) return;
    const glm::ivec2 viewport = relief_viewport();
    const DepthSurface surface = shown_.surface(state_.shape(), state_.touch.bump.get());
    draw_explanation(state_, surface,
                     camera_.clip_from_grid(static_cast<double>(viewport.x) / viewport.y));
}

bool Viewer::wants_picture(PictureOf of) const {
    return screenshots_.wants(of) ||
           (shown_.makes_surface() && clip_.wants(of, steady_clock::now()));
}

/// Passes a picture to screenshot and clip where they need it.
void Viewer::deliver_picture(PictureOf of, ColourImage picture) {
    const auto now = steady_clock::now();
    if (screenshots_.wants(of)) screenshots_.save(of, picture, picture_name(state_));
    if (shown_.makes_surface() && clip_.wants(of, now)) clip_.add(std::move(picture), now);
}

void Viewer::write_last_picture() {
    if (options_.screenshot.empty()) return;
    // Draw again: after a swap the content of the buffer is undefined.
    const glm::ivec2 relief = relief_viewport();
    const SceneContent content = prepare_scene();
    const bool whole = options_.pictures_of == PictureOf::window;
    const std::function<void()> nothing = [] {};
    if (whole) lay_out_panels({}, nothing);
    scene_.draw(content, camera_, relief);
    if (whole) gui_.draw();
    write_png(read_framebuffer(whole ? window_.framebuffer_size() : relief), options_.screenshot);
}

/// For a screenshot requested in the last picture.
void Viewer::take_last_screenshot() {
    if (screenshots_.wants(PictureOf::window) || screenshots_.wants(PictureOf::relief))
        static_cast<void>(draw_if_changed({}));
}

glm::ivec2 Viewer::relief_viewport() const {
    glm::ivec2 size = window_.framebuffer_size();
    size.x -= static_cast<int>(panel_column_width(state_));
    size.y -= static_cast<int>(panes_height(state_));
    return glm::max(size, glm::ivec2(1));
}

}  // namespace dibhr
