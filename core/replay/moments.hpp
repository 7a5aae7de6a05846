// A session opened to be looked at: its ticks one by one, each with the frames it touched.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/replay/frames.hpp"
#include "core/replay/session_replay.hpp"
#include "core/session/session.hpp"

namespace dibhr {

/// Whether a file is a session: by its name, or by how it begins.
[[nodiscard]] bool names_session(const std::filesystem::path& file);

/// A session and what it was recorded over. One thread at a time.
struct OpenedSession {
    /// Looks through the whole file. Throws InputError when it cannot be read, holds no tick, or a
    /// file it was recorded over is missing or has changed (unless `any_media`).
    OpenedSession(const std::filesystem::path& file, bool any_media);

    Session session;
    SessionFrames frames;
};

/// One tick, and what was seen and felt in it.
struct SessionMoment {
    TickRecord tick{};
    std::shared_ptr<const TouchedFrames> frames{};  ///< the last there were; null before the first
    const SessionParameters* parameters{nullptr};   ///< the session's; null: not known
    std::shared_ptr<const BumpMap> bump{};
    std::optional<Touch> computed{};  ///< through other parameters than the recorded ones
    double update_us{0.0};            ///< of what was computed
    bool preview{false};              ///< the same tick comes again, computed
};

/// One thread at a time, the opened session's.
class SessionMoments {
  public:
    /// `opened` must outlive it.
    explicit SessionMoments(OpenedSession& opened) : opened_(opened) {}

    /// The next moment will be the first tick at or after `from_s`. With `other` parameters, what
    /// they give is computed from a second earlier on, so that the proxy has found its place.
    void begin(double from_s, const std::optional<TouchParameters>& other);

    /// Nothing after the last one, or when it was given up before the proxy had found its place.
    /// Throws InputError for a session or video that cannot be read on.
    [[nodiscard]] std::optional<SessionMoment> next(const std::atomic<bool>& given_up);

    /// When the tick before this one was.
    [[nodiscard]] double time_before(std::int64_t tick) const;

  private:
    [[nodiscard]] SessionMoment moment_of(const TickRecord& tick);

    OpenedSession& opened_;
    std::optional<SessionReplay> replay_{};
    double from_s_{0.0};
    bool computes_{false};
    std::shared_ptr<const TouchedFrames> frames_{};  // of the last tick with a surface
};

}  // namespace dibhr
