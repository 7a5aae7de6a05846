// One connection to something live, through libav: its pictures as they come; inside the room.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/av/objects.hpp"
#include "core/error.hpp"
#include "core/video/formats/av_frame.hpp"
#include "core/video/live/depth_camera.hpp"
#include "core/video/live/live_name.hpp"

struct AVStream;

namespace dibhr {

/// A picture as it came. Shared with nobody who writes.
struct LivePicture {
    using Clock = std::chrono::steady_clock;

    cv::Mat colour{};          ///< 8-bit blue, green, red; empty: not wanted
    cv::Mat levels{};          ///< one channel of 8 or 16 bits; empty: not wanted
    int bits{8};               ///< of a level
    bool grey{false};          ///< coded without colours
    double stamp_s{0.0};       ///< by the clock of its source; NaN: it has none
    double frames_per_s{0.0};  ///< as the source says; 0: it does not
    std::string codec{};
    Clock::time_point arrived{};
};

/// What of a picture is made; may change while it runs.
struct LiveWants {
    std::atomic<bool> colour{true};
    std::atomic<bool> levels{true};
    std::atomic<bool> leaving{false};  ///< whatever waits ends
};

/// What nobody need wait for: it would be the same another time.
class LiveRefusal : public InputError {
  public:
    using InputError::InputError;
};

/// Keeps nothing back that has come: no frames of a decoder's threads, no buffer of a demuxer's.
/// Pictures that hold damage are left out up to the next whole one.
class LiveInput {
  public:
    using Clock = LivePicture::Clock;

    /// Waits for the first packets. Throws InputError: what, which place, what to do next; also
    /// where nothing comes for a while; LiveRefusal where it never will. `heard`: when the last
    /// packet came, whether or not it makes a picture. Both outlive it.
    LiveInput(const LiveName& name, const std::string& shown, const LiveWants& wants,
              std::atomic<Clock::time_point>& heard);
    ~LiveInput();
    LiveInput(const LiveInput&) = delete;
    LiveInput& operator=(const LiveInput&) = delete;

    /// Waits for the next picture. False: it has ended, nothing came for a while, or it leaves.
    [[nodiscard]] bool read(LivePicture& picture);

  private:
    struct Pipe;

    static int is_over(void* input) noexcept;
    static int read_pipe(void* input, std::uint8_t* bytes, int size) noexcept;
    [[nodiscard]] int open(const LiveName& name, bool as_depth);
    [[noreturn]] void refuse(const LiveName& name, const std::string& shown, int result) const;
    void open_decoder(const LiveName& name, const std::string& shown);
    void await(std::chrono::milliseconds patience);
    [[nodiscard]] bool send_next();
    [[nodiscard]] bool is_whole();
    void keep_time(double stamp_s);
    [[nodiscard]] bool take(LivePicture& picture);
    [[nodiscard]] bool read_camera(LivePicture& picture);

    const LiveWants& wants_;
    std::atomic<Clock::time_point>& heard_;
    LiveKind kind_;
    std::chrono::milliseconds silent_;  // so long the next packet is waited for
    CameraCalls calls_{};
    std::unique_ptr<DepthCamera> camera_{};  // then there is nothing of libav's
    std::unique_ptr<Pipe> pipe_{};
    AvOwned<AVIOContext> bytes_{};
    AvOwned<AVFormatContext> context_{};
    AvOwned<AVCodecContext> decoder_{};
    AvOwned<AVFrame> frame_{new_frame()};
    AvOwned<AVPacket> packet_{new_packet()};
    FramePictures pictures_{};
    AVStream* stream_{nullptr};   // the context's
    Clock::time_point latest_{};  // then nothing has come for too long
    Clock::time_point arrived_{};
    Clock::time_point begin_{};  // when the stamp first_s_ was due
    double first_s_{0.0};
    bool damaged_{false};
};

}  // namespace dibhr
