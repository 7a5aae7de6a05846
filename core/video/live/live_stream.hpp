// Something live, read on a thread of its own, and opened again whenever it breaks off; inside the
// room.
#pragma once

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

    LiveStream(LiveName name, std::string shown, Take take);
    ~LiveStream();  ///< ends whatever it waits for
    LiveStream(const LiveStream&) = delete;
    LiveStream& operator=(const LiveStream&) = delete;

    /// What of the pictures is made.
    void want(bool colour, bool levels);
    /// Why the last connection could not be made; empty: it could.
    [[nodiscard]] std::string trouble() const;

  private:
    void run();
    [[nodiscard]] bool connect();
    [[nodiscard]] bool rest(std::chrono::milliseconds time);

    const LiveName name_;
    const std::string shown_;
    const Take take_;
    LiveWants wants_{};
    bool began_{false};  // the thread's: pictures came of this connection

    mutable std::mutex mutex_{};
    std::condition_variable leave_{};
    std::string trouble_{};

    std::thread thread_;
};

}  // namespace dibhr
