// What the tests of live depth share: what they ask for, and what a hand feels of it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/video/frames/frame_window.hpp"
#include "core/video/live/live_feed.hpp"
#include "core/video/playing/live_playback.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/live/senders.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::test {

using LiveTime = std::chrono::steady_clock::time_point;

constexpr double kLiveInterval_s = 1.0 / 30.0;

/// Levels as they are sent, of which `highest` is the highest.
inline DepthRequest as_sent(double highest = 65535.0) {
    DepthRequest request{.find_out = true};
    request.command_line.unit = DepthUnit::levels;
    request.command_line.near = NearLevels::bright;
    request.command_line.range = DepthRange{highest, 0.0};
    request.command_line.no_data = std::vector<double>{};
    request.command_line.packing = DepthPacking::separate;
    return request;
}

/// One level all over, that frame k says.
inline PictureSender::Asked flat(std::function<int(int k)> level) {
    PictureSender::Asked asked;
    asked.level = [level = std::move(level)](int k, int, int) {
        return static_cast<std::uint16_t>(level(k));
    };
    return asked;
}

/// Dark and bright for ten frames each.
inline PictureSender::Asked flashing() {
    return flat([](int k) { return k % 20 >= 10 ? 40000 : 10000; });
}

/// As the haptic loop reads it.
inline std::optional<double> felt_level(const FrameWindow& window, LiveTime now) {
    const DepthBlend blend = window.at(window.clock.playback_s(now));
    if (!blend.makes_surface()) return std::nullopt;
    const double from = static_cast<double>(blend.from->depth->at(80, 60));
    const double to = static_cast<double>(blend.to->depth->at(80, 60));
    return from + blend.blend * (to - from);
}

inline LiveTime after_s(LiveTime time, double seconds) {
    return time + std::chrono::round<LiveTime::duration>(std::chrono::duration<double>(seconds));
}

/// What is live, shown by a time that the test moves: pictures are sent one by one, and taken at
/// the time that the test says.
class LiveBench {
  public:
    explicit LiveBench(const PictureSender::Asked& asked) : sender_(port_, asked) {
        DepthRequest request = as_sent();
        const auto time = [this] { return by_hand_ ? now() : std::chrono::steady_clock::now(); };
        request.live = std::make_shared<LiveFeed>("", PictureSender::url(port_), time);
        feed_ = request.live;
        auto media = open_media(PictureSender::url(port_), {}, request);
        sender_.stop();
        by_hand_ = true;
        playback.set_cleaning({.preset = CleaningPreset::raw}, now());
        playback.open(std::move(media), 1, nullptr, [] {});
    }

    /// The next picture is sent, comes and is taken at that time; its number.
    int send_at(LiveTime time) {
        now_ = time;
        const int sent = sender_.send();
        std::uint64_t number = 0;
        for (double came_s = -1.0; came_s < (sent - 0.5) * kLiveInterval_s;) {
            const auto pair = feed_->after(number, now() + std::chrono::seconds(60));
            REQUIRE(pair);
            number = pair->number;
            came_s = pair->depth.stamp_s;
        }
        playback.take(time);
        return sent;
    }
    /// Takes what there is, and lets go what has passed; whether anything changed.
    bool take_at(LiveTime time) {
        now_ = time;
        return playback.take(time);
    }
    [[nodiscard]] std::optional<double> felt() const { return felt_level(playback.window(), now_); }
    [[nodiscard]] LiveTime now() const { return now_; }

  private:
    std::atomic<bool> by_hand_{false};
    /// Ahead of the machine's: who waits by it waits until it is called.
    std::atomic<LiveTime> now_{std::chrono::steady_clock::now() + std::chrono::hours(1)};

  public:
    LivePlayback playback{[this] { return now(); }};

  private:
    int port_{free_port()};
    PictureSender sender_;
    std::shared_ptr<LiveFeed> feed_{};
};

}  // namespace dibhr::test
