// Makes a clip on its own thread, from pictures of another thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <future>
#include <mutex>

#include "core/clip/clip_file.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

class ClipRecorder {
  public:
    using Clock = std::chrono::steady_clock;

    /// Throws InputError when the file cannot be made.
    ClipRecorder(const std::filesystem::path& file, ClipNameConflict name);
    /// Waits for the picture that is being encoded. Removes a clip that was not stopped.
    ~ClipRecorder();
    ClipRecorder(const ClipRecorder&) = delete;
    ClipRecorder& operator=(const ClipRecorder&) = delete;

    /// False: the encoder is behind, or the clip has ended, so that a picture would be dropped.
    [[nodiscard]] bool wants_picture() const;
    /// Never waits for the disk or the encoder. The first picture begins the clip.
    void add(ColourImage picture, Clock::time_point shown);
    /// Ends the pictures; the thread finishes the file.
    void stop(Clock::time_point end, ClipEnd how);

    /// The clip is whole, or failed; it may also fail before stop().
    [[nodiscard]] bool done() const;
    /// Waits at most so long for that. Before it is done, the destructor may wait.
    [[nodiscard]] bool done_within(std::chrono::milliseconds timeout) const;
    /// Waits for that. Returns the file's name; call it once. Throws InputError when it failed.
    std::filesystem::path result() { return result_.get(); }

    [[nodiscard]] std::uint64_t encoded() const;
    /// Whether what is written so far plays: on a busy machine the encoder lags seconds behind.
    [[nodiscard]] bool plays() const;
    /// The file that is written until the clip is whole; it plays up to a second before the last
    /// encoded picture.
    [[nodiscard]] const std::filesystem::path& written() const noexcept { return file_.written(); }

  private:
    struct Shown {
        ColourImage picture{};
        Clock::time_point at{};
    };
    /// Only a few pictures: a machine that falls behind does not catch up.
    static constexpr std::size_t kMostWaiting = 4;

    std::filesystem::path work();

    ClipFile file_;
    mutable std::mutex mutex_{};  // for all members below
    std::condition_variable wake_{};
    std::deque<Shown> waiting_{};
    bool stopped_{false};
    bool given_up_{false};
    Clock::time_point end_{};
    ClipEnd how_{ClipEnd::indexed};
    std::uint64_t encoded_{0};
    bool plays_{false};
    std::future<std::filesystem::path> result_;  // last: its thread uses all of these
};

}  // namespace dibhr
