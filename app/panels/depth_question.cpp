// Which meaning of the depth is right? A small relief of each, to choose from.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr float kWidestRelief_em = 22.0F;
constexpr float kNarrowestRelief_em = 12.0F;
constexpr float kReliefShape = 0.75F;           // height over width
constexpr float kShareOfWindow = 0.94F;         // of the relief's part of it
constexpr float kLeastBesidePanels_em = 30.0F;  // else it lies over them, too

bool has_distances(const DepthAlternative& alternative) {
    return is_distance(alternative.statement.unit.value_or(DepthUnit::levels));
}

/// One level in millimetres.
double level_mm(const DepthStatement& statement) {
    return statement.scale.value_or(1.0) * one_in_mm(*statement.unit);
}

bool is_about(double value, double wanted) {
    return std::abs(value - wanted) < 1e-6 * wanted;
}

/// "Millimetres", or what one step of the levels is.
std::string unit_text(const DepthStatement& statement) {
    const double mm = level_mm(statement);
    if (is_about(mm, 1.0)) return "Millimetres";
    if (is_about(mm, 10.0)) return "Centimetres";
    if (is_about(mm, 1000.0)) return "Metres";
    return "Steps of " + short_text(mm, 3) + " mm";
}

/// With two digits, or more before the point.
std::string two_digits(double value) {
    constexpr double kTwoDigits = 10.0;
    return value < kTwoDigits ? short_text(value, 2) : number_text(value, 0);
}

/// "0.4 to 3.1 m".
std::string distance_text(const DepthAlternative& alternative) {
    const double unit_mm = one_in_mm(*alternative.statement.unit);
    const double near_mm = alternative.range.near * unit_mm;
    const double far_mm = alternative.range.far * unit_mm;
    constexpr double kLeastInMetres_mm = 100.0;
    if (far_mm < kLeastInMetres_mm)
        return two_digits(near_mm) + " to " + two_digits(far_mm) + " mm";
    const double metre_mm = one_in_mm(DepthUnit::m);
    return two_digits(near_mm / metre_mm) + " to " + two_digits(far_mm / metre_mm) + " m";
}

/// Whether some, but not all of the alternatives are so.
template <typename Is>
bool tells_apart(const std::vector<DepthAlternative>& all, const Is& is) {
    const auto count = std::count_if(all.begin(), all.end(), is);
    return count > 0 && count < static_cast<std::ptrdiff_t>(all.size());
}

/// Whether they differ in size alone.
bool have_one_shape(const std::vector<DepthAlternative>& all) {
    return std::all_of(all.begin(), all.end(), [&all](const DepthAlternative& one) {
        return one.statement.near == all.front().statement.near &&
               one.statement.unit != DepthUnit::disparity;
    });
}

std::string question_text(const ViewerState& state, const DepthQuestion& question) {
    const std::string name = one_line(shown(state.media.depth_path.filename()), 40);
    if (!question.doubt.empty())
        return name + " may be no depth: " + question.doubt +
               ". If it is depth: which is right? Else close it, and open the file of the depth.";
    if (have_one_shape(question.alternatives))
        return name + " does not say its unit. The shape is the same in all: how far away is it?";
    return name +
           " does not say what its depth means. Read the wrong way, it is inside out, bent or of "
           "another size.";
}

/// Where a relief and its label are.
struct Cell {
    ImVec2 relief{};
    float label{0.0F};  ///< height [px]

    [[nodiscard]] ImVec2 size() const { return {relief.x, relief.y + label}; }
};

/// How the cells fit into the window.
struct CellGrid {
    int columns{1};
    Cell cell{};
    float width{0.0F};  ///< of the card's inside
};

CellGrid grid_for(int cells, int lines_of_label, ImVec2 room) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float em = ImGui::GetFontSize();
    const float label = static_cast<float>(lines_of_label) * ImGui::GetTextLineHeight() +
                        4.0F * style.FramePadding.y;
    const float gap = style.ItemSpacing.x;
    const float room_x = kShareOfWindow * room.x - 2.0F * style.WindowPadding.x;
    // Besides the cells: title, two lines of text, the buttons.
    const float room_y = kShareOfWindow * room.y - 2.0F * style.WindowPadding.y -
                         7.0F * ImGui::GetTextLineHeightWithSpacing();
    const auto relief_width = [&](int columns) {
        const int rows = (cells + columns - 1) / columns;
        const float across =
            (room_x - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
        const float down =
            (room_y / static_cast<float>(rows) - label - style.ItemSpacing.y) / kReliefShape;
        return std::min(across, down);
    };
    CellGrid grid{.columns = cells};
    if (relief_width(cells) < kNarrowestRelief_em * em && relief_width(2) > relief_width(cells))
        grid.columns = 2;
    const float wide = std::clamp(relief_width(grid.columns), 4.0F * em, kWidestRelief_em * em);
    grid.cell = {{std::floor(wide), std::floor(kReliefShape * wide)}, label};
    grid.width = static_cast<float>(grid.columns) * (grid.cell.relief.x + gap) - gap;
    return grid;
}

/// The number of its key, on a ground at the upper left of its relief.
void draw_number(ImDrawList& list, ImVec2 low, std::size_t which) {
    const std::string text = std::to_string(which + 1) + (which == 0 ? "  likeliest" : "");
    const float margin = 0.4F * ImGui::GetFontSize();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 at{low.x + margin, low.y + margin};
    list.AddRectFilled(at, {at.x + size.x + 2.0F * margin, at.y + size.y + 1.2F * margin},
                       ImGui::GetColorU32(ImGuiCol_PopupBg), 5.0F);
    list.AddText({at.x + margin, at.y + 0.6F * margin}, ImGui::GetColorU32(ImGuiCol_Text),
                 text.c_str());
}

/// Breaks a label after its first comma. Returns the number of its lines.
int break_label(std::string& label) {
    const std::size_t comma = label.find(", ");
    if (comma == std::string::npos) return 1;
    label.replace(comma, 2, "\n");
    return 2;
}

/// One answer: its relief, number and label; true if it was clicked.
bool draw_answer(const DepthQuestion& question, std::size_t which, const std::string& label,
                 const Cell& cell) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size = cell.size();
    ImGui::PushID(static_cast<int>(which));
    const bool clicked = item::invisible_button("answer", size, label);
    ImGui::PopID();
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 high{low.x + size.x, low.y + size.y};
    const ImVec2 corner{low.x + cell.relief.x, low.y + cell.relief.y};
    const float round = ImGui::GetStyle().FrameRounding;
    list.AddRectFilled(
        low, high, ImGui::GetColorU32(hovered ? ImGuiCol_ButtonHovered : ImGuiCol_FrameBg), round);
    if (which < question.reliefs.size())  // rows of pictures begin at the top
        list.AddImage(texture_id<ImTextureID>(question.reliefs[which]), low, corner);
    draw_number(list, low, which);
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    list.PushClipRect(low, high, true);
    list.AddText({low.x + pad.x, corner.y + 2.0F * pad.y}, ImGui::GetColorU32(ImGuiCol_Text),
                 label.c_str());
    list.PopClipRect();
    if (hovered)
        list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_SliderGrab), round, 0,
                     std::max(2.0F, 0.12F * ImGui::GetFontSize()));
    return clicked;
}

void draw_foot(ViewerState& state, DepthQuestion& question) {
    const std::string not_sure =
        "Not sure: go on with 1" + state.keys.in_brackets(Action::close_topmost);
    if (!question.folder.empty()) {
        const std::string other =
            "Also for the other files in " + one_line(question.folder, 24) + " (key 0)###folder";
        item::checkbox(other.c_str(), &question.for_folder);
        add_tooltip("Files of this folder that leave the same open are not asked about again");
        ImGui::SameLine();
    }
    const float room = ImGui::GetContentRegionAvail().x;
    const float width = button_width(not_sure.c_str());
    if (room < width) {
        ImGui::NewLine();
    } else {
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
    }
    if (item::button(not_sure.c_str())) state.commands.push(AnswerDepth{});
}

}  // namespace

std::vector<std::string> labels_of(const std::vector<DepthAlternative>& alternatives) {
    const auto is_of = [](DepthUnit unit) {
        return [unit](const DepthAlternative& one) { return one.statement.unit == unit; };
    };
    const bool are_some_distances = tells_apart(alternatives, has_distances);
    const bool has_disparity = tells_apart(alternatives, is_of(DepthUnit::disparity));
    std::vector<std::string> labels;
    for (const DepthAlternative& one : alternatives) {
        if (has_distances(one)) {
            labels.push_back(unit_text(one.statement) + ", " + distance_text(one));
            continue;
        }
        std::string label = "Near is " + std::string(name_of(*one.statement.near));
        if (one.statement.unit == DepthUnit::disparity) {
            label += ", as 1 / distance";
        } else if (are_some_distances) {
            label += ", size not known";
        } else if (has_disparity) {
            label += ", in equal steps";
        }
        labels.push_back(label);
    }
    return labels;
}

void draw_depth_question(ViewerState& state) {
    if (!asks_depth(state.ui)) return;
    DepthQuestion& question = *state.ui.depth_question;
    std::vector<std::string> labels = labels_of(question.alternatives);
    int lines = 1;
    for (std::string& label : labels) lines = std::max(lines, break_label(label));
    const ImGuiStyle& style = ImGui::GetStyle();
    ImVec2 room = ImGui::GetIO().DisplaySize;
    const float beside = room.x - panel_column_width(state);
    if (beside > kLeastBesidePanels_em * ImGui::GetFontSize()) room.x = beside;
    const CellGrid grid = grid_for(static_cast<int>(labels.size()), lines, room);
    ImGui::SetNextWindowPos({0.5F * room.x, 0.5F * room.y}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({grid.width + 2.0F * style.WindowPadding.x, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, std::max(1.0F, state.ui.scale));
    ImGui::Begin("Which is right?", nullptr, kTitledWindow);
    ImGui::TextWrapped("%s", question_text(state, question).c_str());
    ImGui::Spacing();
    for (std::size_t k = 0; k < labels.size(); ++k) {
        if (k % static_cast<std::size_t>(grid.columns) != 0) ImGui::SameLine();
        if (draw_answer(question, k, labels[k], grid.cell)) state.commands.push(AnswerDepth{k});
    }
    ImGui::Spacing();
    draw_foot(state, question);
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace dibhr
