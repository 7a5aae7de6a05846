// Decodes and cleans the depth that a session touched, as it was when it was recorded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/replay/bumps.hpp"
#include "core/replay/cleaning_workers.hpp"
#include "core/replay/media.hpp"
#include "core/replay/session_replay.hpp"
#include "core/video/media.hpp"

namespace dibhr {

struct SessionVideoOptions {
    bool any_media{false};         ///< files that have changed are taken too
    bool raw_depth{false};         ///< no cleaning, whatever was recorded
    std::filesystem::path bump{};  ///< instead of the recorded bump map; empty: the recorded one
};

/// Decodes a few frames ahead, which are cleaned side by side meanwhile, and keeps all of them as
/// long as there is room: a video that repeats is decoded once.
class SessionVideo final : public RecordedFrames {
  public:
    /// Finds all files the session names and checks that they are the same. Throws InputError.
    SessionVideo(const Session& session, const SessionVideoOptions& options);

    [[nodiscard]] std::shared_ptr<const DepthImage> depth(const FrameSource& source,
                                                          double media_s) override;
    [[nodiscard]] const BumpMap* bump(const SessionParameters& parameters) override;

    /// See SessionMediaFinder.
    [[nodiscard]] const std::string& warning() const noexcept { return finder_.warning(); }

  private:
    using Depth = std::shared_ptr<const DepthImage>;
    using FrameName = std::pair<FrameSource, double>;  ///< its presentation time
    struct Kept {
        FrameName name{};
        std::shared_future<Depth> depth{};
    };
    /// One of the session's videos, opened when it is needed.
    struct Video {
        std::filesystem::path file{};
        std::unique_ptr<Media> media{};
        std::optional<double> last_s{};  ///< of the last frame decoded
    };

    [[nodiscard]] const Kept* find(const FrameName& name) const;
    void read_on(const FrameSource& source, double media_s);
    void keep(const FrameSource& source, RawFrame frame);

    SessionMediaFinder finder_;
    bool raw_depth_;
    std::map<std::uint32_t, Video> videos_{};
    SessionBumps bumps_{};
    std::optional<BumpMap> other_bump_{};
    CleaningWorkers cleaning_{};
    std::deque<Kept> kept_{};  ///< the oldest first
};

}  // namespace dibhr
