// The help sheet: all keys, the mouse, and the marks.
#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/keys.hpp"

namespace dibhr {

namespace {

struct HelpRow {
    const char* what;
    const char* help;
};

constexpr HelpRow kMarkRows[] = {
    {"Orange ring", "The goal: where the hand is"},
    {"Blue ball", "The proxy: stays on the surface"},
    {"Pale ball", "In a replay: the proxy as recorded"},
    {"Smaller balls", "Side by side: the other algorithms' proxies"},
    {"Line between", "The spring that pulls the hand"},
    {"Blue ring, dashed line", "The proxy is catching up with a jump"},
    {"Yellow arrow", "The force on the hand"},
    {"Yellow ring", "The force, as a share of the most that may be sent"},
    {"Light dots", "Where you have touched in the last seconds"},
    {"Green rod", "The surface's normal"},
    {"Pale cone", "The friction cone: a proxy inside it sticks"},
};

constexpr HelpRow kMouseRows[] = {
    {"Move", "The hand hovers over the surface"},
    {"Hold left", "Press in, deeper for the first second"},
    {"Hold left + wheel", "Deeper still, less deep"},
    {"Drag right", "Turn the view"},
    {"Drag middle, Shift + right", "Shift the view"},
    {"Wheel", "Nearer, farther"},
};

/// A group of rows on the help sheet.
struct SheetGroup {
    std::string title{};
    std::vector<std::pair<std::string, std::string>> rows{};

    /// Including the heading.
    [[nodiscard]] std::size_t lines() const { return rows.size() + 1; }
};

SheetGroup group_of(const char* title, std::span<const HelpRow> explained) {
    SheetGroup group{title};
    for (const HelpRow& one : explained) group.rows.emplace_back(one.what, one.help);
    return group;
}

std::vector<SheetGroup> sheet_of(const KeyTable& keys) {
    std::vector<SheetGroup> groups{group_of("Mouse", kMouseRows)};
    for (const KeyJob& job : key_jobs()) {
        if (groups.back().title != job.group) groups.push_back({std::string(job.group)});
        groups.back().rows.emplace_back(keys.names_for(job.action), job.help);
    }
    groups.push_back(group_of("Marks", kMarkRows));
    return groups;
}

/// The number of groups in the left column, so that the higher column is as low as possible.
std::size_t groups_at_left(std::span<const SheetGroup> groups) {
    const auto lines = [](std::span<const SheetGroup> some) {
        std::size_t sum = 0;
        for (const SheetGroup& group : some) sum += group.lines();
        return sum;
    };
    std::size_t best = 0;
    std::size_t lowest = lines(groups);
    for (std::size_t k = 1; k < groups.size(); ++k) {
        const std::size_t height = std::max(lines(groups.first(k)), lines(groups.subspan(k)));
        if (height < lowest) best = k;
        lowest = std::min(lowest, height);
    }
    return best;
}

/// Widths of a column of the sheet [px].
struct SheetWidths {
    float keys{0.0F}, help{0.0F}, gap{0.0F};

    [[nodiscard]] float column() const { return keys + gap + help; }
};

SheetWidths widths_of(std::span<const SheetGroup> groups) {
    SheetWidths widths{.gap = ImGui::GetFontSize()};
    for (const SheetGroup& group : groups) {
        for (const auto& [what, help] : group.rows) {
            widths.keys = std::max(widths.keys, ImGui::CalcTextSize(what.c_str()).x);
            widths.help = std::max(widths.help, ImGui::CalcTextSize(help.c_str()).x);
        }
    }
    return widths;
}

/// Text wrapped at `width`. Returns its height.
float sheet_text(const std::string& text, ImVec2 place, float width) {
    ImGui::SetCursorPos(place);
    ImGui::PushTextWrapPos(place.x + width);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    return ImGui::GetItemRectSize().y;
}

/// One group below the other.
void draw_sheet_column(const ViewerState& state, std::span<const SheetGroup> groups,
                       const SheetWidths& widths, ImVec2 place) {
    const float between = 0.25F * ImGui::GetFontSize();
    const ImVec4 quiet = ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
    for (const SheetGroup& group : groups) {
        ImGui::PushFont(state.ui.fonts.heading);
        place.y += sheet_text(group.title, place, widths.column()) + between;
        ImGui::PopFont();
        for (const auto& [what, help] : group.rows) {
            const float keys = sheet_text(what, place, widths.keys);
            ImGui::PushStyleColor(ImGuiCol_Text, quiet);
            const float said =
                sheet_text(help, {place.x + widths.keys + widths.gap, place.y}, widths.help);
            ImGui::PopStyleColor();
            place.y += std::max(keys, said) + between;
        }
        place.y += 2.0F * between;
    }
}

}  // namespace

void draw_help_sheet(ViewerState& state) {
    if (!state.ui.help_open) return;
    const ImGuiStyle& style = ImGui::GetStyle();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const std::vector<SheetGroup> sheet = sheet_of(state.keys);
    const std::span<const SheetGroup> groups(sheet);
    SheetWidths widths = widths_of(groups);
    const float around = 2.0F * style.WindowPadding.x + style.ScrollbarSize;
    const float room = display.x - around - style.WindowPadding.x;
    const float between = 2.0F * widths.gap;
    const bool beside = 2.0F * widths.column() + between <= room;
    if (widths.column() > room) {
        widths.keys = std::min(widths.keys, 0.4F * room);
        widths.help = room - widths.keys - widths.gap;
    }
    const std::size_t left = beside ? groups_at_left(groups) : groups.size();
    const float wide = widths.column() + (beside ? between + widths.column() : 0.0F);
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.5F}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({wide + around, 0.0F});
    ImGui::Begin("Keys and mouse", &state.ui.help_open, kTitledWindow);
    const ImVec2 begin = ImGui::GetCursorPos();
    draw_sheet_column(state, groups.first(left), widths, begin);
    const ImVec2 second{begin.x + widths.column() + between, begin.y};
    draw_sheet_column(state, groups.subspan(left), widths, second);
    ImGui::End();
}

}  // namespace dibhr
