// Decodes on a thread of its own, a few frames ahead of who reads them, and prepares what waits.
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

/// Of the thread that decodes and of the one that reads what it decoded; null: nobody listens.
struct ReadingHearts {
    Heartbeat* decoding{nullptr};
    Heartbeat* reading{nullptr};  ///< rests while it waits for the other
};

/// The same frames, in the same order, as those of the media it takes over, but for those that are
/// passed over. Nothing is decoded ahead before two frames were read in a row or decode_from() asks
/// for it, so that a single one costs no more than it did.
class DecodedAhead : public Media {
  public:
    /// `now` is what decoding is measured by.
    explicit DecodedAhead(std::unique_ptr<Media> media, ReadingHearts hearts = {},
                          Now now = std::chrono::steady_clock::now);
    ~DecodedAhead() override;  ///< waits for the frame that is being decoded
    DecodedAhead(const DecodedAhead&) = delete;
    DecodedAhead& operator=(const DecodedAhead&) = delete;

    /// As of the frame last read.
    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override { return next_from(0.0); }
    std::optional<RawFrame> next_from(double earliest_s) override {
        return next_from(earliest_s, 0.0);
    }
    /// Then those that are less than `apart_s` after it are passed over ahead of time: who wants
    /// each of those that follow has to seek from then on.
    std::optional<RawFrame> next_from(double earliest_s, double apart_s);
    /// How long the frame last read took beyond decoding it and those that were passed over before
    /// it [s]; nothing: it is not known, as after a jump.
    [[nodiscard]] std::optional<double> making_s() const { return making_s_; }
    void seek(double media_s) override;
    void seek_near(double media_s) override;
    /// As seek(), but decoding begins there at once: what follows will be read, in a while.
    void decode_from(double media_s);

    /// What is done to frames that wait to be read, while nothing is to be decoded: called by the
    /// decoding thread, so that what it uses must outlive this. A frame that is read sooner comes
    /// without. Nothing: they are left as they are.
    using Preparation = std::function<void(RawFrame&)>;
    void prepare_with(Preparation preparation);

  private:
    enum class Jump { exact, near };
    enum class Begins { when_read, at_once };
    struct Target {
        double media_s;
        Jump jump;
    };
    enum class Prepared { no, now, yes };
    struct Decoded {
        std::optional<RawFrame> frame{};  ///< nothing: the end
        Prepared prepared{Prepared::no};
        std::exception_ptr broken{};
        MediaDescription description{};
        std::optional<double> making_s{};
        std::size_t bytes{0};
    };

    void wait(std::unique_lock<std::mutex>& lock);
    [[nodiscard]] bool is_at_end() const;
    Decoded take(double earliest_s);
    void go_on_apart_from(const RawFrame& frame);
    void jump(Target target, Begins begins);
    void run();
    [[nodiscard]] bool has_room() const;
    [[nodiscard]] bool can_be_read() const;
    [[nodiscard]] Decoded* unprepared();
    void decode_one(std::unique_lock<std::mutex>& lock);
    void prepare(Decoded& waiting, std::unique_lock<std::mutex>& lock);
    [[nodiscard]] Decoded decode(const std::optional<Target>& target, double from_s);

    // The decoding thread's.
    std::unique_ptr<Media> media_;
    ReadingHearts hearts_;
    Now now_;
    double last_s_{0.0};  ///< of the frame decoded last, or where it jumps
    std::int64_t last_index_{0};

    // The reader's.
    MediaDescription description_;
    std::optional<double> making_s_{};

    // Both threads', under the mutex.
    std::mutex mutex_{};
    std::condition_variable asked_{}, ready_{};
    std::deque<Decoded> decoded_{};
    std::shared_ptr<const Preparation> preparation_{};
    std::size_t bytes_{0};            ///< of them
    std::size_t read_in_a_row_{0};    ///< since the last jump; as if, where more will be
    double from_s_{0.0};              ///< what is before is passed over
    double apart_s_{0.0};             ///< as is what is nearer than this to one that is wanted
    std::optional<Target> target_{};  ///< where to decode next; nothing: what follows
    bool waited_for_{false};
    bool ended_{false};  ///< nothing follows, or it cannot be read, until it is asked for
    bool leaving_{false};

    std::thread thread_{};
};

}  // namespace dibhr
