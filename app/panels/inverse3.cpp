// The Inverse3 in the Device panel: what it does and what it needs next; then its workspace,
// buttons and service.
#include <string>

#include "app/panels/device_rows.hpp"
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/touching/device_state.hpp"
#include "device/inverse3/frame.hpp"

namespace dibhr {

namespace {

using inverse3::Stage;
using inverse3::Status;

std::string name_text(const Status& status) {
    if (status.id.empty()) return "none attached";
    const char* hand = status.handedness == inverse3::Handedness::left    ? ", left hand"
                       : status.handedness == inverse3::Handedness::right ? ", right hand"
                                                                          : "";
    return status.id + hand;
}

std::string dialect_text(const Status& status) {
    if (!status.dialect) return "not known yet";
    return std::string(name_of(*status.dialect)) +
           (status.dialect_confirmed ? ", told back" : ", not told back yet");
}

std::string grip_text(const inverse3::GripStatus& grip) {
    std::string text = grip.wired ? "wired" : grip.awake ? "awake" : "asleep: press its button";
    if (grip.battery) text += formatted(", battery %.0f %%", 100.0 * *grip.battery);
    return text;
}

/// The histogram's last bin has no upper end.
std::string age_text(double ms) {
    return ms > PoseAges::kLongest_ms ? "20 ms or more" : formatted("%.2f ms", ms);
}

void draw_sentence(const Status& status) {
    if (status.sentence.empty()) return;
    const std::string sentence = capitalised(status.sentence);
    if (status.trouble) {
        trouble_text(sentence);
    } else if (needs_its_person(status.stage)) {
        ImGui::TextWrapped("%s", sentence.c_str());
    } else {
        quiet_text(sentence);
    }
}

void draw_exchange(const Inverse3News& news) {
    const Status& status = news.status;
    fact_row("Exchanges",
             formatted("%.0f per second, %.1f ms each", status.exchanges_per_s, status.exchange_ms),
             "From a message to the service's answer: beyond 2 ms springs are held softer, beyond "
             "5 ms there is no force");
    if (status.softened)
        quiet_text("The service answers slowly: springs are softer, so that they do not swing.");
    if (news.recent_ages.count() > 0) {
        fact_row("Age of the pose",
                 age_text(news.recent_ages.quantile_ms(0.5)) + ", 99 % below " +
                     age_text(news.recent_ages.quantile_ms(0.99)),
                 "How long ago the position that a tick of the haptic loop uses had come from the "
                 "service, in the last second: one above 20 ms gives no force");
    }
    fact_row("Forces", dialect_text(status),
             "How forces are spelled to the service, and whether it told one back");
    if (!status.preset.empty())
        fact_row("Preset",
                 status.preset + (status.other_preset ? ", though another is asked for" : ""));
    if (status.grip) fact_row("Grip", grip_text(*status.grip));
    if (status.unasked + status.not_understood > 0) {
        fact_row("Link", std::to_string(status.unasked) + " not asked for, " +
                             std::to_string(status.not_understood) + " not understood");
    }
}

void draw_workspace(ViewerState& state) {
    Inverse3Settings& settings = state.settings.inverse3;
    if (ImGui::Button("Fit the image")) {
        settings.tuning.workspace.scale = inverse3::fitting_scale_to_box(
            {state.media.depth_columns, state.media.depth_rows,
             state.settings.touch.shape.relief_px, state.settings.touch.coupling.pixel_pitch_mm},
            settings.box_mm);
    }
    explain("The scale at which the comfortable box reaches the whole image");
    ImGui::SameLine();
    if (ImGui::Button("Centre the hand")) ++state.touch.centred;
    explain("Takes back what the clutch has shifted", state.keys, Action::centre_workspace);
    draw_device_rows(settings, "Inverse3 workspace");
}

/// Of all programs: dibhr shows it.
void draw_kept(const std::vector<inverse3::KeptSetting>& kept) {
    for (const inverse3::KeptSetting& one : kept) {
        quiet_text(capitalised(one.name) + ": " + one.words);
        explain(
            "As it was when the device came. The service keeps it for all programs; dibhr does not "
            "change it");
    }
}

}  // namespace

void draw_inverse3_state(ViewerState& state) {
    const Status& status = state.touch.inverse3->status;
    fact_row(status.minverse ? "Minverse" : "Inverse3", name_text(status));
    draw_sentence(status);
    if (!status.unguarded.empty()) trouble_text(capitalised(status.unguarded));
    if (!status.version.empty()) fact_row("Service", status.version);
    if (status.stage == Stage::ready) draw_exchange(*state.touch.inverse3);
    fact_row("Touches", touching_text(state.touch));
}

void draw_inverse3_settings(ViewerState& state) {
    Inverse3Settings& settings = state.settings.inverse3;
    if (part("Inverse3 workspace")) draw_workspace(state);
    if (part("Inverse3 buttons")) draw_device_rows(settings, "Inverse3 buttons");
    if (!part("Inverse3 service")) return;
    draw_kept(state.touch.inverse3->kept);
    draw_device_rows(settings, "Inverse3 service");
    quiet_text("These are used from the next start of the program.");
}

}  // namespace dibhr
