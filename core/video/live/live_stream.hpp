// Reads a live source on its own thread, and opens it again whenever it breaks off; inside the
// room.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "core/video/live/live_input.hpp"

namespace dibhr {

class LiveStream {
  public:
    /// Gets every picture, on the stream's thread. False: the stream closes the connection and
    /// ends.
    using Take = std::function<bool(LivePicture)>;

    /// The last function is called on that thread at an error that waiting does not mend.
    LiveStream(LiveName name, std::string shown, Take take, std::function<void()> permanent_error);
    ~LiveStream();  ///< ends every wait
    LiveStream(const LiveStream&) = delete;
    LiveStream& operator=(const LiveStream&) = delete;

    /// What is made of each picture.
    void set_outputs(bool colour, bool levels);
    /// Why the last connection failed; empty: it did not.
    [[nodiscard]] std::string trouble() const;
    /// Arrival of the last packet, with or without a whole picture; default: none yet.
    [[nodiscard]] LiveInput::Clock::time_point packet_received() const { return last_packet_; }

  private:
    void run();
    [[nodiscard]] bool connect();
    void set_trouble(std::string trouble);
    [[nodiscard]] bool wait_to_retry(std::chrono::milliseconds time);

    const LiveName name_;
    const std::string shown_;
    const Take take_;
    const std::function<void()> on_permanent_error_;
    LiveControl control_{};
    std::atomic<LiveInput::Clock::time_point> last_packet_{};
    bool picture_received_{false};  // the thread's: this connection gave pictures

    mutable std::mutex mutex_{};
    std::condition_variable stop_requested_{};
    std::string trouble_{};

    std::thread thread_;
};

}  // namespace dibhr
