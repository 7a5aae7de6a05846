// The Video panel beside a video that plays.
#include <imgui.h>

#include <optional>
#include <string>

#include "app/panels/panels.hpp"
#include "core/video/playing/transport.hpp"
#include "tests/app/panels/undrawn_context.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

class NoTransport final : public Transport {
    void play() override {}
    void pause() override {}
    void seek(double /*t_s*/) override {}
    void step(int /*by*/) override {}
    void set_looping(bool /*looping*/) override {}
    void set_part(const std::optional<MediaPart>& /*part*/) override {}
    void set_speed(double /*speed*/) override {}
};

/// Of an hour and a half at 60 frames a second.
ViewerState playing() {
    ViewerState state;
    state.ui.window_width = 800.0F;
    state.media.colour_path = "colour.mp4";
    state.media.depth_path = "depth.mkv";
    PlaybackStatus& playback = state.media.playback;
    playback.playing = true;
    playback.frame = 123'455;
    playback.frames = 324'000;
    playback.frames_per_s = 60.0;
    playback.shown_per_s = 60.0;
    return state;
}

/// [pixels] of the panel in the second picture, when all of its sizes are known.
float height_of_panel(ViewerState& state) {
    const test::UndrawnContext context;
    NoTransport transport;
    float height = 0.0F;
    for (int picture = 0; picture < 2; ++picture) {
        ImGui::NewFrame();
        ImGui::SetNextWindowSize({panel_column_width(state), ImGui::GetIO().DisplaySize.y});
        ImGui::Begin("Panels", nullptr, ImGuiWindowFlags_NoTitleBar);
        const float begin = ImGui::GetCursorPosY();
        draw_video_panel(state, &transport);
        height = ImGui::GetCursorPosY() - begin;
        ImGui::End();
        ImGui::Render();
    }
    return height;
}

}  // namespace

TEST_CASE("what a slow machine drops moves no row of the panels", "[panels]") {
    ViewerState state = playing();
    const float height = height_of_panel(state);
    CHECK(height > 100.0F);
    state.media.playback.shown_per_s = 12.0;
    state.media.playback.dropped =
        "Shown 12 of 60 frames a second: decoding and cleaning take 83 ms a frame. Cleaning leaves "
        "out the filter in time, sharp silhouettes, smoothing of noise. In-betweens are off.";
    CHECK(height_of_panel(state) == height);
}
