// A live source: joins each depth picture with the colour picture nearest in time.
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

/// The state of the connections.
struct LiveSignal {
    std::chrono::steady_clock::time_point
        last{};                   ///< arrival of the last depth picture; default: none yet
    bool format_changed{false};   ///< pictures changed size or kind: open the source again
    std::string trouble{};        ///< why it cannot be opened; empty: open, or not yet tried
    bool permanent_error{false};  ///< the trouble is permanent: waiting does not help
    bool packet_received{false};  ///< packets arrive, with or without whole pictures
};

/// One or two connections. Keeps the newest pair, so that any number of readers can take it. Every
/// method may be called by any thread.
class LiveFeed {
  public:
    using Clock = std::chrono::steady_clock;

    /// `colour` empty or equal to `depth`: one connection. `now` is the clock that measures waits.
    /// Throws InputError for a name that is not of a live source.
    LiveFeed(std::filesystem::path colour, std::filesystem::path depth, Now now = Clock::now);
    ~LiveFeed();
    LiveFeed(const LiveFeed&) = delete;
    LiveFeed& operator=(const LiveFeed&) = delete;

    [[nodiscard]] const std::filesystem::path& colour() const noexcept { return colour_; }
    [[nodiscard]] const std::filesystem::path& depth() const noexcept { return depth_; }
    [[nodiscard]] bool is_of(const std::filesystem::path& colour,
                             const std::filesystem::path& depth) const;

    /// Of the depth's connection: whether it makes colour pictures, and levels.
    void set_outputs(bool colour, bool levels);

    /// The newest pair after that number; waits until `latest`. Null: none arrived, or none will.
    [[nodiscard]] std::shared_ptr<const LivePair> after(std::uint64_t number,
                                                        Clock::time_point latest);
    /// When the waiting depth picture stops waiting for its colour; nothing: none waits.
    [[nodiscard]] std::optional<Clock::time_point> due() const;
    [[nodiscard]] LiveSignal signal() const;
    /// A function to be called for every pair, on any thread. When this returns, the one set before
    /// is no longer called. Empty: none.
    void set_listener(std::function<void()> listener);

  private:
    enum class Role { colour, depth };
    bool take(LivePicture picture, Role role);
    void update_signal(Clock::time_point now);
    void take_permanent_error();
    /// What all pictures of one connection must have in common.
    struct Form {
        cv::Size size{};
        int bits{8};
        bool grey{false};

        bool operator==(const Form&) const = default;
    };
    [[nodiscard]] bool has_first_format(const LivePicture& picture, std::optional<Form>& first);
    void join(Clock::time_point now);
    void publish(LivePair pair);

    const std::filesystem::path colour_, depth_;
    const bool two_streams_;
    const Now now_;

    mutable std::mutex mutex_{};
    std::condition_variable changed_{};
    LiveJoin join_{};
    double interval_s_{1.0 / 30.0};  ///< mean time between depth pictures
    std::shared_ptr<const LivePair> newest_{};
    std::optional<Form> depth_form_{}, colour_form_{};  ///< of the first pictures
    LiveSignal signal_{};

    std::mutex listener_mutex_{};
    std::function<void()> listener_{};

    std::unique_ptr<LiveStream> depth_stream_{}, colour_stream_{};  // last: they use all
};

}  // namespace dibhr
