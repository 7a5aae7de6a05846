// What the depth's levels mean: who says so, and how a person says else.
#include <algorithm>
#include <array>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/sidecar.hpp"

namespace dibhr {

namespace {

constexpr const char* kRowsPopup = "Depth##rows";

/// A list that begins with what was found out; the first entry takes a person's word back.
template <typename Values, typename Value>
void word_row(const char* label, const char* help, const Values& values, const Known<Value>& known,
              const std::optional<Value>& panel, std::optional<Value> DepthStatement::*fact,
              ViewerState& state) {
    const std::string automatic =
        panel ? std::string("auto")
              : std::string(name_of(known.value)) + " (" + std::string(name_of(known.origin)) + ")";
    std::array<std::string, Values().size() + 1> names;
    std::array<const char*, Values().size() + 1> shown{};
    names[0] = automatic;
    int chosen = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        names[k + 1] = name_of(values[k]);
        if (panel == values[k]) chosen = static_cast<int>(k) + 1;
    }
    std::transform(names.begin(), names.end(), shown.begin(),
                   [](const std::string& name) { return name.c_str(); });
    if (!index_row(label, shown, chosen, help, 0)) return;
    DepthStatement said = state.opened.request.panel;
    said.*fact =
        chosen == 0 ? std::nullopt : std::optional(values[static_cast<std::size_t>(chosen) - 1]);
    state.requests.meaning = said;
}

/// A line to type into, which shows what is known while it is empty.
template <typename Fact, typename Read>
void typed_row(const char* id, const char* help, const std::string& known, const Read& read,
               std::optional<Fact> DepthStatement::*fact, std::span<char> text,
               ViewerState& state) {
    if (!text_field(id, known.c_str(), text, help)) return;
    DepthStatement said = state.opened.request.panel;
    const std::string typed = text.data();
    said.*fact = typed.empty() ? std::nullopt : read(typed);
    if (!typed.empty() && !(said.*fact)) {
        state.message = capitalised(in_quotes(typed) + " is not understood: " + help);
        return;
    }
    state.requests.meaning = said;
}

std::string with_origin(const std::string& text, Origin origin) {
    return text + " (" + std::string(name_of(origin)) + ")";
}

std::string levels_text(const std::vector<double>& levels) {
    std::string text;
    for (const double level : levels) text += (text.empty() ? "" : ",") + short_text(level);
    return text.empty() ? "none" : text;
}

bool has_assumed(const DepthMeaning& meaning) {
    return meaning.near.origin == Origin::assumed || meaning.unit.origin == Origin::assumed ||
           meaning.packing.origin == Origin::assumed || meaning.code.origin == Origin::assumed;
}

}  // namespace

void draw_depth_rows(ViewerState& state) {
    if (!state.media.meaning) {
        quiet_text("Levels as they are in the file (--raw-depth)");
        return;
    }
    ImGui::PushID("depth");
    const DepthMeaning& known = *state.media.meaning;
    const DepthStatement& panel = state.opened.request.panel;
    word_row("Near is", "Which levels are near (--near)", kNearLevels, known.near, panel.near,
             &DepthStatement::near, state);
    word_row("Unit", "What a level times its scale is (--depth-unit)", kDepthUnits, known.unit,
             panel.unit, &DepthStatement::unit, state);
    word_row("Packing", "Where colour and depth are, colour first (--packing)", kDepthPackings,
             known.packing, panel.packing, &DepthStatement::packing, state);
    word_row("Code", "How a picture holds depth (--depth-code)", kDepthCodes, known.code,
             panel.code, &DepthStatement::code, state);
    const DepthRange& range = known.range.value;
    typed_row("##range", "NEAR:FAR in that unit, as in 480:4210 (--depth-range)",
              with_origin("Range " + short_text(range.near, 4) + ":" + short_text(range.far, 4),
                          known.range.origin),
              range_in, &DepthStatement::range, state.fields.depth_range, state);
    typed_row("##none", "levels that mean nothing, as in 0,65535 (--no-data)",
              with_origin("No data " + levels_text(known.no_data.value), known.no_data.origin),
              levels_in, &DepthStatement::no_data, state.fields.no_data, state);
    if (ImGui::Button("Save as sidecar")) state.requests.save_sidecar = true;
    explain("Writes what the depth means beside its file, for whoever opens it next");
    ImGui::PopID();
}

void draw_depth_line(ViewerState& state) {
    if (!state.media.meaning) return;
    const DepthMeaning& meaning = *state.media.meaning;
    const std::string line =
        "Depth: " + in_words(meaning) + (has_assumed(meaning) ? " (assumed: click to change)" : "");
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(line.c_str());
    ImGui::PopStyleColor();
    explain("What the depth's levels mean; click to change it");
    if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    if (ImGui::IsItemClicked()) ImGui::OpenPopup(kRowsPopup);
    ImGui::SetNextWindowSize({ImGui::GetFontSize() * 24.0F, 0.0F});
    if (!ImGui::BeginPopup(kRowsPopup)) return;
    draw_depth_rows(state);
    ImGui::EndPopup();
}

}  // namespace dibhr
