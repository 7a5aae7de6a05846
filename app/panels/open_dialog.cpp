// The Open dialog: a folder's recordings, a text line that filters them or takes a path, and a
// preview of the chosen one.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/folder.hpp"
#include "app/settings/recent_files.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr float kWidest_em = 72.0F;
constexpr float kHighest_em = 36.0F;
constexpr float kPreview_em = 17.0F;
constexpr float kPlaces_em = 10.0F;

std::string size_text(const FolderEntry& entry) {
    if (entry.kind == FileKind::folder) {
        return !entry.recording ? "" : entry.folders > 0 ? "Recording +" : "Recording";
    }
    constexpr double kStep = 1000.0;
    constexpr const char* kUnits[] = {"B", "kB", "MB", "GB", "TB"};
    auto size = static_cast<double>(entry.bytes);
    std::size_t unit = 0;
    for (; size >= kStep && unit + 1 < std::size(kUnits); ++unit) size /= kStep;
    return formatted(size < 10.0 && unit > 0 ? "%.1f %s" : "%.0f %s", size, kUnits[unit]);
}

std::string time_text(const FolderEntry& entry) {
    if (entry.changed == fs::file_time_type{}) return {};
    const auto time = std::chrono::file_clock::to_sys(entry.changed);
    const std::time_t seconds = std::chrono::system_clock::to_time_t(
        std::chrono::time_point_cast<std::chrono::system_clock::duration>(time));
    std::tm local{};
    localtime_r(&seconds, &local);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
    return text;
}

void go_to(ViewerState& state, const fs::path& folder) {
    state.commands.push(ReadFolder{folder});
}

void open(ViewerState& state, const FolderEntry& entry) {
    if (is_only_folder(entry)) return go_to(state, entry.file);
    state.commands.push(request_for(entry));
    state.ui.dialog.shown = false;
}

bool is_path(const std::string& typed) {
    return typed.find('/') != std::string::npos || typed.starts_with('~');
}

/// Filters the rows by the typed text, unless it is a path. Only if an input has changed.
void list_rows(OpenDialog& dialog) {
    const std::string typed = dialog.typed.data();
    OpenDialog::Rows& rows = dialog.rows;
    if (rows.reading_number == dialog.reading_number && rows.typed == typed &&
        rows.all_files == dialog.all_files)
        return;
    rows = {{}, typed, dialog.all_files, dialog.reading_number};
    const std::string wanted = is_path(typed) ? std::string{} : lower_case(typed);
    const std::vector<FolderEntry>& entries = dialog.folder.entries;
    rows.entries.reserve(entries.size());
    for (std::size_t k = 0; k < entries.size(); ++k) {
        if (!dialog.all_files && !can_be_opened(entries[k])) continue;
        if (lower_case(entries[k].name()).find(wanted) != std::string::npos)
            rows.entries.push_back(k);
    }
}

/// The chosen row; nothing: the chosen file is not listed.
std::optional<std::size_t> chosen_row(const OpenDialog& dialog) {
    const std::vector<std::size_t>& rows = dialog.rows.entries;
    const auto found = std::find_if(rows.begin(), rows.end(), [&](std::size_t entry) {
        return dialog.folder.entries[entry].file == dialog.chosen;
    });
    if (found == rows.end()) return std::nullopt;
    return static_cast<std::size_t>(found - rows.begin());
}

const FolderEntry& entry_in(const OpenDialog& dialog, std::size_t row) {
    return dialog.folder.entries[dialog.rows.entries[row]];
}

const FolderEntry* chosen_of(const OpenDialog& dialog) {
    const auto row = chosen_row(dialog);
    return row ? &entry_in(dialog, *row) : nullptr;
}

/// Opens the typed path, or the chosen row, else the first one that matches the typed text.
void enter(ViewerState& state) {
    OpenDialog& dialog = state.ui.dialog;
    const std::string typed = dialog.typed.data();
    const FolderEntry* chosen = chosen_of(dialog);
    if (typed.empty()) {
        if (chosen != nullptr) open(state, *chosen);
        return;
    }
    if (chosen == nullptr && !dialog.rows.entries.empty()) chosen = &entry_in(dialog, 0);
    TypedFile file{typed, {}};
    if (chosen != nullptr && !is_path(typed)) file.chosen = *chosen;
    state.commands.push(file);
}

/// Inserts the completion when it is known, unless the text has changed.
int complete(ImGuiInputTextCallbackData* data) {
    ViewerState& state = *static_cast<ViewerState*>(data->UserData);
    const std::string typed(data->Buf, static_cast<std::size_t>(data->BufTextLen));
    const Completion done = std::exchange(state.ui.dialog.completion, {});
    const bool fits = static_cast<int>(done.whole.size()) < data->BufSize;
    if (done.typed != typed || done.whole == typed || !fits) return 0;
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, done.whole.c_str());
    return 0;
}

/// The parts of the folder's path, each a button.
void draw_path(ViewerState& state) {
    const fs::path& path = state.ui.dialog.folder.path;
    fs::path part;
    std::vector<fs::path> parts;
    for (const fs::path& name : path) parts.push_back(part /= name);
    const float room = ImGui::GetContentRegionAvail().x;
    const auto name_of_part = [](const fs::path& p) {
        return p.has_filename() ? p.filename().string() : p.string();
    };
    float width = 0.0F;  // the last parts matter most
    std::size_t first = parts.size();
    const float around = 2.0F * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x;
    while (first > 0) {
        width += ImGui::CalcTextSize(name_of_part(parts[first - 1]).c_str()).x + around;
        if (width > room && first < parts.size()) break;
        --first;
    }
    for (std::size_t k = first; k < parts.size(); ++k) {
        if (k > first) ImGui::SameLine();
        ImGui::PushID(static_cast<int>(k));
        if (name_button(name_of_part(parts[k]))) go_to(state, parts[k]);
        ImGui::PopID();
    }
}

void draw_line(ViewerState& state) {
    OpenDialog& dialog = state.ui.dialog;
    if (dialog.pictures_to_focus > 0) {
        ImGui::SetWindowFocus();
        ImGui::SetKeyboardFocusHere();
        --dialog.pictures_to_focus;
    }
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::PushID(dialog.line);
    ImGui::InputTextWithHint("##typed", "Type to narrow the list, or a path (Tab completes it)",
                             dialog.typed.data(), dialog.typed.size(),
                             ImGuiInputTextFlags_CallbackAlways, complete, &state);
    item::reach(
        ItemKeys::line,
        [&] {
            return ItemWords{"Name or path", "text", dialog.typed.data()};
        },
        true);
    if (ImGui::IsItemActive()) dialog.pictures_to_focus = 0;
    ImGui::PopID();
    if (!dialog.refused.empty() && dialog.refused == dialog.typed.data())
        draw_warning("There is no such file or folder: check what is typed");
}

void move_choice(OpenDialog& dialog) {
    const int by = std::exchange(dialog.move, 0);
    const int last = static_cast<int>(dialog.rows.entries.size()) - 1;
    if (by == 0 || last < 0) return;
    const auto chosen = chosen_row(dialog);
    const int next = chosen   ? std::clamp(static_cast<int>(*chosen) + by, 0, last)
                     : by > 0 ? 0
                              : last;
    dialog.chosen = entry_in(dialog, static_cast<std::size_t>(next)).file;
    dialog.scroll_pending = true;
}

void draw_row(ViewerState& state, const FolderEntry& entry, bool wide) {
    OpenDialog& dialog = state.ui.dialog;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(entry.file.c_str());
    if (name_selectable(entry.name(), entry.file == dialog.chosen,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick,
                        false)) {
        dialog.chosen = entry.file;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) open(state, entry);
    }
    ImGui::PopID();
    if (!wide) return;
    ImGui::TableNextColumn();
    if (entry.recording)
        ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s",
                           size_text(entry).c_str());
    else
        ImGui::TextDisabled("%s", size_text(entry).c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", time_text(entry).c_str());
}

/// The rows are one item for the keyboard.
void take_list_keys(OpenDialog& dialog) {
    const bool has_keyboard = item::reach(ItemKeys::list, [&dialog] {
        const FolderEntry* const chosen = chosen_of(dialog);
        return ItemWords{"Files", "list", chosen != nullptr ? chosen->name() : "none chosen"};
    });
    if (!has_keyboard) return;
    dialog.move += item::steps().down;
    dialog.enter = dialog.enter || item::steps().enter;
}

/// Scrolls the chosen row to the middle, after a choice by keys.
void scroll_to_chosen(OpenDialog& dialog, float height) {
    const auto row = chosen_row(dialog);
    if (!row || !std::exchange(dialog.scroll_pending, false)) return;
    const float each = ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().CellPadding.y;
    ImGui::SetScrollY(each * (static_cast<float>(*row) + 1.5F) - 0.5F * height);
}

void draw_rows(ViewerState& state, ImVec2 size) {
    constexpr ImGuiTableFlags kTable =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
    const float em = ImGui::GetFontSize();
    const bool wide = size.x > 26.0F * em;
    if (!ImGui::BeginTable("rows", wide ? 3 : 1, kTable, size)) return;
    // With a fixed weight: the names' own width would leave no room for the other columns.
    ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch, 1.0F);
    if (wide) {
        ImGui::TableSetupColumn("Size", ImGuiTableColumnFlags_WidthFixed, 5.8F * em);
        ImGui::TableSetupColumn("Changed", ImGuiTableColumnFlags_WidthFixed, 9.0F * em);
    }
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    scroll_to_chosen(state.ui.dialog, size.y);
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_SliderGrab));
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(state.ui.dialog.rows.entries.size()));
    while (clipper.Step()) {
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
            draw_row(state, entry_in(state.ui.dialog, static_cast<std::size_t>(row)), wide);
    }
    ImGui::PopStyleColor();
    if (state.ui.dialog.rows.entries.empty()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        draw_dimmed(state.ui.dialog.typed.front() == '\0' ? "Nothing here can be opened"
                                                          : "No name here contains that");
    }
    ImGui::EndTable();
    take_list_keys(state.ui.dialog);
}

void draw_places(ViewerState& state, ImVec2 size) {
    ImGui::BeginChild("places", size);
    const auto place = [&state](const std::string& label, const fs::path& folder) {
        ImGui::PushID(folder.c_str());
        if (name_selectable(label, folder == state.ui.dialog.folder.path)) go_to(state, folder);
        ImGui::PopID();
        add_tooltip(folder.c_str());
    };
    place("Home", expand_home("~"));
    std::error_code unknown;
    place("Current folder", fs::current_path(unknown));
    if (!state.ui.dialog.sample_folder.empty()) place("Sample", state.ui.dialog.sample_folder);
    ImGui::Spacing();
    if (!state.media.recent.empty()) ImGui::TextDisabled("Recent");
    std::vector<fs::path> listed;
    for (const RecentFile& file : state.media.recent) {
        const fs::path folder = file.colour.parent_path();
        if (std::find(listed.begin(), listed.end(), folder) != listed.end()) continue;
        listed.push_back(folder);
        place(folder.filename().string() + "/", folder);
    }
    ImGui::EndChild();
}

/// A picture as wide as there is room, and not higher than `highest` [px].
void draw_picture(std::uintptr_t texture, int columns, int rows, float highest) {
    if (texture == 0 || columns < 1 || rows < 1) return;
    const float aspect = static_cast<float>(columns) / static_cast<float>(rows);
    const float width = std::min(ImGui::GetContentRegionAvail().x, highest * aspect);
    ImGui::Image(texture_id<ImTextureID>(texture), {width, width / aspect});
}

std::string words_for(const FolderEntry& entry) {
    if (entry.recording && entry.folders > 0)
        return "A folder that is a recording, and holds " + std::to_string(entry.folders) +
               (entry.folders > 1 ? " folders" : " folder") + " more: look inside";
    if (entry.recording) return "A folder that is a recording";
    return entry.depth.empty() ? name_of(entry.kind) : "Colour and depth";
}

/// Name, length and size of the chosen entry, and below them its first picture and depth.
void draw_preview(const ViewerState& state, const FolderEntry* chosen, ImVec2 size) {
    ImGui::BeginChild("preview", size);
    if (chosen != nullptr) {
        const Preview& preview = state.ui.dialog.preview;
        ImGui::TextWrapped("%s", chosen->name().c_str());
        draw_dimmed(capitalised(words_for(*chosen)));
        const bool is_known = preview.file == chosen->file;
        if (is_known && !preview.text.empty()) draw_dimmed(preview.text);
        ImGui::Spacing();
        const float highest = 0.5F * (size.y - ImGui::GetCursorPosY()) - ImGui::GetFontSize();
        if (is_known) {
            draw_picture(preview.colour, preview.columns, preview.rows, highest);
            draw_picture(preview.depth, preview.depth_columns, preview.depth_rows, highest);
        }
    } else {
        draw_dimmed("Choose a recording. Its colour and its depth are one row.");
    }
    ImGui::EndChild();
}

void draw_buttons(ViewerState& state, const FolderEntry* chosen) {
    OpenDialog& dialog = state.ui.dialog;
    item::checkbox("All files", &dialog.all_files);
    constexpr float kAllInARow_em = 46.0F;  // if narrower, the box is only in Video, Recent
    if (ImGui::GetContentRegionAvail().x > kAllInARow_em * ImGui::GetFontSize()) {
        ImGui::SameLine();
        desktop_dialog_box(state.settings.open_with);
    }
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const bool looks_inside = chosen != nullptr && chosen->recording;
    const float buttons = looks_inside ? 3.0F : 2.0F;
    ImGui::SameLine();
    const float room = ImGui::GetContentRegionAvail().x - (buttons - 1.0F) * gap;
    const float width = std::clamp(room / buttons, 1.0F, 6.5F * ImGui::GetFontSize());
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - buttons * width);
    if (looks_inside) {
        if (item::button("Look inside", {width, 0.0F})) go_to(state, chosen->file);
        add_tooltip("Lists the folder; a name with a slash behind it does so, too");
        ImGui::SameLine(0.0F, gap);
    }
    if (item::button("Cancel", {width, 0.0F})) dialog.shown = false;
    ImGui::SameLine(0.0F, gap);
    ImGui::BeginDisabled(chosen == nullptr);
    const bool into = chosen != nullptr && is_only_folder(*chosen);
    if (item::button(into ? "Go there" : "Open", {width, 0.0F})) open(state, *chosen);
    ImGui::EndDisabled();
}

/// The folder's rows, or why they are not known.
void draw_contents(ViewerState& state, ImVec2 size) {
    const OpenDialog& dialog = state.ui.dialog;
    if (dialog.folder.trouble.empty() && !dialog.is_reading) return draw_rows(state, size);
    ImGui::BeginChild("words", size);
    if (dialog.is_reading) {
        draw_dimmed("Reading the folder");
    } else {
        draw_warning(capitalised(dialog.folder.trouble));
    }
    ImGui::EndChild();
}

/// Places, rows and preview side by side if there is room, else only the rows.
void draw_middle(ViewerState& state, const FolderEntry* chosen, float width) {
    const float em = ImGui::GetFontSize();
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float height = room.y - ImGui::GetFrameHeightWithSpacing();
    if (width <= 46.0F * em) return draw_contents(state, {room.x, height});
    draw_places(state, {kPlaces_em * em, height});
    ImGui::SameLine();
    draw_contents(state, {room.x - (kPlaces_em + kPreview_em) * em - 2.0F * gap, height});
    ImGui::SameLine();
    draw_preview(state, chosen, {kPreview_em * em, height});
}

}  // namespace

void draw_open_dialog(ViewerState& state) {
    OpenDialog& dialog = state.ui.dialog;
    dialog.in_front = false;
    if (!dialog.shown) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    const ImVec2 size{std::min(0.92F * display.x, kWidest_em * em),
                      std::min(0.86F * display.y, kHighest_em * em)};
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.5F}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, std::max(1.0F, state.ui.scale));
    ImGui::Begin("Open a recording or a session", &dialog.shown, kTitledWindow);
    dialog.in_front = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
    draw_path(state);
    draw_line(state);
    list_rows(dialog);
    move_choice(dialog);
    const FolderEntry* const chosen = chosen_of(dialog);
    if (std::exchange(dialog.enter, false)) enter(state);
    draw_middle(state, chosen, size.x);
    draw_buttons(state, chosen);
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace dibhr
