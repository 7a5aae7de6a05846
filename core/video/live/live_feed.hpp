// What is live, joined: each depth picture with the colour that is nearest in time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/realtime/now.hpp"
#include "core/video/live/live_join.hpp"
#include "core/video/live/live_stream.hpp"

namespace dibhr {

/// How it stands with what is sent.
struct LiveSignal {
    std::chrono::steady_clock::time_point
        last{};              ///< when a depth picture came; never: at the begin
    bool other_form{false};  ///< pictures of another size or kind came: it is to be opened again
    std::string trouble{};   ///< why it cannot be opened again; empty: it is open, or not yet tried
    bool refused{false};     ///< trouble that nobody need wait for: it would be the same again
    bool heard{false};       ///< packets come, whether or not they make pictures
};

/// One or two connections. Keeps the newest pairs, so that any number of readers take what they
/// have not had yet; every call may come from any thread.
class LiveFeed {
  public:
    using Clock = std::chrono::steady_clock;

    /// `colour` empty, or the depth's: one connection. `now` is what its waiting is measured by.
    /// Throws InputError for what names nothing live.
    LiveFeed(std::filesystem::path colour, std::filesystem::path depth, Now now = Clock::now);
    ~LiveFeed();
    LiveFeed(const LiveFeed&) = delete;
    LiveFeed& operator=(const LiveFeed&) = delete;

    [[nodiscard]] const std::filesystem::path& colour() const noexcept { return colour_; }
    [[nodiscard]] const std::filesystem::path& depth() const noexcept { return depth_; }
    [[nodiscard]] bool is_of(const std::filesystem::path& colour,
                             const std::filesystem::path& depth) const;

    /// Of one connection: whether its colours, and its levels, are looked at.
    void want(bool colour, bool levels);

    /// The newest pair after that number; waits until then. Null: none came, or none will.
    [[nodiscard]] std::shared_ptr<const LivePair> after(std::uint64_t number,
                                                        Clock::time_point latest);
    /// When a picture that waits for its colour goes without; nothing: none waits.
    [[nodiscard]] std::optional<Clock::time_point> due() const;
    [[nodiscard]] LiveSignal signal() const;
    /// Called with every pair, on any thread, by nobody any more once another one is set; empty:
    /// none.
    void tell(std::function<void()> news);

  private:
    enum class Role { colour, depth };
    bool take(LivePicture picture, Role role);
    void heard_depth(Clock::time_point now);
    void take_refusal();
    /// What pictures of one connection have in common.
    struct Form {
        cv::Size size{};
        int bits{8};
        bool grey{false};

        bool operator==(const Form&) const = default;
    };
    [[nodiscard]] bool is_of_form(const LivePicture& picture, std::optional<Form>& first);
    void join(Clock::time_point now);
    void hand_out(LivePair pair);

    const std::filesystem::path colour_, depth_;
    const bool two_;
    const Now now_;

    mutable std::mutex mutex_{};
    std::condition_variable came_{};
    LiveJoin join_{};
    double interval_s_{1.0 / 30.0};  ///< between depth pictures, as of late
    std::shared_ptr<const LivePair> newest_{};
    std::optional<Form> depth_form_{}, colour_form_{};  ///< of the first pictures
    LiveSignal signal_{};

    std::mutex telling_{};
    std::function<void()> news_{};

    std::unique_ptr<LiveStream> depth_stream_{}, colour_stream_{};  // last: they use all of it
};

}  // namespace dibhr
