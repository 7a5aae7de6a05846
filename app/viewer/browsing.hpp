// What the Open dialog shows, read away from the window's thread; and the next file of a folder.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/folder.hpp"
#include "app/viewer/errand.hpp"
#include "core/video/frames/frame_window.hpp"
#include "render/gl_objects.hpp"

namespace dibhr {

class Browsing {
  public:
    /// `errands` outlive it.
    explicit Browsing(Errands& errands);

    /// Shows the dialog, or puts it away.
    void toggle(ViewerState& state);

    /// Where whoever opens files begins to look: the folder of what is shown.
    [[nodiscard]] std::filesystem::path first_folder(const ViewerState& state) const;

    /// Shows the dialog with what that folder holds.
    void show(const std::filesystem::path& folder, ViewerState& state);

    /// The file after the one that is shown, or before it, in its folder: asked for when the folder
    /// has been read. False while it is still being read for the last one.
    [[nodiscard]] bool go_by(int entries, const ViewerState& state);

    /// Reads another folder for the dialog.
    void go_to(const std::filesystem::path& folder, OpenDialog& dialog);
    /// Finds what Tab makes of what is typed.
    void complete(const std::string& typed, const OpenDialog& dialog);
    /// Finds what was entered, which is then opened.
    void enter(const TypedFile& entered, const OpenDialog& dialog);

    /// Once a picture: takes what was read and found. What there is to tell a person.
    [[nodiscard]] std::optional<std::string> advance(ViewerState& state);

  private:
    struct Read {
        std::filesystem::path of{};
        std::shared_ptr<const ColourImage> picture{};
        std::string words{};
    };

    static Read read_preview(const FolderEntry& entry);
    void take_folder(OpenDialog& dialog);
    void take_typed(ViewerState& state);
    void advance_preview(OpenDialog& dialog);
    [[nodiscard]] std::string step(const Folder& folder, ViewerState& state) const;

    std::filesystem::path sample_folder_;
    std::shared_ptr<const ColourImage> picture_{};
    ColourTexture texture_{};
    int by_{0};
    int entered_in_{0};  // OpenDialog::line: another one asks for nothing any more
    Errand<Folder> folder_;
    Errand<Completion> completion_;
    Errand<FolderEntry> typed_;
    Errand<Read> preview_;
    Errand<Folder> neighbours_;
};

}  // namespace dibhr
