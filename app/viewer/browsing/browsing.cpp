// The Open dialog's folder and preview, and the next file of a folder.
#include "app/viewer/browsing/browsing.hpp"

#include <cmath>
#include <cstdint>
#include <exception>
#include <system_error>
#include <utility>
#include <vector>

#include "app/panels/widgets.hpp"
#include "app/settings/assets_path.hpp"
#include "app/viewer/files.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/session/session.hpp"
#include "render/relief_paint.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kMostPreview_px = 640;
constexpr std::chrono::milliseconds kRest{120};  // of the choice, before its preview is read

/// "640 x 480", "12.4 s, 372 frames", and what the opening chose.
std::string text_of(const MediaDescription& media) {
    std::string text =
        std::to_string(media.depth_columns) + " x " + std::to_string(media.depth_rows);
    if (media.still) {
        text += "\nA still picture";
    } else if (media.live) {
        text += "\nLive";
    } else {
        text += "\n" + clock_text(media.duration_s) + ", " + (media.frames_exact ? "" : "about ") +
                std::to_string(media.frames) + " frames";
    }
    return media.notice.empty() ? text : text + "\n" + capitalised(media.notice) + ".";
}

std::string text_of(const Session& session) {
    std::string text = clock_text(session.end_s() - session.begin_s()) + " of touch";
    const std::size_t marks = session.marks().size();
    if (marks > 0) text += ", " + std::to_string(marks) + (marks > 1 ? " marks" : " mark");
    const fs::path colour = session.fact("colour");
    return colour.empty() ? text : text + "\nof " + colour.filename().string();
}

/// Near is light. Where there is no data, it is as far as the farthest.
std::shared_ptr<const ColourImage> depth_preview(DepthImage depth) {
    std::vector<std::uint8_t> unseen(depth.levels.size());
    for (std::size_t k = 0; k < unseen.size(); ++k) {
        if (std::isfinite(depth.levels[k])) continue;
        unseen[k] = 1;
        depth.levels[k] = 0.0F;
    }
    return depth_picture(depth, &unseen, ReliefPaint::viridis, kMostPreview_px);
}

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
      recordings_(tasks),
      neighbours_(tasks) {}

Browsing::~Browsing() {
    if (stop_) *stop_ = true;
}

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
    dialog.refused.clear();
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
    entered_ = entered.typed;
    typed_.restart([entered, listed = dialog.folder] {
        return resolve_typed(listed, entered.typed, entered.chosen);
    });
}

std::optional<std::string> Browsing::advance(ViewerState& state) {
    take_folder(state.ui.dialog);
    if (!state.ui.dialog.shown) recordings_.stop();
    take_typed(state);
    mark_recordings(state.ui.dialog);
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
    recordings_.search(dialog.folder);
    // The row of a pair is named by its colour.
    if (const auto row = index_of_entry(dialog.folder, dialog.chosen))
        dialog.chosen = dialog.folder.entries[*row].file;
}

void Browsing::take_typed(ViewerState& state) {
    OpenDialog& dialog = state.ui.dialog;
    if (auto completion = completion_.take()) dialog.completion = std::move(*completion);
    const auto looked_up = typed_.take();
    if (!looked_up || !dialog.shown || dialog.line != entered_in_ ||
        entered_ != dialog.typed.data())
        return;
    const std::optional<FolderEntry>& meant = *looked_up;
    if (!meant) {
        dialog.refused = entered_;
        dialog.pictures_to_focus = OpenDialog::kPicturesToFocus;
        return;
    }
    if (is_only_folder(*meant)) return go_to(meant->file, dialog);
    state.commands.push(request_for(*meant));
    dialog.shown = false;
}

void Browsing::mark_recordings(OpenDialog& dialog) {
    for (const FoundRecording& found : recordings_.take()) {
        const auto at = index_of_entry(dialog.folder, found.folder);
        if (!at) continue;
        dialog.folder.entries[*at].recording = true;
        dialog.folder.entries[*at].folders = found.folders;
    }
}

/// Shows the preview of the chosen entry once that has rested for a moment; one of another entry
/// that is still being read is not waited for.
void Browsing::advance_preview(OpenDialog& dialog) {
    const auto at = index_of_entry(dialog.folder, dialog.chosen);
    const fs::path chosen = dialog.shown && at ? dialog.chosen : fs::path();
    if (chosen != wanted_) {
        if (stop_) *stop_ = true;
        preview_.drop();
        wanted_ = chosen;
        wanted_at_ = Clock::now();
        waits_ = !chosen.empty();
        dialog.preview = {};
    }
    if (waits_ && Clock::now() >= wanted_at_ + kRest) {
        waits_ = false;
        stop_ = std::make_shared<std::atomic<bool>>(false);
        preview_.restart([entry = dialog.folder.entries[*at], stop = stop_] {
            return read_preview(entry, stop);
        });
    }
    auto read = preview_.take();
    if (!read) return;
    if (at && read->opens && read->file == chosen)
        dialog.folder.entries[*at].recording = dialog.folder.entries[*at].kind == FileKind::folder;
    colour_ = std::move(read->colour);
    depth_ = std::move(read->depth);
    Preview& preview = dialog.preview;
    preview = {.file = std::move(read->file), .text = std::move(read->text)};
    if (colour_) {
        preview.columns = colour_->columns;
        preview.rows = colour_->rows;
        preview.colour = colour_texture_.show(colour_, kMostPreview_px, false);
    }
    if (depth_) {
        preview.depth_columns = depth_->columns;
        preview.depth_rows = depth_->rows;
        preview.depth = depth_texture_.show(depth_, kMostPreview_px, false);
    }
}

Browsing::Read Browsing::read_preview(const FolderEntry& entry, const Stop& stop) {
    Read read{.file = entry.file};
    try {
        if (entry.kind == FileKind::session) {
            read.text = text_of(Session(entry.file, IfDamaged::refuse));
            return read;
        }
        if (entry.kind == FileKind::other) return read;
        if (entry.kind == FileKind::folder && !may_be_recording(entry.file)) return read;
        const auto media = open_request(request_for(entry));
        read.opens = true;
        read.text = text_of(media->description());
        if (*stop) return read;
        auto first = media->next();
        if (!first || *stop) return read;
        read.depth = depth_preview(std::move(first->depth));
        if (!first->colour.rgb.empty())
            read.colour = std::make_shared<const ColourImage>(std::move(first->colour));
    } catch (const DamagedSession&) {  // what can be read of it takes its time
        read.text = "Damaged.";
    } catch (const std::exception&) {  // the reason is shown when it is opened
        if (entry.kind != FileKind::folder) read.text = "No depth was found for it.";
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
