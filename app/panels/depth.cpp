// The rows with the meaning of the depth's levels: its origin, and a person's own statement.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace {

constexpr const char* kRowsPopup = "Depth##rows";
constexpr double kMostShift_px = 10'000.0;
constexpr double kMostScale = 10.0;

/// Pushes the statement as a command, if it differs from the panel's current one.
void push_statement(const DepthStatement& statement, ViewerState& state) {
    if (!(statement == state.media.opened.request.panel)) state.commands.push(statement);
}

std::string with_origin(const std::string& text, Origin origin) {
    return text + " (" + std::string(name_of(origin)) + ")";
}

/// Whether the command line states it: then the panel's row is read-only.
template <typename Fact>
bool is_from_command_line(std::optional<Fact> DepthStatement::*fact, const ViewerState& state) {
    return (state.media.opened.request.command_line.*fact).has_value();
}

/// A drop-down list. Its first entry is the detected value, and withdraws a person's statement.
template <typename Values, typename Value>
void statement_row(const char* label, const char* help, const Values& values,
                   const Known<Value>& known, std::optional<Value> DepthStatement::*fact,
                   ViewerState& state) {
    const bool given = is_from_command_line(fact, state);
    const std::optional<Value>& panel = state.media.opened.request.panel.*fact;
    const bool is_stated = !given && panel.has_value();
    std::array<std::string, Values().size() + 1> names;
    std::array<const char*, Values().size() + 1> shown{};
    names[0] = is_stated ? "auto" : with_origin(std::string(name_of(known.value)), known.origin);
    int chosen = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        names[k + 1] = name_of(values[k]);
        if (is_stated && *panel == values[k]) chosen = static_cast<int>(k) + 1;
    }
    std::transform(names.begin(), names.end(), shown.begin(),
                   [](const std::string& name) { return name.c_str(); });
    ImGui::BeginDisabled(given);
    const bool changed = index_row(label, shown, chosen, help, 0);
    ImGui::EndDisabled();
    if (!changed) return;
    DepthStatement statement = state.media.opened.request.panel;
    statement.*fact =
        chosen == 0 ? std::nullopt : std::optional(values[static_cast<std::size_t>(chosen) - 1]);
    push_statement(statement, state);
}

/// Label, help and current value of a typed row.
struct TypedRow {
    const char* label;
    const char* help;
    std::string known;  ///< with its origin
};

/// A text input, which shows the known value while it is empty.
template <typename Fact, typename Read>
void typed_row(const TypedRow& row, const Read& read, std::optional<Fact> DepthStatement::*fact,
               std::span<char> text, ViewerState& state) {
    const std::string help = capitalised(row.help) + "\nNow: " + row.known;
    ImGui::BeginDisabled(is_from_command_line(fact, state));
    const bool done = text_row(row.label, row.known, text, help.c_str());
    ImGui::EndDisabled();
    if (!done) return;
    DepthStatement statement = state.media.opened.request.panel;
    const std::string typed = text.data();
    statement.*fact = typed.empty() ? std::nullopt : read(typed);
    if (!typed.empty() && !(statement.*fact)) {
        state.ui.message = capitalised(in_quotes(typed) + " is not understood: " + row.help);
        return;
    }
    push_statement(statement, state);
}

constexpr const char* kNone = "none";

std::optional<std::vector<double>> levels_or_none_in(const std::string& text) {
    return levels_in(text == kNone ? "" : text);
}

std::string text_of(const std::vector<double>& levels) {
    std::string text;
    for (const double level : levels) text += (text.empty() ? "" : ",") + number_text(level);
    return text.empty() ? kNone : text;
}

std::string text_of(const DepthRange& range) {
    constexpr int kDigits = 7;  // more than a person types: a range turned round was computed
    return short_text(range.near, kDigits) + ":" + short_text(range.far, kDigits);
}

std::string text_of(double number) {
    return number_text(number);
}

/// As much of the panel's statement as fits; empty if the command line states it.
template <typename Fact>
void fill_field(std::optional<Fact> DepthStatement::*fact, const ViewerState& state,
                std::span<char> field) {
    const std::optional<Fact>& panel = state.media.opened.request.panel.*fact;
    const std::string text = panel && !is_from_command_line(fact, state) ? text_of(*panel) : "";
    field[text.copy(field.data(), field.size() - 1)] = '\0';
}

std::string camera_text(const Known<std::optional<Intrinsics>>& camera) {
    if (!camera.value) return "not known";
    const Intrinsics& known = *camera.value;
    std::string text;
    for (const double number : {known.fx, known.fy, known.cx, known.cy})
        text += (text.empty() ? "" : ",") + short_text(number, 4);
    return with_origin(text, camera.origin);
}

/// Rows to drag the colour over the depth until they match.
void registration_rows(ViewerState& state) {
    TextFields& fields = state.ui.fields;
    auto& [right, down] = fields.colour_shift_px;
    auto& [scale] = fields.colour_size;
    const auto fact = &DepthStatement::registration;
    const bool changed = state.media.opened.request.panel.registration.has_value();
    ImGui::BeginDisabled(is_from_command_line(fact, state));
    const Dragged shift = dragged_row(
        {"Colour shift", "%.1f px", -kMostShift_px, kMostShift_px, 0.25F,
         "How far the colour lies to the right and down, in depth pixels (--registration)",
         changed},
        fields.colour_shift_px);
    const Dragged size = dragged_row(
        {"Colour size", "x %.3f", 1.0 / kMostScale, kMostScale, 0.002F,
         "How many times as large the colour is, about its middle (--registration)", changed},
        fields.colour_size);
    ImGui::EndDisabled();
    if (shift == Dragged::nothing && size == Dragged::nothing) return;
    DepthStatement statement = state.media.opened.request.panel;
    statement.registration.reset();
    if (shift != Dragged::restore && size != Dragged::restore)
        statement.registration = Registration{right, down, scale};
    push_statement(statement, state);
}

/// Rows with the times of the depth's frames.
void time_rows(ViewerState& state) {
    const DepthMeaning& known = *state.media.meaning;
    TextFields& fields = state.ui.fields;
    statement_row("Times",
                  "Of pictures without times. counted: 30 a second; own: by stamps in their names "
                  "or beside them; paired: with the frames of the other source (--depth-times)",
                  kDepthTimes, known.times, &DepthStatement::times, state);
    typed_row({"Offset", "seconds by which the depth is later than its times say (--depth-offset)",
               known.time_offset_s.value == 0.0
                   ? "0 s"
                   : with_origin(short_text(known.time_offset_s.value) + " s",
                                 known.time_offset_s.origin)},
              offset_in, &DepthStatement::time_offset_s, fields.depth_offset, state);
    const double rate = known.frames_per_s.value;
    typed_row({"Rate", "frames of depth a second (--depth-fps)",
               rate > 0.0 ? with_origin(short_text(rate) + "/s", known.frames_per_s.origin)
                          : short_text(state.media.frames_per_s, 4) + "/s"},
              rate_in, &DepthStatement::frames_per_s, fields.depth_rate, state);
}

bool has_assumed(const DepthMeaning& meaning) {
    return meaning.near.origin == Origin::assumed || meaning.unit.origin == Origin::assumed ||
           meaning.packing.origin == Origin::assumed || meaning.code.origin == Origin::assumed;
}

/// The longest text that fits into `room` [px].
std::string depth_line(const DepthMeaning& meaning, float room) {
    const bool relative =
        meaning.unit.value == DepthUnit::levels || meaning.unit.value == DepthUnit::disparity;
    const std::string whole =
        relative ? "Depth: nearer and farther, without a unit" : "Depth: " + in_words(meaning);
    std::vector<std::string> lines;
    if (has_assumed(meaning)) {
        lines = {whole + " (assumed: click to change)", whole + " (assumed)",
                 "Depth assumed: click to change"};
    } else {
        lines = {whole, "Depth: click to see what it means"};
    }
    const auto fits = [room](const std::string& line) {
        return ImGui::CalcTextSize(line.c_str()).x <= room;
    };
    const auto found = std::ranges::find_if(lines, fits);
    return found == lines.end() ? lines.back() : *found;
}

}  // namespace

void draw_depth_rows(ViewerState& state) {
    if (!state.media.meaning) {
        draw_dimmed("Levels as they are in the file (--raw-depth)");
        return;
    }
    ImGui::PushID("depth");
    ImGui::BeginDisabled(state.media.opening);  // with the last statement
    const DepthMeaning& known = *state.media.meaning;
    TextFields& fields = state.ui.fields;
    statement_row("Near is", "Which levels are near (--near)", kNearLevels, known.near,
                  &DepthStatement::near, state);
    statement_row("Unit", "Unit of a level times the scale (--depth-unit)", kDepthUnits, known.unit,
                  &DepthStatement::unit, state);
    typed_row({"Scale", "one level in that unit, as in 0.001 (--depth-scale)",
               with_origin(short_text(known.scale.value), known.scale.origin)},
              scale_in, &DepthStatement::scale, fields.depth_scale, state);
    const DepthRange& range = known.range.value;
    typed_row({"Range", "NEAR:FAR in that unit, as in 480:4210 (--depth-range)",
               with_origin(short_text(range.near, 5) + ":" + short_text(range.far, 5),
                           known.range.origin)},
              range_in, &DepthStatement::range, fields.depth_range, state);
    typed_row(
        {"No data", "levels that stand for missing data, such as 0,65535, or none (--no-data)",
         with_origin(text_of(known.no_data.value), known.no_data.origin)},
        levels_or_none_in, &DepthStatement::no_data, fields.no_data, state);
    statement_row("Packing", "How colour and depth lie in the picture, colour first (--packing)",
                  kDepthPackings, known.packing, &DepthStatement::packing, state);
    statement_row("Code", "How a picture holds depth (--depth-code)", kDepthCodes, known.code,
                  &DepthStatement::code, state);
    statement_row("Geometry",
                  "relief: the picture plane plus elevation; true: the shape in mm, which needs "
                  "distances and intrinsics (--geometry)",
                  kGeometries, known.geometry, &DepthStatement::geometry, state);
    typed_row({"Intrinsics",
               "FX,FY,CX,CY of the camera in depth pixels, or its horizontal field of view, as in "
               "60deg (--intrinsics)",
               camera_text(known.intrinsics)},
              intrinsics_in, &DepthStatement::intrinsics, fields.intrinsics, state);
    if (!state.media.colour_path.empty()) registration_rows(state);
    if (!state.media.still && !state.media.live) time_rows(state);
    if (item::button("Save as sidecar")) state.commands.push(SaveSidecar{});
    add_tooltip("Writes what the depth means beside its file, for whoever opens it next");
    ImGui::EndDisabled();
    ImGui::PopID();
}

void fill_depth_fields(ViewerState& state) {
    TextFields& fields = state.ui.fields;
    fill_field(&DepthStatement::scale, state, fields.depth_scale);
    fill_field(&DepthStatement::range, state, fields.depth_range);
    fill_field(&DepthStatement::no_data, state, fields.no_data);
    fill_field(&DepthStatement::intrinsics, state, fields.intrinsics);
    fill_field(&DepthStatement::time_offset_s, state, fields.depth_offset);
    fill_field(&DepthStatement::frames_per_s, state, fields.depth_rate);
    const Registration registration =
        state.media.meaning ? state.media.meaning->registration.value : Registration{};
    fields.colour_shift_px = {registration.right_px, registration.down_px};
    fields.colour_size = {registration.scale};
}

void draw_depth_line(ViewerState& state) {
    if (!state.media.meaning) return;
    const std::string line = depth_line(*state.media.meaning, ImGui::GetContentRegionAvail().x);
    const ImVec2 begin = ImGui::GetCursorPos();
    if (item::invisible_button("depth line", ImGui::CalcTextSize(line.c_str()), line)) {
        fill_depth_fields(state);  // without what was refused
        ImGui::OpenPopup(kRowsPopup);
    }
    add_tooltip((in_words(*state.media.meaning) + "; click to change what the depth's levels mean")
                    .c_str());
    if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    ImGui::SetCursorPos(begin);
    ImGui::TextDisabled("%s", line.c_str());
    ImGui::SetNextWindowSize({ImGui::GetFontSize() * 24.0F, 0.0F});
    if (!ImGui::BeginPopup(kRowsPopup)) return;
    draw_depth_rows(state);
    ImGui::EndPopup();
}

}  // namespace dibhr
