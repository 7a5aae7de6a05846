// Plays a session: its ticks are read, their frames decoded and other parameters computed ahead on
// a thread of its own; the window takes what is due, and a band that shows when it was in contact.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/replay/frames.hpp"
#include "core/replay/session_replay.hpp"
#include "core/session/session.hpp"
#include "core/video/playing/transport.hpp"

namespace dibhr {

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
    std::int64_t count{0};                          ///< of the tick, as people count: from 0
    std::shared_ptr<const TouchedFrames> frames{};  ///< the last there were; null before the first
    const SessionParameters* parameters{nullptr};   ///< the session's; null: not known
    std::shared_ptr<const BumpMap> bump{};
    std::optional<Touch> computed{};       ///< through other parameters than the recorded ones
    std::vector<AlgorithmProxy> others{};  ///< of the algorithms that this is not of, if asked for
    bool preview{false};                   ///< the same tick comes again, computed
};

/// What the window shows of it. Times are those of the ticks.
struct SessionPlayback : Course {
    SessionPlayback() noexcept : Course{.playing = true} {}

    bool waiting{false};    ///< for ticks that are being read
    std::string failure{};  ///< a plain sentence when reading broke off; empty otherwise
};

/// All of it belongs to the window's thread; nothing waits for a disk or for decoding. Its clock is
/// that of the pictures: what is asked for counts from the last one on.
class SessionPlayer final : public Transport {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Begins to play from the first tick on.
    explicit SessionPlayer(std::unique_ptr<OpenedSession> opened);
    ~SessionPlayer() override;  ///< ends its thread
    SessionPlayer(const SessionPlayer&) = delete;
    SessionPlayer& operator=(const SessionPlayer&) = delete;

    void play() override;
    void pause() override;
    void seek(double t_s) override;
    void step(int ticks) override;  ///< by that many forth, or by one back
    void set_looping(bool looping) override;
    void set_part(const std::optional<MediaPart>& part) override;
    void set_speed(double speed) override;
    /// What these parameters give is computed from now on; nothing: as recorded.
    void compute(const std::optional<TouchParameters>& other);
    /// Whether the other algorithms' proxies are computed, too, from a second before the moment
    /// where that is asked for or a jump ends.
    void compare(bool algorithms);

    /// Once a picture, at that time: goes on to the last moment that is due and gives each one on
    /// the way to `passed`.
    void advance(Time now, const std::function<void(const SessionMoment&)>& passed);

    /// Null until the first one has been read.
    [[nodiscard]] const SessionMoment* moment() const;
    [[nodiscard]] const SessionPlayback& playback() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Pieces of the time from the first tick to the last: which of them hold a contact.
struct ContactBand {
    static constexpr std::size_t kPieces = 1200;

    std::array<bool, kPieces> contact{};
    HandTicks hand{};
};

/// Reads the session once, on a thread of its own, from construction on.
class SessionOutline {
  public:
    SessionOutline(const std::filesystem::path& file, double begin_s, double end_s);
    ~SessionOutline();  ///< breaks off
    SessionOutline(const SessionOutline&) = delete;
    SessionOutline& operator=(const SessionOutline&) = delete;

    /// Null until it is done, or when the session cannot be read on: whoever plays it says why.
    [[nodiscard]] const ContactBand* band();

  private:
    std::atomic<bool> leaving_{false};
    std::future<std::unique_ptr<ContactBand>> result_;
    std::unique_ptr<ContactBand> band_{};
};

}  // namespace dibhr
