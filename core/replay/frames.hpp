// The frames and bump maps that a session touched: its files are found and checked again, its
// frames decoded and cleaned as they were recorded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/enum_names.hpp"
#include "core/replay/session_materials.hpp"
#include "core/replay/session_replay.hpp"
#include "core/session/session.hpp"
#include "core/video/motion/frame_motion.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Whether a file is a session: by its name, or by its first bytes.
[[nodiscard]] bool is_session_file(const std::filesystem::path& file);

/// Says what this program computes otherwise than the one that recorded the session; empty:
/// nothing. `cleaned_as_recorded`: the recording's own steps are done.
[[nodiscard]] std::string version_warning(const Session& session, bool cleaned_as_recorded);

/// Finds a recorded file: in its recorded place, else beside the session.
class SessionMediaFinder {
  public:
    /// `any_content`: accepts a file that has changed since.
    SessionMediaFinder(std::filesystem::path session, bool any_content);

    /// The file with the recorded content; `what` ("depth video") names it in messages. Reads it to
    /// its end. Throws InputError when there is none: which, and where to put it.
    [[nodiscard]] std::filesystem::path find(const SessionMedia& media, const std::string& what);

    [[nodiscard]] const std::filesystem::path& session() const noexcept { return session_; }
    /// One sentence for each file that was accepted although it may differ.
    [[nodiscard]] const std::string& warning() const noexcept { return warning_; }
    void warn(const std::string& sentence);

  private:
    std::filesystem::path session_;
    bool any_content_;
    std::string warning_{};
};

/// The cleaning of a source's frames.
[[nodiscard]] FrameCleaning cleaning_of(const FrameSource& source);

struct SessionFramesOptions {
    bool any_media{false};  ///< accepts files that have changed
    bool colour{false};     ///< for a window: reads colour, and keeps fewer frames
    bool motion{false};     ///< estimates motion also where the recording did not
    // Instead of the recorded values; nothing: as recorded.
    std::optional<CleaningPreset> cleaning{};  ///< raw: without the recorded fingertip, too
    std::optional<Fingertip> finger{};
    SessionMaterials::Options materials{};
};

/// Cleans frames as they were recorded, and caches as many as there is room for: a video that
/// repeats is decoded once, and a small step back is immediate. One thread at a time.
class SessionFrames final : public RecordedFrames {
  public:
    /// Finds all files the session names, checks that they are the same and opens the first video.
    /// Throws InputError.
    SessionFrames(const Session& session, const SessionFramesOptions& options);

    [[nodiscard]] Frame frame(const FrameSource& source, double media_s) override;
    void connect(Frame& from, const Frame& to, const MotionRequest& wanted) override {
        motion_.connect(from, to, wanted);
    }
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(
        const SessionParameters& parameters) override {
        return materials_->bump(parameters);
    }

    /// The description of the video that was touched first.
    [[nodiscard]] const MediaDescription& description() const noexcept { return description_; }
    /// See SessionMediaFinder.
    [[nodiscard]] const std::string& warning() const noexcept { return finder_.warning(); }

  private:
    /// One of the session's videos, opened when it is needed.
    struct Video {
        std::filesystem::path colour{}, depth{};
        bool in_colour{false};   ///< its colour is shown, or surfaces depend on it
        DepthRequest request{};  ///< the recorded meaning of its depth
        std::unique_ptr<FrameReader> reader{};
        std::optional<double> last_s{};  ///< of the frame last read
    };
    struct Kept {
        FrameSource source{};
        Frame frame{};
    };

    void find_videos(const Session& session);
    [[nodiscard]] FrameReader& reader_of(Video& video) const;
    [[nodiscard]] CleaningOptions cleaning_for(const FrameSource& source) const;
    [[nodiscard]] const Kept* find(const FrameSource& source, double media_s) const;
    void keep(const FrameSource& source, const Frame& frame);

    SessionFramesOptions options_;
    SessionMediaFinder finder_;
    std::map<std::uint32_t, Video> videos_{};
    std::optional<SessionMaterials> materials_{};
    MediaDescription description_{};
    std::deque<Kept> kept_{};  // the oldest first
    FrameMotion motion_{};
};

/// Where the surfaces of a replay come from.
enum class SurfacesFrom {
    automatic,  ///< from the video if it is there, unchanged and cleaned as it was; else the
                ///< session
    video,
    session,
};
inline constexpr std::array<NamedValue<SurfacesFrom>, 3> kSurfacesFromNames{
    {{SurfacesFrom::automatic, "auto", "Automatic"},
     {SurfacesFrom::video, "video", "The video"},
     {SurfacesFrom::session, "session", "The session"}}};
static_assert(has_all_in_order(kSurfacesFromNames, SurfacesFrom::session));

[[nodiscard]] constexpr const auto& name_table(SurfacesFrom) noexcept {
    return kSurfacesFromNames;
}

/// The surfaces of a session, ready to be replayed.
struct SessionSurfaces {
    std::unique_ptr<RecordedSurfaces> surfaces{};
    MediaDescription description{};  ///< of what was touched first
    std::string warning{};           ///< sentences for people; empty: none
    bool stored{false};              ///< of the session itself, which knows them around the hand
};

/// Throws InputError where neither video nor session gives what is wanted. `session` must outlive
/// the result.
[[nodiscard]] SessionSurfaces open_surfaces(const Session& session,
                                            const SessionFramesOptions& options,
                                            SurfacesFrom from = SurfacesFrom::automatic);

}  // namespace dibhr
