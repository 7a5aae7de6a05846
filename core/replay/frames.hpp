// The frames that a session touched, with their colour: decoded and cleaned as they were recorded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/replay/bumps.hpp"
#include "core/replay/media.hpp"
#include "core/replay/session_replay.hpp"
#include "core/video/frame_reader.hpp"
#include "core/video/media.hpp"

namespace dibhr {

/// Keeps the last seconds of frames, so that going back a little is immediate. One thread at a
/// time.
class SessionFrames final : public RecordedFrames {
  public:
    /// Finds all files the session names, checks that they are the same (`any_media`: or takes them
    /// as they are) and opens the first video. Throws InputError.
    SessionFrames(const Session& session, bool any_media);

    /// The frame at exactly this presentation time. Throws InputError when there is none.
    [[nodiscard]] Frame frame(const FrameSource& source, double media_s);
    [[nodiscard]] std::shared_ptr<const BumpMap> bump_map(const SessionParameters& parameters) {
        return bumps_.of(parameters);
    }

    [[nodiscard]] std::shared_ptr<const DepthImage> depth(const FrameSource& source,
                                                          double media_s) override {
        return frame(source, media_s).depth;
    }
    [[nodiscard]] const BumpMap* bump(const SessionParameters& parameters) override {
        return bumps_.of(parameters).get();
    }

    /// Of the video that was touched first.
    [[nodiscard]] const MediaDescription& description() const noexcept { return description_; }
    /// See SessionMediaFinder.
    [[nodiscard]] const std::string& warning() const noexcept { return finder_.warning(); }

  private:
    /// One of the session's videos, opened when it is needed.
    struct Video {
        std::filesystem::path colour{}, depth{};
        std::unique_ptr<FrameReader> reader{};
        std::optional<double> last_s{};  ///< of the last frame that was read
    };
    struct Kept {
        FrameSource source{};
        Frame frame{};
    };

    [[nodiscard]] FrameReader& reader_of(std::uint32_t number);
    [[nodiscard]] std::optional<Frame> read(const FrameSource& source, double media_s);
    void keep(const FrameSource& source, const Frame& frame);

    SessionMediaFinder finder_;
    SessionBumps bumps_{};
    std::map<std::uint32_t, Video> videos_{};
    std::deque<Kept> kept_{};  // the oldest first
    MediaDescription description_{};
};

}  // namespace dibhr
