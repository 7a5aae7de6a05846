// Where the USB thread writes the status and the window reads it.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "device/falcon/status.hpp"

namespace dibhr::falcon {

class StatusBoard {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Any thread but the haptic one.
    [[nodiscard]] Status read() const;

    // The USB thread alone:

    /// The status to come.
    [[nodiscard]] Status& draft() noexcept { return draft_; }
    void publish();
    /// At most 50 times a second; never waits.
    void publish_if_due(Time now);
    /// A new stage, published at once.
    void enter(Stage stage, std::string sentence, bool trouble = false);

  private:
    Status draft_{};
    Time published_at_{};
    mutable std::mutex mutex_{};
    Status published_{};  // guarded by mutex_
};

}  // namespace dibhr::falcon
