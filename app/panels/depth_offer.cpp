// A video of colour alone: the button that makes depth for it, and the progress.
#include <algorithm>
#include <string>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/estimators.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

void push_command(ViewerState& state, DepthOfferCommand command) {
    state.commands.push(command);
}

/// Each line is reserved from the start, so that the button stays under the pointer.
void draw_estimate_progress(ViewerState& state, const DepthOffer& offer) {
    const EstimateProgress& now = *offer.progress;
    const bool measured = now.step != EstimateStep::estimating || now.counted;
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImGui::GetColorU32(ImGuiCol_SliderGrab));
    ImGui::ProgressBar(measured ? static_cast<float>(now.share()) : 0.0F, {-1.0F, 0.0F},
                       measured ? formatted("%.0f %%", 100.0 * now.share()).c_str() : "");
    ImGui::PopStyleColor();
    ImGui::TextUnformatted(offer.ending ? "Ending" : capitalised(in_words(now)).c_str());
    ImGui::TextDisabled("%s", one_line(now.said, 70).c_str());
    ImGui::Spacing();
    ImGui::BeginDisabled(offer.ending);
    if (item::button("Cancel")) push_command(state, DepthOfferCommand::cancel);
    ImGui::EndDisabled();
}

void draw_choice(DepthOffer& offer) {
    if (offer.estimators.size() < 2) return;
    std::vector<const char*> names;
    names.reserve(offer.estimators.size());
    for (const std::string& name : offer.estimators) names.push_back(name.c_str());
    index_row("Estimator", names, offer.chosen, "As the settings name them, in [estimators]", 0);
}

/// Shows the whole command. A person can agree only after scrolling to its end.
void draw_command_consent(ViewerState& state, const DepthOffer& offer) {
    ImGui::TextWrapped(
        "The settings name this command. Nobody on this machine has agreed to run it yet. It can "
        "do everything that you can do:");
    constexpr float kMostLines = 12.0F;
    const float width = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize;
    const float high =
        ImGui::CalcTextSize(offer.unconfirmed_command.c_str(), nullptr, false, width).y;
    const float line = ImGui::GetTextLineHeight();
    ImGui::BeginChild("command", {0.0F, std::min(high + line, kMostLines * line)});
    ImGui::PushTextWrapPos(width);
    ImGui::TextUnformatted(offer.unconfirmed_command.c_str());
    ImGui::PopTextWrapPos();
    const bool read = ImGui::GetScrollY() >= ImGui::GetScrollMaxY();
    ImGui::EndChild();
    ImGui::BeginDisabled(!read);
    if (item::button("Run it, now and later")) push_command(state, DepthOfferCommand::agree);
    ImGui::EndDisabled();
    ImGui::SameLine();
}

void draw_make_button(ViewerState& state, DepthOffer& offer) {
    if (offer.estimators.empty()) {
        draw_dimmed(estimator_hint() + ".");
        return;
    }
    draw_choice(offer);
    const std::string& name = offer.estimators[static_cast<std::size_t>(offer.chosen)];
    if (item::button(("Make depth with " + name + "###make").c_str()))
        push_command(state, DepthOfferCommand::make);
    ImGui::SameLine();
}

}  // namespace

void draw_depth_offer(ViewerState& state) {
    UiState& ui = state.ui;
    if (!ui.depth_offer || ui.dialog.shown || !ui.message.empty() || !ui.unsafe_settings.empty())
        return;
    DepthOffer& offer = *ui.depth_offer;
    const char* const what = offer.progress        ? "Making depth: "
                             : offer.depth.empty() ? "Colour alone: "
                                                   : "Depth is made: ";
    const std::string title =
        what + one_line(offer.colour.filename().string(), 40) + "###depth offer";
    begin_card(state, title.c_str(), 30.0F);
    if (offer.progress) {
        draw_estimate_progress(state, offer);
        ImGui::End();
        return;
    }
    if (!offer.text.empty()) ImGui::TextWrapped("%s", capitalised(offer.text).c_str());
    ImGui::Spacing();
    if (!offer.depth.empty()) {
        if (item::button("Open it")) push_command(state, DepthOfferCommand::open);
        ImGui::SameLine();
    } else if (!offer.unconfirmed_command.empty()) {
        draw_command_consent(state, offer);
    } else {
        draw_make_button(state, offer);
    }
    if (item::button(("Close" + state.keys.in_brackets(Action::close_topmost)).c_str()))
        push_command(state, DepthOfferCommand::close);
    ImGui::End();
}

}  // namespace dibhr
