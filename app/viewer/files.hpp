// The viewer's files: those a person opens, away from the window's thread; pictures of the window;
// and the settings a person changed.
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "app/settings/consent.hpp"
#include "app/settings/file_memory.hpp"
#include "app/settings/settings.hpp"
#include "app/viewer/errand.hpp"
#include "app/viewer/painting.hpp"
#include "core/replay/session_player.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// "dibhr-20261120-060742-123.ENDING" in the current folder: to the millisecond, so that no two
/// files share a name.
[[nodiscard]] std::string new_file_name(const char* ending);

/// What a picture or clip of now is called after the settings' pattern, without its ending.
[[nodiscard]] std::string picture_name(const ViewerState& state);

/// Writes pictures away from the window's thread.
class Screenshots {
  public:
    /// The next picture that is drawn is to be saved.
    void ask(PictureOf of) { asked_.insert(of); }
    [[nodiscard]] bool wants(PictureOf of) const { return asked_.contains(of); }

    /// Begins to write what was asked for into a new file of that name, or with a number after it.
    void save(PictureOf of, ColourImage picture, const std::string& name);

    /// What came of one that is done, for a notice. Throws InputError, once a picture.
    [[nodiscard]] std::optional<std::string> take();

    /// Waits for all. Throws InputError for the first that could not be written.
    void finish();

  private:
    std::set<PictureOf> asked_{};
    std::vector<std::future<std::string>> writing_{};
};

/// Saves the settings a person changed in the window, a little after each change and at the end,
/// and that they agree to them.
class SettingsKeeper {
  public:
    /// `in_file`: as read; `started`: as the window started, the command line's values on top. A
    /// value that still is what it started as stays in the file as it was.
    SettingsKeeper(Settings in_file, Settings started, std::filesystem::path file,
                   ErrandsInOrder& writing);

    /// Once a picture. Writes when a change is two seconds old; `writing` tells of a failure.
    void look(const Settings& now, double now_s);

    /// At the end: writes what is not yet written.
    void finish(const Settings& now);

    /// Nobody agrees to these: the file is to have the usual values.
    void forget(const std::vector<Doubt>& doubts) { copy_doubted(doubts, {}, in_file_); }

  private:
    void save(const Settings& now);

    Settings in_file_;
    Settings started_;
    Settings agreed_;  // so far, by changing them
    Settings wanted_;  // for the file
    Settings written_;
    std::filesystem::path file_;
    ErrandsInOrder& writing_;
    double changed_s_{0.0};
};

/// What came of opening files: media, a session, or a plain sentence.
struct Opened {
    OpenRequest request{};
    std::unique_ptr<Media> media{};
    FileMemory memory{};  ///< of the media
    FoundMaps maps{};     ///< likewise
    std::unique_ptr<OpenedSession> session{};
    std::string failure{};
    bool is_folder{false};    ///< what failed is one: of recordings, not of pictures
    bool lacks_depth{false};  ///< what failed is colour alone
};

/// The file whose memory is kept: colour, where there is a pair; empty for the program's own
/// sample, which everybody finds as it is.
[[nodiscard]] std::filesystem::path remembered_file(const MediaDescription& media);
[[nodiscard]] FileMemory memory_of(const Media& media);

/// Opens what a person dropped or typed. Dropped pairs are told apart by name, else by which one is
/// grey. Throws InputError.
[[nodiscard]] std::unique_ptr<Media> open_request(const OpenRequest& request);

/// The file is for a Falcon, not to be looked at.
[[nodiscard]] bool named_firmware(const std::filesystem::path& file);

/// One or two dropped files as a request; nothing for none or more than two.
[[nodiscard]] std::optional<OpenRequest> dropped_request(
    const std::vector<std::filesystem::path>& files);

/// Opens what is asked for: media, or a session. For a thread that may wait.
[[nodiscard]] Opened try_open(const OpenRequest& request);

}  // namespace dibhr
