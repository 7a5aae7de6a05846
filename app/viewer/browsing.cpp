// The Open dialog's folder and preview, and the next file of a folder.
#include "app/viewer/browsing.hpp"

#include <exception>
#include <system_error>
#include <utility>
#include <vector>

#include "app/settings/assets_path.hpp"
#include "app/viewer/files.hpp"
#include "core/error.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kMostPreview_px = 640;

/// The shown file; of a pair the one that was named.
fs::path shown_file(const ViewerState& state) {
    if (state.touch.replay) return state.touch.replay->file;
    return state.media.colour_path.empty() ? state.media.depth_path : state.media.colour_path;
}

fs::path sample_folder() try {
    return sample_files().colour.parent_path();
} catch (const InputError&) {
    return {};
}

}  // namespace

Browsing::Browsing(TaskGroup& tasks)
    : sample_folder_(sample_folder()),
      folder_(tasks),
      completion_(tasks),
      typed_(tasks),
      preview_(tasks),
      neighbours_(tasks) {}

void Browsing::toggle(ViewerState& state) {
    if (state.ui.dialog.shown) {
        state.ui.dialog.shown = false;
        return;
    }
    show(first_folder(state), state);
    state.ui.dialog.chosen = whole_path(shown_file(state));
}

fs::path Browsing::first_folder(const ViewerState& state) const {
    const fs::path file = shown_file(state);
    const fs::path folder = whole_path(file).parent_path();
    // The sample's folder is no place for a user's recordings.
    return file.empty() || folder == sample_folder_ ? whole_path(".") : folder;
}

void Browsing::show(const fs::path& folder, ViewerState& state) {
    OpenDialog& dialog = state.ui.dialog;
    dialog.shown = true;
    dialog.sample_folder = sample_folder_;
    dialog.move = 0;
    dialog.enter = false;
    go_to(folder, dialog);
}

void Browsing::go_to(const fs::path& folder, OpenDialog& dialog) {
    folder_.restart([folder] { return read_folder(folder); });
    dialog.folder = {.path = whole_path(folder)};
    dialog.is_reading = true;
    ++dialog.reading_number;
    dialog.typed = {};
    ++dialog.line;
    dialog.pictures_to_focus = OpenDialog::kPicturesToFocus;
    dialog.chosen.clear();
}

bool Browsing::read_neighbours(int entries, const ViewerState& state) {
    const fs::path folder = whole_path(shown_file(state)).parent_path();
    if (!neighbours_.start([folder] { return read_folder(folder); })) return false;
    neighbour_offset_ = entries;
    return true;
}

void Browsing::complete(const std::string& typed, const OpenDialog& dialog) {
    completion_.restart([typed, folder = dialog.folder.path] {
        return Completion{typed, completed(typed, folder)};
    });
}

void Browsing::enter(const TypedFile& entered, const OpenDialog& dialog) {
    entered_in_ = dialog.line;
    typed_.restart([entered, listed = dialog.folder] {
        return resolve_typed(listed, entered.typed, entered.chosen);
    });
}

std::optional<std::string> Browsing::advance(ViewerState& state) {
    take_folder(state.ui.dialog);
    take_typed(state);
    advance_preview(state.ui.dialog);
    if (const auto folder = neighbours_.take()) return open_neighbour(*folder, state);
    return std::nullopt;
}

void Browsing::take_folder(OpenDialog& dialog) {
    auto folder = folder_.take();
    if (!folder) return;
    dialog.folder = std::move(*folder);
    dialog.is_reading = false;
    ++dialog.reading_number;
    // The row of a pair is named by its colour.
    if (const auto row = index_of_entry(dialog.folder, dialog.chosen))
        dialog.chosen = dialog.folder.entries[*row].file;
}

void Browsing::take_typed(ViewerState& state) {
    OpenDialog& dialog = state.ui.dialog;
    if (auto completion = completion_.take()) dialog.completion = std::move(*completion);
    const auto meant = typed_.take();
    if (!meant || !dialog.shown || dialog.line != entered_in_) return;
    if (meant->kind == FileKind::folder) return go_to(meant->file, dialog);
    state.commands.push(request_for(*meant));
    dialog.shown = false;
}

void Browsing::advance_preview(OpenDialog& dialog) {
    if (auto preview = preview_.take()) {
        picture_ = std::move(preview->picture);
        dialog.preview = {.file = std::move(preview->file), .text = std::move(preview->text)};
        if (picture_) {
            dialog.preview.columns = picture_->columns;
            dialog.preview.rows = picture_->rows;
            dialog.preview.texture = texture_.show(picture_, kMostPreview_px, false);
        }
    }
    if (!dialog.shown || dialog.chosen.empty() || dialog.preview.file == dialog.chosen) return;
    const auto chosen = index_of_entry(dialog.folder, dialog.chosen);
    if (!chosen || preview_.running()) return;
    preview_.start([entry = dialog.folder.entries[*chosen]] { return read_preview(entry); });
}

Browsing::Read Browsing::read_preview(const FolderEntry& entry) {
    Read read{.file = entry.file};
    if (entry.kind != FileKind::video && entry.kind != FileKind::picture) return read;
    try {
        const auto media = open_request(request_for(entry));
        const auto first = media->next();
        const MediaDescription& about = media->description();
        if (first) read.picture = std::make_shared<const ColourImage>(first->colour);
        read.text = std::to_string(about.depth_columns) + " x " + std::to_string(about.depth_rows);
    } catch (const std::exception&) {  // the reason is shown when the file is opened
        read.text = "No depth was found for it.";
    }
    return read;
}

std::string Browsing::open_neighbour(const Folder& folder, ViewerState& state) const {
    if (!folder.trouble.empty()) return folder.trouble;
    std::vector<const FolderEntry*> files;
    files.reserve(folder.entries.size());
    std::optional<std::size_t> at;
    const auto shown = index_of_entry(folder, shown_file(state));
    for (std::size_t k = 0; k < folder.entries.size(); ++k) {
        const FolderEntry& entry = folder.entries[k];
        if (entry.kind == FileKind::folder || !can_be_opened(entry)) continue;
        if (shown == k) at = files.size();
        files.push_back(&entry);
    }
    const long next = (at ? static_cast<long>(*at) : -1) + neighbour_offset_;
    if (next < 0) return "The first one in its folder";
    if (next >= static_cast<long>(files.size())) return "The last one in its folder";
    const FolderEntry& entry = *files[static_cast<std::size_t>(next)];
    state.commands.push(request_for(entry));
    return std::to_string(next + 1) + " of " + std::to_string(files.size()) + ": " + entry.name();
}

}  // namespace dibhr
