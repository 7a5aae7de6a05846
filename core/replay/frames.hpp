// What a session touched: its files found again and checked, its frames, decoded and cleaned as
// they were, and its bump maps.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/replay/session_replay.hpp"
#include "core/session/session.hpp"
#include "core/video/depth/depth_cleaning.hpp"
#include "core/video/media.hpp"

namespace dibhr {

/// Whether a file is a session: by its name, or by how it begins.
[[nodiscard]] bool names_session(const std::filesystem::path& file);

/// Where to look for a recorded file: in its place, then beside the session.
class SessionMediaFinder {
  public:
    /// `any_content`: a file that has changed since is taken too.
    SessionMediaFinder(std::filesystem::path session, bool any_content);

    /// The file with the recorded content; `what` ("depth video") names it in messages. Reads it to
    /// its end. Throws InputError when there is none: which, and where to put it.
    [[nodiscard]] std::filesystem::path find(const SessionMedia& media, const std::string& what);

    /// What was taken although it is not known to be the same, one sentence a file.
    [[nodiscard]] const std::string& warning() const noexcept { return warning_; }
    void warn(const std::string& sentence);

  private:
    std::filesystem::path session_;
    bool any_content_;
    std::string warning_{};
};

/// However many images wait, so many threads are at work; in the order in which they were given.
class CleaningWorkers {
  public:
    static constexpr std::size_t kWorkers = 2;

    CleaningWorkers();
    ~CleaningWorkers();  ///< what is not begun is given up
    CleaningWorkers(const CleaningWorkers&) = delete;
    CleaningWorkers& operator=(const CleaningWorkers&) = delete;

    [[nodiscard]] std::shared_future<CleanedDepth> clean(DepthImage depth,
                                                         const CleaningOptions& options,
                                                         std::vector<HeldLevel> held = {});

  private:
    struct Job {
        DepthImage depth{};
        CleaningOptions options{};
        std::vector<HeldLevel> held{};
        std::promise<CleanedDepth> done{};
    };

    void run();

    std::mutex mutex_{};
    std::condition_variable asked_{};
    std::deque<Job> waiting_{};  // under the mutex
    bool leaving_{false};        // under the mutex
    std::array<std::thread, kWorkers> threads_{};
};

struct SessionFramesOptions {
    bool any_media{false};         ///< files that have changed are taken too
    bool colour{false};            ///< for a window: with the colour, and no frame too many
    bool raw_depth{false};         ///< no cleaning, whatever was recorded
    std::filesystem::path bump{};  ///< instead of the recorded bump map; empty: the recorded one
};

/// Decodes a few frames ahead, which are cleaned side by side meanwhile, and keeps all of them as
/// long as there is room: a video that repeats is decoded once, and going back a little is
/// immediate. One thread at a time.
class SessionFrames final : public RecordedFrames {
  public:
    /// Finds all files the session names, checks that they are the same and opens the first video.
    /// Throws InputError.
    SessionFrames(const Session& session, const SessionFramesOptions& options);

    [[nodiscard]] Frame frame(const FrameSource& source, double media_s) override;
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters& parameters) override;

    /// Of the video that was touched first.
    [[nodiscard]] const MediaDescription& description() const noexcept { return description_; }
    /// See SessionMediaFinder.
    [[nodiscard]] const std::string& warning() const noexcept { return finder_.warning(); }

  private:
    /// One of the session's videos, opened when it is needed.
    struct Video {
        std::filesystem::path colour{}, depth{};
        DepthRequest request{};  ///< what its depth meant
        std::unique_ptr<Media> media{};
        std::optional<double> last_s{};  ///< of the last frame decoded
    };
    struct Kept {
        FrameSource source{};
        Frame frame{};  ///< its depth is still to come
        std::shared_future<CleanedDepth> depth{};
    };

    void find_videos(const Session& session);
    void read_bumps(const Session& session);
    [[nodiscard]] Media& media_of(Video& video) const;
    [[nodiscard]] const Kept* find(const FrameSource& source, double media_s) const;
    void read_on(const FrameSource& source, double media_s);
    void keep(const FrameSource& source, RawFrame raw);

    SessionFramesOptions options_;
    SessionMediaFinder finder_;
    std::map<std::uint32_t, Video> videos_{};
    std::map<std::filesystem::path, std::shared_ptr<const BumpMap>> bumps_{};  // by recorded names
    std::shared_ptr<const BumpMap> other_bump_{};
    MediaDescription description_{};
    CleaningWorkers cleaning_{};
    std::deque<Kept> kept_{};  // the oldest first
};

}  // namespace dibhr
