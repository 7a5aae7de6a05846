// What the viewer draws of a moment: the relief, its marks and the pixels under hand and pointer.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "app/touching/scene.hpp"
#include "app/viewer/viewer.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr {

namespace {

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
    if (markers.visible && markers.contact) trace_.add(markers.proxy, now_s());
    const DepthSurface surface = shown_.drawn_surface(state_.shape(), state_.touch.bump.get());
    markers.trace = trace_.points(surface, now_s());
}

}  // namespace dibhr
