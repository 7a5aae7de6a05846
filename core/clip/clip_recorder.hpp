// Makes a clip on a thread of its own, from pictures that another thread hands over.
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
    ClipRecorder(const std::filesystem::path& file, ClipName name);
    /// Waits for the picture that is being encoded. Of a clip that was not stopped nothing remains.
    ~ClipRecorder();
    ClipRecorder(const ClipRecorder&) = delete;
    ClipRecorder& operator=(const ClipRecorder&) = delete;

    /// False: it is behind, or over, and would drop a picture. So nobody needs to make one.
    [[nodiscard]] bool wants_picture() const;
    /// Never waits for the disk or the encoder. The first picture begins the clip.
    void add(ColourImage picture, Clock::time_point shown);
    /// No more pictures come; the file is finished meanwhile.
    void stop(Clock::time_point end, ClipEnd how);

    /// The clip is whole, or broke off; it may break off before it is stopped, too.
    [[nodiscard]] bool done() const;
    /// Waits at most so long for that. Until then it must not be destroyed by who cannot wait.
    [[nodiscard]] bool done_within(std::chrono::milliseconds patience) const;
    /// Waits for that. The name that the file has; once. Throws InputError when it broke off.
    std::filesystem::path result() { return result_.get(); }

    [[nodiscard]] std::uint64_t encoded() const;
    /// Whether what is written so far plays: on a busy machine the encoder lags seconds behind.
    [[nodiscard]] bool plays() const;
    /// Where the clip is written until it is whole; plays up to a second before the last picture
    /// that was encoded.
    [[nodiscard]] const std::filesystem::path& written() const noexcept { return file_.written(); }

  private:
    struct Shown {
        ColourImage picture{};
        Clock::time_point at{};
    };
    /// A few pictures: a machine that falls behind does so for good.
    static constexpr std::size_t kMostWaiting = 4;

    std::filesystem::path work();

    ClipFile file_;
    mutable std::mutex mutex_{};  // for what follows
    std::condition_variable news_{};
    std::deque<Shown> waiting_{};
    bool stopped_{false};
    bool given_up_{false};
    Clock::time_point end_{};
    ClipEnd how_{ClipEnd::well};
    std::uint64_t encoded_{0};
    bool plays_{false};
    std::future<std::filesystem::path> result_;  // last: its thread uses all of these
};

}  // namespace dibhr
