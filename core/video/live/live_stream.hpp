// Something live, read on a thread of its own, and opened again whenever it breaks off; inside the
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
    /// Gets every picture, on the stream's thread. False: no more are wanted, and the connection is
    /// given up.
    using Take = std::function<bool(LivePicture)>;

    /// `refused` is called there, too, when it is said that no picture will come.
    LiveStream(LiveName name, std::string shown, Take take, std::function<void()> refused);
    ~LiveStream();  ///< ends whatever it waits for
    LiveStream(const LiveStream&) = delete;
    LiveStream& operator=(const LiveStream&) = delete;

    /// What of the pictures is made.
    void want(bool colour, bool levels);
    /// Why the last connection could not be made; empty: it could.
    [[nodiscard]] std::string trouble() const;
    /// When the last packet came, whether or not it made a picture; never: at the begin.
    [[nodiscard]] LiveInput::Clock::time_point heard() const { return heard_; }

  private:
    void run();
    [[nodiscard]] bool connect();
    void tell(std::string trouble);
    [[nodiscard]] bool rest(std::chrono::milliseconds time);

    const LiveName name_;
    const std::string shown_;
    const Take take_;
    const std::function<void()> refused_;
    LiveWants wants_{};
    std::atomic<LiveInput::Clock::time_point> heard_{};
    bool began_{false};  // the thread's: pictures came of this connection

    mutable std::mutex mutex_{};
    std::condition_variable leave_{};
    std::string trouble_{};

    std::thread thread_;
};

}  // namespace dibhr
