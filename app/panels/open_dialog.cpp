// The Open dialog: a folder's recordings, a line that narrows them or takes a path, and a picture
// of the one that is chosen.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/folder.hpp"
#include "app/settings/recent_files.hpp"
#include "core/video/media_names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr float kWidest_em = 72.0F;
constexpr float kHighest_em = 36.0F;
constexpr float kPreview_em = 17.0F;
constexpr float kPlaces_em = 10.0F;

std::string size_text(const FolderEntry& entry) {
    if (entry.kind == FileKind::folder) return {};
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

/// The name of a texture as ImGui wants it: as a pointer, or, from 1.91.4 on, as a number.
template <typename Id>
Id texture_id(std::uintptr_t name) {
    if constexpr (std::is_pointer_v<Id>) {
        return reinterpret_cast<Id>(name);  // NOLINT(performance-no-int-to-ptr)
    } else {
        return static_cast<Id>(name);
    }
}

void go_to(ViewerState& state, const fs::path& folder) {
    state.requests.folder = folder;
    state.dialog.typed = {};
    ++state.dialog.line;
    state.dialog.asks_for_keyboard = OpenDialog::kPicturesToFocus;
    state.dialog.chosen.clear();
}

void open(ViewerState& state, const FolderEntry& entry) {
    if (entry.kind == FileKind::folder) return go_to(state, entry.file);
    OpenRequest request{entry.file, entry.depth};
    request.in_any_order = entry.depth.empty();  // depth alone finds its colour
    state.requests.open = request;
    state.dialog.shown = false;
}

/// What was typed narrows the rows, unless it is a path.
bool is_wanted(const OpenDialog& dialog, const FolderEntry& entry) {
    if (!dialog.all_files && !can_be_opened(entry)) return false;
    const std::string typed = lower_case(dialog.typed.data());
    if (typed.empty() || typed.find('/') != std::string::npos || typed.starts_with('~'))
        return true;
    return lower_case(entry.name()).find(typed) != std::string::npos;
}

std::vector<const FolderEntry*> rows_of(const OpenDialog& dialog) {
    std::vector<const FolderEntry*> rows;
    rows.reserve(dialog.folder.entries.size());
    for (const FolderEntry& entry : dialog.folder.entries) {
        if (is_wanted(dialog, entry)) rows.push_back(&entry);
    }
    return rows;
}

const FolderEntry* chosen_of(const OpenDialog& dialog,
                             const std::vector<const FolderEntry*>& rows) {
    for (const FolderEntry* row : rows) {
        if (row->file == dialog.chosen) return row;
    }
    return nullptr;
}

/// A path that is there, or a row; the program says why where neither can be opened.
void open_typed(ViewerState& state, const std::vector<const FolderEntry*>& rows) {
    OpenDialog& dialog = state.dialog;
    const std::string typed = dialog.typed.data();
    const FolderEntry* chosen = chosen_of(dialog, rows);
    if (typed.empty()) {
        if (chosen != nullptr) open(state, *chosen);
        return;
    }
    const fs::path named = typed_path(typed);
    std::error_code unknown;
    for (const fs::path& place : {dialog.folder.path / named, fs::absolute(named, unknown)}) {
        if (is_folder(place)) return go_to(state, place);
        if (!fs::exists(place, unknown)) continue;
        const auto in_pair = entry_of(dialog.folder, place);
        return open(
            state, in_pair ? dialog.folder.entries[*in_pair] : FolderEntry{FileKind::other, place});
    }
    if (chosen == nullptr && !rows.empty() && !named.has_parent_path()) chosen = rows.front();
    open(state, chosen != nullptr ? *chosen : FolderEntry{FileKind::other, named});
}

int complete(ImGuiInputTextCallbackData* data) {
    const fs::path& folder = *static_cast<const fs::path*>(data->UserData);
    const std::string typed(data->Buf, static_cast<std::size_t>(data->BufTextLen));
    const std::string whole = completed(typed, folder);
    if (whole != typed) {
        data->DeleteChars(0, data->BufTextLen);
        data->InsertChars(0, whole.c_str());
    }
    return 0;
}

/// The folder's parents, each a button.
void draw_path(ViewerState& state) {
    const fs::path& path = state.dialog.folder.path;
    fs::path part;
    std::vector<fs::path> parts;
    for (const fs::path& name : path) parts.push_back(part /= name);
    const float room = ImGui::GetContentRegionAvail().x;
    const auto name_of_part = [](const fs::path& p) {
        return p.has_filename() ? p.filename().string() : p.string();
    };
    float width = 0.0F;  // the last ones are those that matter
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
        if (ImGui::Button(name_of_part(parts[k]).c_str())) go_to(state, parts[k]);
        ImGui::PopID();
    }
}

void draw_line(ViewerState& state, const std::vector<const FolderEntry*>& rows) {
    OpenDialog& dialog = state.dialog;
    if (dialog.asks_for_keyboard > 0) {
        ImGui::SetWindowFocus();
        ImGui::SetKeyboardFocusHere();
        --dialog.asks_for_keyboard;
    }
    ImGui::SetNextItemWidth(-1.0F);
    fs::path folder = dialog.folder.path;
    ImGui::PushID(dialog.line);
    ImGui::InputTextWithHint("##typed", "Type to narrow the list, or a path (Tab completes it)",
                             dialog.typed.data(), dialog.typed.size(),
                             ImGuiInputTextFlags_CallbackCompletion, complete, &folder);
    if (ImGui::IsItemActive()) dialog.asks_for_keyboard = 0;
    ImGui::PopID();
    if (std::exchange(dialog.enter, false)) open_typed(state, rows);
}

void move_choice(OpenDialog& dialog, const std::vector<const FolderEntry*>& rows) {
    const int by = std::exchange(dialog.move, 0);
    if (by == 0 || rows.empty()) return;
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const FolderEntry* row) {
        return row->file == dialog.chosen;
    });
    const int last = static_cast<int>(rows.size()) - 1;
    const int next = found == rows.end()
                         ? (by > 0 ? 0 : last)
                         : std::clamp(static_cast<int>(found - rows.begin()) + by, 0, last);
    dialog.chosen = rows[static_cast<std::size_t>(next)]->file;
    dialog.bring_into_sight = true;
}

void draw_rows(ViewerState& state, const std::vector<const FolderEntry*>& rows, ImVec2 size) {
    OpenDialog& dialog = state.dialog;
    constexpr ImGuiTableFlags kTable =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
    const float em = ImGui::GetFontSize();
    const bool wide = size.x > 26.0F * em;
    if (!ImGui::BeginTable("rows", wide ? 3 : 1, kTable, size)) return;
    ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch);
    if (wide) {
        ImGui::TableSetupColumn("Size", ImGuiTableColumnFlags_WidthFixed, 4.6F * em);
        ImGui::TableSetupColumn("Changed", ImGuiTableColumnFlags_WidthFixed, 9.0F * em);
    }
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_SliderGrab));
    for (const FolderEntry* row : rows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushID(row->file.c_str());
        const bool chosen = row->file == dialog.chosen;
        if (ImGui::Selectable(
                row->name().c_str(), chosen,
                ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
            dialog.chosen = row->file;
            if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) open(state, *row);
        }
        if (chosen && std::exchange(dialog.bring_into_sight, false)) ImGui::SetScrollHereY(0.5F);
        ImGui::PopID();
        if (!wide) continue;
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", size_text(*row).c_str());
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", time_text(*row).c_str());
    }
    ImGui::PopStyleColor();
    ImGui::EndTable();
}

void draw_places(ViewerState& state, ImVec2 size) {
    ImGui::BeginChild("places", size);
    const auto place = [&state](const std::string& label, const fs::path& folder) {
        ImGui::PushID(folder.c_str());
        if (ImGui::Selectable(label.c_str(), folder == state.dialog.folder.path))
            go_to(state, folder);
        ImGui::PopID();
        explain(folder.c_str());
    };
    place("Home", typed_path("~"));
    std::error_code unknown;
    place("Current folder", fs::current_path(unknown));
    if (!state.dialog.sample_folder.empty()) place("Sample", state.dialog.sample_folder);
    ImGui::Spacing();
    if (!state.recent.empty()) ImGui::TextDisabled("Recent");
    std::vector<fs::path> listed;
    for (const RecentFile& file : state.recent) {
        const fs::path folder = file.colour.parent_path();
        if (std::find(listed.begin(), listed.end(), folder) != listed.end()) continue;
        listed.push_back(folder);
        place(folder.filename().string() + "/", folder);
    }
    ImGui::EndChild();
}

void draw_preview(const ViewerState& state, const FolderEntry* chosen, ImVec2 size) {
    const OpenDialog& dialog = state.dialog;
    ImGui::BeginChild("preview", size);
    if (chosen != nullptr) {
        const Preview& preview = dialog.preview;
        const bool of_chosen = preview.of == chosen->file;
        if (of_chosen && preview.texture != 0) {
            const float width = ImGui::GetContentRegionAvail().x;
            const float height = std::min(width * static_cast<float>(preview.rows) /
                                              static_cast<float>(std::max(preview.columns, 1)),
                                          0.7F * size.y);
            const float drawn = height * static_cast<float>(preview.columns) /
                                static_cast<float>(std::max(preview.rows, 1));
            ImGui::Image(texture_id<ImTextureID>(preview.texture), {drawn, height});
        }
        ImGui::TextWrapped("%s", chosen->name().c_str());
        ImGui::TextDisabled("%s%s", chosen->depth.empty() ? "" : "Colour + depth, ",
                            name_of(chosen->kind));
        if (of_chosen && !preview.words.empty()) quiet_text(preview.words);
    } else {
        quiet_text("Choose a recording: colour and depth of one are one row.");
    }
    ImGui::EndChild();
}

void draw_buttons(ViewerState& state, const FolderEntry* chosen) {
    OpenDialog& dialog = state.dialog;
    ImGui::Checkbox("All files", &dialog.all_files);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = 6.5F * ImGui::GetFontSize();
    ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - 2.0F * width - gap);
    if (ImGui::Button("Cancel", {width, 0.0F})) dialog.shown = false;
    ImGui::SameLine(0.0F, gap);
    ImGui::BeginDisabled(chosen == nullptr);
    const bool into = chosen != nullptr && chosen->kind == FileKind::folder;
    if (ImGui::Button(into ? "Go there" : "Open", {width, 0.0F})) open(state, *chosen);
    ImGui::EndDisabled();
}

}  // namespace

void draw_open_dialog(ViewerState& state) {
    OpenDialog& dialog = state.dialog;
    if (!dialog.shown) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    const ImVec2 size{std::min(0.92F * display.x, kWidest_em * em),
                      std::min(0.86F * display.y, kHighest_em * em)};
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.5F}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, std::max(1.0F, state.scale));
    ImGui::Begin("Open a recording or a session", &dialog.shown,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    const std::vector<const FolderEntry*> rows = rows_of(dialog);
    move_choice(dialog, rows);
    const FolderEntry* chosen = chosen_of(dialog, rows);
    draw_path(state);
    draw_line(state, rows);
    const float height = ImGui::GetContentRegionAvail().y - ImGui::GetFrameHeightWithSpacing();
    const bool wide = size.x > 46.0F * em;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float all = ImGui::GetContentRegionAvail().x;
    if (wide) {
        draw_places(state, {kPlaces_em * em, height});
        ImGui::SameLine();
    }
    const float middle = all - (wide ? (kPlaces_em + kPreview_em) * em + 2.0F * gap : 0.0F);
    if (!dialog.folder.trouble.empty()) {
        ImGui::BeginChild("trouble", {middle, height});
        trouble_text(capitalised(dialog.folder.trouble));
        ImGui::EndChild();
    } else {
        draw_rows(state, rows, {middle, height});
    }
    if (wide) {
        ImGui::SameLine();
        draw_preview(state, chosen, {kPreview_em * em, height});
    }
    draw_buttons(state, chosen);
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace dibhr
