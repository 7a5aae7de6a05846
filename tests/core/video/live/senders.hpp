// What sends live pictures to a test, over loopback.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace dibhr::test {

/// A number that nobody else uses for a while.
[[nodiscard]] int free_port();

/// Whether somebody comes to listen at that port of this machine.
[[nodiscard]] bool comes_to_listen(int port);

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
    /// Nothing is sent until go_on(), but for what send() asks for; the connection stays. Waits for
    /// the picture that is being sent.
    void stop();
    void go_on();
    /// The next picture, while it is stopped, and its number. Waits until it is on its way.
    int send();

  private:
    void run();
    void serve(int connection);
    [[nodiscard]] bool may_send(int k, Clock::time_point when);

    Asked asked_;
    int listener_;
    std::atomic<bool> leaving_{false};

    std::mutex mutex_{};
    std::condition_variable changed_{};
    bool stopped_{false};  // under the mutex, as the rest
    bool sends_{false};    ///< a picture is on its way to the socket
    int asked_for_{0};     ///< by send()
    int sent_{-1};         ///< the last one

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
