// One connection to a live source, through libav: its pictures as they arrive; inside the room.
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

/// A picture as it arrived. Shared; never written to.
struct LivePicture {
    using Clock = std::chrono::steady_clock;

    cv::Mat colour{};          ///< 8-bit blue, green, red; empty: not requested
    cv::Mat levels{};          ///< one channel of 8 or 16 bits; empty: not requested
    int bits{8};               ///< of a level
    bool grey{false};          ///< coded without colours
    double stamp_s{0.0};       ///< by the clock of its source; NaN: none
    double frames_per_s{0.0};  ///< rate that the source states; 0: none
    std::string codec{};
    Clock::time_point arrived{};
};

/// What is made of each picture, and the stop flag; may change while a connection runs.
struct LiveControl {
    std::atomic<bool> colour{true};
    std::atomic<bool> levels{true};
    std::atomic<bool> stopping{false};  ///< every wait ends
};

/// An error that another try would meet again.
class LivePermanentError : public InputError {
  public:
    using InputError::InputError;
};

/// Adds no delay: no decoder threads that hold frames, no buffer in the demuxer. Damaged pictures
/// are dropped, up to the next whole one.
class LiveInput {
  public:
    using Clock = LivePicture::Clock;

    /// Waits for the first packets. Throws InputError: what, which place, what to do next; also
    /// when nothing arrives for a while; LivePermanentError where nothing ever will. The last
    /// argument gets the arrival time of each packet. It and `control` must outlive this object.
    LiveInput(const LiveName& name, const std::string& shown, const LiveControl& control,
              std::atomic<Clock::time_point>& last_packet);
    ~LiveInput();
    LiveInput(const LiveInput&) = delete;
    LiveInput& operator=(const LiveInput&) = delete;

    /// Waits for the next picture. False: end of the stream, timeout, or stop.
    [[nodiscard]] bool read(LivePicture& picture);

  private:
    struct Pipe;

    static int must_stop(void* input) noexcept;
    static int read_pipe(void* input, std::uint8_t* bytes, int size) noexcept;
    [[nodiscard]] int open(const LiveName& name, bool as_depth);
    [[noreturn]] void refuse(const LiveName& name, const std::string& shown, int result) const;
    void open_decoder(const LiveName& name, const std::string& shown);
    void set_deadline(std::chrono::milliseconds timeout);
    [[nodiscard]] bool send_next();
    [[nodiscard]] bool is_whole();
    void wait_until_due(double stamp_s);
    [[nodiscard]] bool take(LivePicture& picture);
    [[nodiscard]] bool read_camera(LivePicture& picture);

    const LiveControl& control_;
    std::atomic<Clock::time_point>& last_packet_;
    LiveKind kind_;
    std::chrono::milliseconds timeout_;  // for the next packet
    CameraCalls calls_{};
    std::unique_ptr<DepthCamera> camera_{};  // then libav is not used
    std::unique_ptr<Pipe> pipe_{};
    AvOwned<AVIOContext> bytes_{};
    AvOwned<AVFormatContext> context_{};
    AvOwned<AVCodecContext> decoder_{};
    AvOwned<AVFrame> frame_{new_frame()};
    AvOwned<AVPacket> packet_{new_packet()};
    FramePictures pictures_{};
    AVStream* stream_{nullptr};     // owned by the context
    Clock::time_point deadline_{};  // when the present wait times out
    Clock::time_point arrived_{};
    Clock::time_point begin_{};  // when the picture with stamp first_s_ was due
    double first_s_{0.0};
    bool damaged_{false};
};

}  // namespace dibhr
