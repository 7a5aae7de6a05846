// Plays a colour + depth pair on its own threads: decodes ahead, cleans, publishes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/realtime/heartbeat.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/live/live_record.hpp"
#include "core/video/motion/motion_request.hpp"
#include "core/video/playing/drawing_rate.hpp"
#include "core/video/playing/live_status.hpp"
#include "core/video/playing/transport.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// The state of playback that the window shows.
struct PlaybackStatus {
    bool open{false};
    bool playing{false};
    bool looping{true};
    bool ended{false};    ///< the last frame that playing shows is shown, and nothing plays on
    bool preview{false};  ///< what is shown is not touched: the frame itself is being read
    std::optional<MediaPart> part{};
    double speed{1.0};
    double media_s{0.0};
    double duration_s{0.0};
    std::int64_t frame{0};
    std::int64_t frames{0};
    double frames_per_s{0.0};  ///< of the video
    double shown_per_s{0.0};   ///< frames shown; fewer: this machine is too slow
    std::string dropped{};     ///< what this machine is too slow for, and why; empty: nothing
    double most_pictures_per_s{0.0};  ///< that the window draws, so that frames have time; 0: any
    double decode_ms{0.0};            ///< decoding and cleaning of the last frame
    double clean_ms{0.0};
    double handover_us{0.0};           ///< from the end of cleaning the last frame to publishing it
    bool prepared{false};              ///< its surface was cleaned before, and is read
    std::string cleaning{};            ///< the cleaning as a sentence
    std::string decoders{};            ///< MediaDescription::decoders
    CleaningSteps steps{};             ///< the same as steps, none of them left out
    std::optional<LiveStatus> live{};  ///< nothing: read from files
    std::string failure{};  ///< a sentence when a read failed or the file is shorter; else empty

    [[nodiscard]] PlayState play_state() const {
        return {playing, looping, speed, media_s, 0.0, duration_s, part};
    }
};

/// Every method may be called from the window thread; none waits for decoding. Of the two triple
/// buffers the haptic thread reads `haptics()`, the window thread `picture()`.
class Player final : public Transport {
  public:
    /// On the player's thread `on_frames` is called whenever picture() has been published, and
    /// `on_window` with each window before it is published to haptics().
    explicit Player(std::function<void()> on_frames = {},
                    std::function<void(const FrameWindow&)> on_window = {});
    ~Player() override;  ///< stops the thread
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;

    /// Plays an opened pair from its first frame. Its frames carry `number` and the touch maps.
    void play_media(std::unique_ptr<Media> media, std::uint32_t number = 0,
                    std::shared_ptr<const TouchMaps> maps = nullptr);

    void play() override;
    void pause() override;
    void seek(double media_s) override;  ///< to the frame shown at that time
    void step(int frames) override;
    void set_looping(bool looping) override;
    void set_part(const std::optional<MediaPart>& part) override;
    void set_speed(double speed) override;
    /// An unchanged value does nothing, so that the window may set it once a picture.
    void set_cleaning(const CleaningOptions& options);
    /// What is computed between frames; likewise.
    void set_motion(const MotionRequest& wanted);
    /// What the window takes for drawing, which is limited while frames are late; any time.
    void set_drawing_cost(const DrawingCost& drawing);
    /// Puts them on the media given last; null: none.
    void set_maps(std::shared_ptr<const TouchMaps> maps);

    /// Of a live source: from the shown frame on, frames carry that number and go to the sink, on
    /// the player's thread; empty: stops.
    void record_live(std::uint32_t number, LiveSink sink);

    /// The shown state, with the changes requested since: a second step starts from the first.
    [[nodiscard]] PlaybackStatus status() const;
    /// Of the thread that cleans and publishes, until the player ends.
    [[nodiscard]] const Heartbeat& heart() const noexcept;
    /// Of the thread that decodes: silent while it waits for a disk.
    [[nodiscard]] const Heartbeat& decoder_heartbeat() const noexcept;

    [[nodiscard]] TripleBuffer<FrameWindow>& haptics() noexcept;
    [[nodiscard]] TripleBuffer<FrameWindow>& picture() noexcept;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
    CleaningOptions cleaning_{};
    MotionRequest motion_{};
};

}  // namespace dibhr
