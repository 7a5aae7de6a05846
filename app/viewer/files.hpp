// The viewer's files: opening files on other threads; pictures of the window; saving the changed
// settings.
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
#include "app/viewer/guide/guide.hpp"
#include "app/viewer/painting/painting.hpp"
#include "app/viewer/task_group.hpp"
#include "core/replay/session_player.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// "dibhr-20261120-060742-123.ENDING" in the current folder: to the millisecond, so that no two
/// files share a name.
[[nodiscard]] std::string new_file_name(const char* ending);

/// Name of a new picture or clip by the settings' pattern, without its extension.
[[nodiscard]] std::string picture_name(const ViewerState& state);

/// Writes pictures on other threads.
class Screenshots {
  public:
    /// Requests that the next drawn picture is saved.
    void request(PictureOf of) { requested_.insert(of); }
    [[nodiscard]] bool wants(PictureOf of) const { return requested_.contains(of); }

    /// Starts writing a requested picture into a new file; adds a number where `name` exists.
    void save(PictureOf of, ColourImage picture, const std::string& name);

    /// A notice about a finished picture. Throws InputError, once a picture, when it failed.
    [[nodiscard]] std::optional<std::string> take();

    /// Waits for all. Throws InputError for the first that could not be written.
    void finish();

  private:
    std::set<PictureOf> requested_{};
    std::vector<std::future<std::string>> writing_{};
};

/// Saves the settings changed in the window, a little after each change and at the end. A change
/// that protects the hand less is recorded as the user's consent.
class SettingsSaver {
  public:
    /// `in_file`: as read; `started`: at the window's start, with the command line's values. A
    /// value that was not changed since the start stays in the file as it was.
    SettingsSaver(Settings in_file, Settings started, std::filesystem::path file,
                  TaskQueue& writing);

    /// Once a turn. Writes when a change is two seconds old; the task queue throws on failure.
    void poll(const Settings& now, double now_s);

    /// At the end: writes what is not yet written.
    void finish(const Settings& now);

    /// The user refused these values: the file gets the defaults instead.
    void use_defaults(const std::vector<UnsafeSetting>& unsafe_settings) {
        copy_unsafe(unsafe_settings, {}, in_file_);
    }

  private:
    void save(const Settings& now);

    Settings in_file_;
    Settings started_;
    Settings agreed_;  // consent is recorded up to here
    Settings wanted_;  // for the file
    Settings written_;
    std::filesystem::path file_;
    TaskQueue& writing_;
    double changed_s_{0.0};
    double next_poll_s_{0.0};  // comparing in each turn would cost a resting window time
};

/// Result of opening files: media, a session, or a failure as a sentence.
struct OpenResult {
    OpenRequest request{};
    std::unique_ptr<Media> media{};
    FileMemory memory{};  ///< of the media
    FoundMaps maps{};     ///< likewise
    FoundGuide guide{};   ///< likewise
    std::unique_ptr<OpenedSession> session{};
    std::string failure{};
    bool is_folder{false};    ///< the failed path is a folder of recordings
    bool lacks_depth{false};  ///< the failed file has colour only
};

/// Whether that is the colour file of the built-in sample.
[[nodiscard]] bool is_sample(const std::filesystem::path& file);
/// A file's name for people, or a live place's without its password.
[[nodiscard]] std::string shown_name(const std::filesystem::path& file);
/// The file for which view and relief are saved: colour, where there is a pair; empty for the
/// built-in sample, which always opens unchanged.
[[nodiscard]] std::filesystem::path remembered_file(const MediaDescription& media);
[[nodiscard]] FileMemory memory_of(const Media& media);

/// Opens dropped or typed files. In a dropped pair, colour and depth are told apart by name, else
/// by which one is grey. Throws InputError.
[[nodiscard]] std::unique_ptr<Media> open_request(const OpenRequest& request);

/// Whether the name is that of Falcon firmware, not of media.
[[nodiscard]] bool named_firmware(const std::filesystem::path& file);

/// One or two dropped files as a request; nothing for none or more than two.
[[nodiscard]] std::optional<OpenRequest> dropped_request(
    const std::vector<std::filesystem::path>& files);

/// Opens media or a session. May wait for disk and network: not for the window's thread.
[[nodiscard]] OpenResult try_open(const OpenRequest& request);

}  // namespace dibhr
