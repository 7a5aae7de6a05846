// Decodes on its own thread, a few frames ahead of the reader, and prepares the frames that wait.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "core/realtime/heartbeat.hpp"
#include "core/realtime/now.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Heartbeats of the decoding thread and of the reading thread; null: nobody watches it.
struct ReaderHeartbeats {
    Heartbeat* decoding{nullptr};
    Heartbeat* reading{nullptr};  ///< rests while it waits for the decoder
};

/// Gives the frames of the wrapped media, in the same order, without the skipped ones. It decodes
/// ahead only after two reads in a row, or after decode_from(): a single read costs no more than
/// it would without this class.
class DecodedAhead : public Media {
  public:
    /// `now` is the clock that measures decoding.
    explicit DecodedAhead(std::unique_ptr<Media> media, ReaderHeartbeats heartbeats = {},
                          Now now = std::chrono::steady_clock::now);
    ~DecodedAhead() override;  ///< waits for the frame that is being decoded
    DecodedAhead(const DecodedAhead&) = delete;
    DecodedAhead& operator=(const DecodedAhead&) = delete;

    /// Of the frame read last.
    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override { return next_from(0.0); }
    std::optional<RawFrame> next_from(double earliest_s) override {
        return next_from(earliest_s, 0.0);
    }
    /// The decoder then also skips frames before next_shown_s() of the frame given out last. A
    /// reader that wants every following frame has to seek first.
    std::optional<RawFrame> next_from(double earliest_s, double spacing_s);
    /// How long the frame read last took, less the decoding of it and of the frames skipped before
    /// it [s]; nothing: not known, as after a jump.
    [[nodiscard]] std::optional<double> conversion_s() const { return conversion_s_; }
    void seek(double media_s) override;
    void seek_near(double media_s) override;
    void seek_depth(double media_s) override;
    void leave_out_depth(const FrameTimes& times) override;
    /// As seek(), but decoding begins at once, since the following frames will be read soon.
    void decode_from(double media_s);

    /// What the decoding thread does to waiting frames while it has nothing to decode. All that the
    /// function uses must outlive this object. A frame that is read earlier comes unprepared.
    /// Empty: no preparation.
    using Preparation = std::function<void(RawFrame&)>;
    void prepare_with(Preparation preparation);

  private:
    enum class Jump { exact, near, depth };
    enum class Begins { when_read, at_once };
    struct Target {
        double media_s;
        Jump jump;
    };
    enum class Prepared { no, now, yes };
    struct Decoded {
        std::optional<RawFrame> frame{};  ///< nothing: the media has ended
        Prepared prepared{Prepared::no};
        std::exception_ptr error{};
        MediaDescription description{};
        std::optional<double> conversion_s{};
        std::size_t bytes{0};
    };

    void wait(std::unique_lock<std::mutex>& lock);
    [[nodiscard]] bool is_at_end() const;
    Decoded take(double earliest_s);
    void apply_spacing(const RawFrame& frame);
    void jump(Target target, Begins begins);
    void run();
    [[nodiscard]] bool has_room() const;
    [[nodiscard]] bool can_be_read() const;
    [[nodiscard]] Decoded* unprepared();
    void decode_one(std::unique_lock<std::mutex>& lock);
    void prepare(Decoded& waiting, std::unique_lock<std::mutex>& lock);
    [[nodiscard]] Decoded decode(const std::optional<Target>& target,
                                 const std::optional<FrameTimes>& leave_out, double from_s);

    // Used by the decoding thread only.
    std::unique_ptr<Media> media_;
    ReaderHeartbeats heartbeats_;
    Now now_;
    double last_s_{0.0};  ///< of the frame decoded last, or the target of a jump
    std::int64_t last_index_{0};

    // Used by the reader only.
    MediaDescription description_;
    std::optional<double> conversion_s_{};

    // Used by both threads, under the mutex.
    std::mutex mutex_{};
    std::condition_variable wake_decoder_{}, wake_reader_{};
    std::deque<Decoded> decoded_{};
    std::shared_ptr<const Preparation> preparation_{};
    std::size_t bytes_{0};                   ///< of all in `decoded_`
    std::size_t consecutive_reads_{0};       ///< since the last jump; decode_from() sets it
    double from_s_{0.0};                     ///< earlier frames are skipped
    double spacing_s_{0.0};                  ///< one frame of so much media time is made; 0: all
    std::optional<FrameTimes> leave_out_{};  ///< for the next jump; nothing: as it was
    std::optional<Target> target_{};         ///< where to decode next; nothing: the following frame
    bool reader_waits_{false};
    bool ended_{false};  ///< at the end, or the next frame failed: decode only on request
    bool stopping_{false};

    std::thread thread_{};
};

}  // namespace dibhr
