// The Touch panel: the parameters of each tick, from the table of options; material and sound.

#include <algorithm>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/touching/force_law.hpp"

namespace dibhr {

namespace {

/// Why the video's motion cannot carry the proxy, if carrying is on.
void draw_motion_trouble(const ViewerState& state) {
    if (!state.settings.touch.carry || state.media.depth_path.empty()) return;
    const std::string trouble = motion_trouble(state.media);
    if (!trouble.empty()) draw_dimmed(capitalised(trouble) + '.');
}

/// In a replay: whether the parameters are the recorded ones, and a button to restore them.
void draw_origin(ViewerState& state) {
    if (!state.touch.replay) return;
    if (!state.touch.replay->computes) {
        draw_dimmed("As recorded. Change something: the forces are computed again.");
        return;
    }
    draw_dimmed("Computed again with these. The pale ball is the recorded proxy.");
    if (item::button("As recorded", {-1.0F, 0.0F})) state.commands.push(ReplayAsRecorded{});
    add_tooltip("Back to the recorded parameters, proxies and forces");
}

/// A note if the device cannot render the requested stiffness or damping.
void draw_effective_coupling(const ViewerState& state) {
    const Coupling held = effective_coupling(state.settings, state.touch);
    if (!(held == requested_coupling(state.settings, state.touch))) {
        draw_dimmed(
            formatted("Felt as %.2f N/mm and %.1f N s/m: the device can give no more at this scale "
                      "of the workspace and with this delay.",
                      held.stiffness_newton_per_mm, held.damping_newton_s_per_m));
    }
}

/// Stability control, automatic or manual damping, and the measured energy.
void draw_stability(ViewerState& state) {
    Settings& settings = state.settings;
    const DeviceDynamics& hand = limits_of_hand(state.touch).dynamics;
    if (state.touch.replay || !hand.moves()) {  // no force moves the mouse
        draw_parameters(TouchTopic::damper, settings.touch);
        return;
    }
    flag_row("Stability control", settings.stability, true,
             "Takes out the energy that rendering itself creates, and flicker of the depth "
             "(--stability); off for experiments that must not have it");
    if (settings.stability) {
        flag_row(
            "Damping as the hand needs", settings.damping_as_needed, true,
            "On: as much as the device's delay needs at this stiffness. Off: your own damping");
    }
    const Coupling felt = effective_coupling(state.settings, state.touch);
    if (felt == held_coupling(settings.touch.coupling, limits_of_hand(state.touch))) {
        draw_parameters(TouchTopic::damper, settings.touch);
    } else {
        fact_row("Damping",
                 formatted("%.1f N s/m below %.0f Hz", felt.damping_newton_s_per_m,
                           felt.damping_cutoff_hz),
                 "A force against the hand's speed, as much as this device needs");
    }
    const double margin = stability_margin(felt, hand);
    fact_row("Stability margin", formatted("%+.1f N s/m", margin),
             "By how much the hand is damped more than the spring drives it; below 0 it swings");
    if (margin < 0.0)
        draw_warning("A light or free grip swings: raise the damping, or lower the stiffness.");
    const EnergyFlow& energy = state.touch.haptic.touch.energy;
    fact_row("Energy",
             formatted("video %.1f, created %.1f mW", energy.from_video_mw, energy.created_mw),
             "What the moving video does to the hand, and what rendering adds by itself");
    constexpr double kNoticed_mw = 0.05;
    fact_row("Controller",
             energy.taken_out_mw < kNoticed_mw
                 ? "quiet"
                 : formatted("takes out %.1f mW", energy.taken_out_mw),
             "How much of the energy that rendering adds is taken out");
}

constexpr const char* kLedTo = "bark";  // at the first start

/// A button of the row of materials, lit if it is the chosen one; on a new line if the row is full.
void draw_material(ViewerState& state, const std::string& name, const char* help) {
    const std::string label = display_name(name.empty() ? std::string(kAsRecorded) : name);
    if (!name.empty()) {  // not the first
        ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
        if (ImGui::GetContentRegionAvail().x < button_width(label.c_str())) ImGui::NewLine();
    }
    const bool chosen = state.touch.material.name == name;
    const auto push = [chosen](ImGuiCol of, ImGuiCol usual) {
        ImGui::PushStyleColor(of, ImGui::GetStyleColorVec4(chosen ? ImGuiCol_SliderGrab : usual));
    };
    push(ImGuiCol_Button, ImGuiCol_FrameBg);
    push(ImGuiCol_ButtonHovered, ImGuiCol_ButtonHovered);  // the pointer is on what it chose
    if (item::button(label.c_str()))
        state.commands.push(UseMaterial{name.empty() ? std::string(kAsRecorded) : name});
    ImGui::PopStyleColor(2);
    if (state.ui.lead && name == kLedTo && ImGui::IsItemVisible()) {
        const ImVec2 low = ImGui::GetItemRectMin();
        const ImVec2 high = ImGui::GetItemRectMax();
        state.ui.lead->button = {low.x, low.y, high.x, high.y};
    }
    add_tooltip(help);
}

/// The materials, and a field to save a changed material under a name.
void draw_materials(ViewerState& state) {
    if (state.touch.replay) return;
    ImGui::PushID("materials");
    draw_material(state, {}, "Only what the depth shows: no bump map, default friction and spring");
    for (const std::string& name : state.ui.materials.shipped)
        draw_material(state, name, "Bump map, friction, stiffness and damping in one (--material)");
    for (const std::string& name : state.ui.materials.own)
        draw_material(state, name, own_materials_folder().c_str());
    const Material& material = state.touch.material;
    const bool changed =
        state.touch.bump_file != material.map || !is_made_of(material, state.settings.touch);
    if (changed) {
        const bool done =
            text_field("##keep", "Changed: keep as a material called ...", state.ui.fields.material,
                       "Enter keeps what is felt now under that name");
        if (done && state.ui.fields.material.front() != '\0')
            state.commands.push(KeepMaterial{state.ui.fields.material.data()});
    }
    ImGui::PopID();
}

void draw_bump(ViewerState& state) {
    if (state.touch.replay) {
        if (state.touch.bump) fact_row("Bump map", state.touch.bump_file.filename().string());
        return;
    }
    if (text_field("##bump", "Bump map: a grey picture, or drop it here", state.ui.fields.bump,
                   "Path of a picture laid over the surface as fine relief; Enter takes it")) {
        state.commands.push(LoadBump{expand_home(state.ui.fields.bump.data())});
    }
    if (!state.touch.bump) return;
    fact_row("Bump map", state.touch.bump_file.filename().string());
    if (item::button("Remove the bump map")) state.commands.push(LoadBump{});
}

/// The sound's volume and mute.
void draw_sound(ViewerState& state) {
    if (state.touch.replay) return;  // a replay makes no sound
    if (state.touch.sound == SoundOutput::State::no_device) {
        fact_row("Sound", "No sound device");
        return;
    }
    Settings& settings = state.settings;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float mute_width = ImGui::GetFrameHeight() + style.ItemInnerSpacing.x +
                             ImGui::CalcTextSize("Mute").x + style.ItemSpacing.x;
    double percent = 100.0 * settings.sound_volume;
    if (number_row(
            {.label = "Sound",
             .format = "%.0f %%",
             .lowest = 0.0,
             .highest = 100.0,
             .standard = 100.0 * Settings{}.sound_volume,
             .help = "Volume of the sound of touch: taps, scraping and texture of the material",
             .beside = mute_width},
            percent)) {
        settings.sound_volume = std::clamp(percent / 100.0, 0.0, 1.0);
    }
    ImGui::SameLine();
    item::checkbox("Mute", &settings.mute);
    add_tooltip("Touch makes no sound", state.keys, Action::toggle_sound);
}

/// Not in a replay, which has no sound rows either.
void draw_speech(ViewerState& state) {
    if (state.touch.replay) return;
    flag_row("Speak", state.settings.speak, Settings{}.speak,
             "What is touched, messages and captions are spoken, through speech-dispatcher "
             "(--speak)");
    if (!state.settings.speak || state.ui.speech_trouble.empty()) return;
    text_beside_flag("nothing is spoken");
    add_tooltip(state.ui.speech_trouble.c_str());
}

std::string pads_text(const PadInfo& pads, bool coils_move) {
    if (pads.state == PadInfo::State::no_session) return "needs a desktop session";
    if (pads.found.empty()) return "none found";
    std::string text;
    for (const FoundPad& pad : pads.found) {
        const char* does = pad.has_coils && coils_move ? "voice coils"
                           : pad.rumbles               ? "rumble"
                                                       : "cannot rumble";
        text += (text.empty() ? "" : "\n") + pad.name + ": " + does;
    }
    return text;
}

void draw_game_pad(ViewerState& state) {
    if (state.touch.replay) return;
    Settings& settings = state.settings;
    flag_row("Game pad", settings.game_pad, Settings{}.game_pad,
             "It rumbles with what is touched, also while muted; it does not move the hand "
             "(--game-pad)");
    if (state.touch.pads.state != PadInfo::State::off)
        text_beside_flag(pads_text(state.touch.pads, state.touch.moves_coils));
}

}  // namespace

void draw_touch_panel(ViewerState& state) {
    if (!section(state, "Touch", state.settings.panels.touch, &state.ui.show_touch)) return;
    ImGui::PushID("touch");
    draw_origin(state);
    draw_materials(state);
    draw_parameters(TouchTopic::algorithm, state.settings.touch);
    draw_parameters(TouchTopic::spring, state.settings.touch);
    draw_effective_coupling(state);
    draw_stability(state);
    draw_parameters(TouchTopic::friction, state.settings.touch);
    draw_motion_trouble(state);
    draw_bump(state);
    draw_parameters(TouchTopic::texture, state.settings.touch);
    if (!state.touch.bump && !state.touch.replay)
        draw_dimmed("Roughness needs a bump map to be felt.");
    draw_outlines_row(state);
    draw_sound(state);
    draw_speech(state);
    draw_game_pad(state);
    const std::string others = "Where the proxies of the other algorithms are, for the same goal" +
                               state.keys.in_brackets(Action::toggle_others);
    flag_row("Side by side", state.settings.others, Settings{}.others, others.c_str());
    ImGui::PopID();
}

}  // namespace dibhr
