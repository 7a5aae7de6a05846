// What a session touched: its frames, decoded and cleaned as they were, and its bump maps.
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

#include "core/replay/cleaning_workers.hpp"
#include "core/replay/media.hpp"
#include "core/replay/session_replay.hpp"
#include "core/video/media.hpp"

namespace dibhr {

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
        std::unique_ptr<Media> media{};
        std::optional<double> last_s{};  ///< of the last frame decoded
    };
    struct Kept {
        FrameSource source{};
        Frame frame{};  ///< its depth is still to come
        std::shared_future<std::shared_ptr<const DepthImage>> depth{};
    };

    void find_files(const Session& session);
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
