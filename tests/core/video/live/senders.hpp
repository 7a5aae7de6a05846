// What sends live pictures to a test, over loopback.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

namespace dibhr::test {

/// A number that nobody else uses for a while.
[[nodiscard]] int free_port();

/// 16-bit grey pictures, uncompressed (YUV4MPEG2), to whoever connects.
class PictureSender {
  public:
    using Clock = std::chrono::steady_clock;

    struct Asked {
        int columns{160}, rows{120};
        double frames_per_s{30.0};
        /// The level of a pixel of frame number k.
        std::function<std::uint16_t(int k, int column, int row)> level{};
        /// So much later than it should be the frame is sent.
        std::function<std::chrono::milliseconds(int k)> late{};
        /// Just before frame k is sent.
        std::function<void(int k, Clock::time_point)> sent{};
        double clock_rate{1.0};  ///< of its own clock, to ours
    };

    PictureSender(int port, Asked asked);
    ~PictureSender();
    PictureSender(const PictureSender&) = delete;
    PictureSender& operator=(const PictureSender&) = delete;

    [[nodiscard]] static std::string url(int port) {
        return "tcp://127.0.0.1:" + std::to_string(port);
    }
    /// Nothing is sent until go_on(); the connection stays.
    void stop() { stopped_ = true; }
    void go_on() { stopped_ = false; }

  private:
    void run();
    void serve(int connection);

    Asked asked_;
    int listener_;
    std::atomic<bool> leaving_{false}, stopped_{false};
    std::thread thread_;
};

/// The ffmpeg program, sending until it is ended.
class Ffmpeg {
  public:
    explicit Ffmpeg(const std::string& arguments);
    ~Ffmpeg() { end(); }
    Ffmpeg(const Ffmpeg&) = delete;
    Ffmpeg& operator=(const Ffmpeg&) = delete;
    void end();
    void stop();
    void go_on();

  private:
    pid_t child_;
};

/// Passes datagrams on from one port to another; `fate` says how late a datagram is, -1: it is
/// lost.
class Relay {
  public:
    Relay(int from, int to, std::function<int(int number)> fate_ms);
    ~Relay();
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;

  private:
    void run(int to);

    std::function<int(int)> fate_ms_;
    int socket_;
    std::atomic<bool> leaving_{false};
    std::thread thread_;
};

}  // namespace dibhr::test
