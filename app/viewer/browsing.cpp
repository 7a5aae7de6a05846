// The Open dialog's folder and preview, and the next file of a folder.
#include "app/viewer/browsing.hpp"

#include <chrono>
#include <exception>
#include <utility>

#include "app/settings/assets_path.hpp"
#include "core/error.hpp"
#include "core/video/media.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kMostPreview_px = 640;

template <typename T>
std::optional<T> result_of(std::future<T>& future) {
    if (!future.valid() || future.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    return future.get();
}

/// The file that is shown: of a pair the one that was named.
fs::path shown_file(const ViewerState& state) {
    if (state.replay) return state.replay->file;
    return state.media.colour_path.empty() ? state.media.depth_path : state.media.colour_path;
}

fs::path sample_folder() try {
    return sample_files().colour.parent_path();
} catch (const InputError&) {
    return {};
}

}  // namespace

void Browsing::toggle(ViewerState& state) {
    OpenDialog& dialog = state.dialog;
    dialog.shown = !dialog.shown;
    if (!dialog.shown) return;
    dialog.sample_folder = sample_folder();
    dialog.typed = {};
    ++dialog.line;
    dialog.asks_for_keyboard = OpenDialog::kPicturesToFocus;
    const fs::path shown = shown_file(state);
    dialog.chosen = fs::absolute(shown).lexically_normal();
    const fs::path folder = dialog.chosen.parent_path();
    // Nobody keeps recordings beside the program's own.
    std::error_code unknown;
    state.requests.folder = folder == dialog.sample_folder ? fs::current_path(unknown) : folder;
}

bool Browsing::go_by(int entries, const ViewerState& state) {
    if (neighbours_.valid()) return false;
    by_ = entries;
    const fs::path folder = fs::absolute(shown_file(state)).parent_path();
    neighbours_ = std::async(std::launch::async, read_folder, folder);
    return true;
}

std::optional<std::string> Browsing::advance(ViewerState& state) {
    OpenDialog& dialog = state.dialog;
    if (state.requests.folder) next_folder_ = std::exchange(state.requests.folder, {});
    if (auto folder = result_of(folder_)) dialog.folder = std::move(*folder);
    if (next_folder_ && !folder_.valid())
        folder_ = std::async(std::launch::async, read_folder, *std::exchange(next_folder_, {}));
    if (auto preview = result_of(preview_)) {
        picture_ = std::move(preview->picture);
        dialog.preview = {.of = std::move(preview->of), .words = std::move(preview->words)};
        if (picture_) {
            dialog.preview.columns = picture_->columns;
            dialog.preview.rows = picture_->rows;
            dialog.preview.texture = texture_.show(picture_, kMostPreview_px, false);
        }
    }
    if (dialog.shown) look_at_chosen(state);
    if (const auto folder = result_of(neighbours_)) return step(*folder, state);
    return std::nullopt;
}

void Browsing::look_at_chosen(ViewerState& state) {
    const OpenDialog& dialog = state.dialog;
    if (preview_.valid() || dialog.chosen.empty() || dialog.preview.of == dialog.chosen) return;
    const auto chosen = entry_of(dialog.folder, dialog.chosen);
    if (chosen)
        preview_ = std::async(std::launch::async, read_preview, dialog.folder.entries[*chosen]);
}

Browsing::Read Browsing::read_preview(const FolderEntry& entry) {
    Read read{.of = entry.file};
    if (entry.kind != FileKind::video && entry.kind != FileKind::picture) return read;
    try {
        const auto media = open_media(entry.file, entry.depth);
        const auto first = media->next();
        const MediaDescription& about = media->description();
        if (first) read.picture = std::make_shared<const ColourImage>(first->colour);
        read.words = std::to_string(about.depth_columns) + " x " + std::to_string(about.depth_rows);
    } catch (const std::exception&) {  // whoever opens it is told why
        read.words = "No depth was found for it.";
    }
    return read;
}

std::optional<std::string> Browsing::step(const Folder& folder, ViewerState& state) const {
    std::vector<const FolderEntry*> files;
    files.reserve(folder.entries.size());
    std::optional<std::size_t> at;
    const auto shown = entry_of(folder, shown_file(state));
    for (std::size_t k = 0; k < folder.entries.size(); ++k) {
        const FolderEntry& entry = folder.entries[k];
        if (entry.kind == FileKind::folder || !can_be_opened(entry)) continue;
        if (shown == k) at = files.size();
        files.push_back(&entry);
    }
    const long next = (at ? static_cast<long>(*at) : -1) + by_;
    if (next < 0) return "The first one in its folder";
    if (next >= static_cast<long>(files.size())) return "The last one in its folder";
    const FolderEntry& entry = *files[static_cast<std::size_t>(next)];
    OpenRequest request{entry.file, entry.depth};
    request.in_any_order = entry.depth.empty();
    state.requests.open = request;
    return std::to_string(next + 1) + " of " + std::to_string(files.size()) + ": " + entry.name();
}

}  // namespace dibhr
