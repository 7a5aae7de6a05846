// Plays a colour + depth pair on threads of its own: decodes ahead, cleans, publishes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/realtime/heartbeat.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/live/live_record.hpp"
#include "core/video/motion/motion_wanted.hpp"
#include "core/video/playing/live_status.hpp"
#include "core/video/playing/transport.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// What the window shows of playback.
struct PlaybackStatus {
    bool open{false};
    bool playing{false};
    bool looping{true};
    std::optional<MediaPart> part{};
    double speed{1.0};
    double media_s{0.0};
    double duration_s{0.0};
    std::int64_t frame{0};
    std::int64_t frames{0};
    double frames_per_s{0.0};  ///< of the video,
    double shown_per_s{0.0};   ///< and how many of them are shown; fewer: this machine is too slow
    bool waits{false};         ///< so much so that the video does not keep its time either
    double decode_ms{0.0};     ///< decoding and cleaning of the last frame
    double clean_ms{0.0};
    double handover_us{0.0};           ///< from the last frame being cleaned to its being published
    std::string cleaning{};            ///< in words: what is done to its depth
    CleaningSteps steps{};             ///< the same
    std::optional<LiveStatus> live{};  ///< nothing: it is read from files
    std::string failure{};  ///< a plain sentence when reading broke off or met less; else empty

    [[nodiscard]] Course course() const {
        return {playing, looping, speed, media_s, 0.0, duration_s, part};
    }
};

/// Every method may be called from the window thread; none waits for decoding. The two frame
/// windows are the readers' ends: `haptics()` belongs to the haptic thread, `picture()` to the
/// window thread.
class Player final : public Transport {
  public:
    Player();
    ~Player() override;  ///< stops the thread
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;

    /// Takes an opened pair over, from its first frame, playing. Its frames carry `number`, and the
    /// maps that lie on them.
    void play_media(std::unique_ptr<Media> media, std::uint32_t number = 0,
                    std::shared_ptr<const TouchMaps> maps = nullptr);

    void play() override;
    void pause() override;
    void seek(double media_s) override;  ///< to the frame shown at that time
    void step(int frames) override;
    void set_looping(bool looping) override;
    void set_part(const std::optional<MediaPart>& part) override;
    void set_speed(double speed) override;
    /// What is as it was asked for last changes nothing, so that it may be said once a picture.
    void set_cleaning(const CleaningOptions& options);
    /// What is to be found out of the time between frames; likewise.
    void set_motion(const MotionWanted& wanted);
    /// Lays them on the media that was given last; null: none.
    void set_maps(std::shared_ptr<const TouchMaps> maps);

    /// Of what is live: from the frame that is shown on they carry that number and go to the sink,
    /// on the player's thread; empty: no more.
    void record_live(std::uint32_t number, LiveSink sink);

    /// As it is shown, with what was asked for since: who asks again goes on from there.
    [[nodiscard]] PlaybackStatus status() const;
    /// Of the thread that cleans and hands over, for as long as it lives.
    [[nodiscard]] const Heartbeat& heart() const noexcept;
    /// Of the one that decodes: silent while it waits for a disk.
    [[nodiscard]] const Heartbeat& decoder_heart() const noexcept;

    [[nodiscard]] TripleBuffer<FrameWindow>& haptics() noexcept;
    [[nodiscard]] TripleBuffer<FrameWindow>& picture() noexcept;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
    CleaningOptions cleaning_{};
    MotionWanted motion_{};
};

}  // namespace dibhr
