// Plays a session: a thread of its own reads ticks, decodes their frames and computes other
// parameters ahead; the window takes the moments that are due. And the band of its contacts.
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

/// The time from the first tick to the last in equal pieces: which of them hold a contact.
struct ContactBand {
    static constexpr std::size_t kPieces = 1200;

    std::array<bool, kPieces> contact{};
    HandTicks hand{};
};

/// A session and its frames. One thread at a time.
struct OpenedSession {
    /// Checks the whole file. Throws InputError when it cannot be read, holds no tick, or one of
    /// its media files is missing or has changed (unless `any_media`) and it holds no surface.
    OpenedSession(const std::filesystem::path& file, bool any_media,
                  SurfacesFrom from = SurfacesFrom::automatic);

    Session session;
    SessionSurfaces frames;
    /// Of a damaged session, which is rescued only once; else null: see ContactBandReader.
    std::unique_ptr<ContactBand> band{};
};

/// One tick, with its frames and parameters.
struct SessionMoment {
    TickRecord tick{};
    std::int64_t count{0};                          ///< of the tick, as people count: from 0
    std::shared_ptr<const TouchedFrames> frames{};  ///< the last ones so far; null: none yet
    const SessionParameters* parameters{nullptr};   ///< the session's; null: not known
    std::shared_ptr<const BumpMap> bump{};
    std::optional<Touch> computed{};       ///< with other parameters than the recorded ones
    std::vector<AlgorithmProxy> others{};  ///< of the other algorithms, if compare() is on
    bool preview{false};                   ///< the same tick follows again, computed
};

/// The state of the player, for the window. Times are those of the ticks.
struct SessionPlayback : PlayState {
    SessionPlayback() noexcept : PlayState{.playing = true} {}

    bool waiting{false};    ///< for ticks that are being read
    std::string failure{};  ///< a plain sentence when reading broke off; empty otherwise
};

/// For the window's thread; no call waits for a disk or for decoding. The clock advances with the
/// window's turns: a call takes effect from the last turn on.
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
    void step(int ticks) override;  ///< above 0: so many forward; below 0: one back
    void set_looping(bool looping) override;
    void set_part(const std::optional<MediaPart>& part) override;
    void set_speed(double speed) override;
    /// Computes all ticks with these parameters from now on; nothing: as recorded.
    void compute(const std::optional<TouchParameters>& other);
    /// Whether the other algorithms' proxies are computed, too. They begin before the present
    /// moment, or before the target of a jump: see warm_up_s().
    void compare(bool algorithms);

    /// Once a turn of the window, at its time: advances to the last moment that is due, and calls
    /// `passed` with each moment on the way.
    void advance(Time now, const std::function<void(const SessionMoment&)>& passed);

    /// Null until the first one has been read.
    [[nodiscard]] const SessionMoment* moment() const;
    [[nodiscard]] const SessionPlayback& playback() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Reads the session once, on a thread of its own, from construction on.
class ContactBandReader {
  public:
    /// Takes the band of `opened` where there is one.
    explicit ContactBandReader(OpenedSession& opened);
    ~ContactBandReader();  ///< breaks off
    ContactBandReader(const ContactBandReader&) = delete;
    ContactBandReader& operator=(const ContactBandReader&) = delete;

    /// Null until it is read, and when reading failed: the player reports why.
    [[nodiscard]] const ContactBand* band();

  private:
    std::atomic<bool> stopping_{false};
    std::future<std::unique_ptr<ContactBand>> result_;
    std::unique_ptr<ContactBand> band_{};
};

}  // namespace dibhr
