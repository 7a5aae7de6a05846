// The playback timeline: loops, jumps, speed and pauses, with time as an argument.
#include "core/video/playing/playback.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Time = Playback::Time;

namespace {

/// Flat frames at given times: frame n has level n + 1. `breaks_at`: this frame cannot be read.
class FlatMedia : public Media {
  public:
    explicit FlatMedia(std::vector<double> times, int breaks_at = -1, double frames_per_s = 10.0)
        : times_(std::move(times)), breaks_at_(breaks_at) {
        description_.frames = static_cast<std::int64_t>(times_.size());
        description_.frames_per_s = frames_per_s;
    }
    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override {
        if (position_ == times_.size()) return std::nullopt;
        if (static_cast<int>(position_) == breaks_at_)
            throw InputError("'clip' breaks off: record it again");
        RawFrame frame;
        frame.depth = {4, 4, 255.0, std::vector<float>(16, static_cast<float>(position_ + 1))};
        frame.media_s = times_[position_];
        frame.index = static_cast<std::int64_t>(position_++);
        frame.never_has_holes = true;
        return frame;
    }
    void seek(double media_s) override {
        position_ = 0;
        while (position_ + 1 < times_.size() && times_[position_ + 1] <= media_s + kTimeTolerance_s)
            ++position_;
    }

  protected:
    /// Passes over the next one, unless it is the last.
    bool pass(double earliest_s) {
        const bool passes = position_ + 1 < times_.size() && times_[position_] < earliest_s;
        if (passes) ++position_;
        return passes;
    }

  private:
    std::vector<double> times_;
    int breaks_at_;
    std::size_t position_{0};
    MediaDescription description_{};
};

/// A playback whose clock is moved by hand.
/// Time passes as a case says: to the reader, reading takes none.
struct Scene {
    explicit Scene(const std::vector<double>& times) {
        playback.open(std::make_unique<FrameReader>(std::make_unique<FlatMedia>(times), 0,
                                                    ReaderHeartbeats{}, [] { return Time{}; }),
                      now);
        settle();
    }
    /// As the player's thread: leaves past frames and decodes ahead until the window is full.
    void settle() {
        playback.advance(now);
        while (playback.needs_frame())
            if (playback.read_ahead(now)) playback.on_frame_read(now);
        playback.advance(now);
    }
    /// In small steps: the thread is never late.
    void pass(double seconds) {
        const Time until =
            now + std::chrono::round<Time::duration>(std::chrono::duration<double>(seconds));
        while (now < until) {
            now = std::min(now + std::chrono::milliseconds(10), until);
            settle();
        }
    }
    [[nodiscard]] double moment_s() const { return playback.window().clock.playback_s(now); }
    /// Position between frames, as a number: 2.25 is a quarter of the way from frame 2 to its
    /// follower.
    [[nodiscard]] double shown() const {
        const FrameWindow window = playback.window();
        const DepthBlend pair = window.at(moment_s());
        return static_cast<double>(pair.from->index) + pair.blend;
    }

    Time now{std::chrono::hours(1)};
    Playback playback{};
};

const std::vector<double> kTenths{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};

}  // namespace

TEST_CASE("a new media plays from its first frame, and the window is filled ahead", "[playback]") {
    const Scene scene(kTenths);
    CHECK(scene.playback.playing());
    CHECK_THAT(scene.shown(), WithinAbs(0.0, 1e-6));
    CHECK(scene.playback.window().count == FrameWindow::kFrames);
}

TEST_CASE("frames are shown at their own times, also uneven ones", "[playback]") {
    Scene scene({0.0, 0.1, 0.5, 0.55, 1.0});
    const auto [at_s, shown] = GENERATE(
        table<double, double>({{0.05, 0.5}, {0.3, 1.5}, {0.525, 2.5}, {0.55, 3.0}, {0.91, 3.8}}));
    scene.pass(at_s);
    CHECK_THAT(scene.shown(), WithinAbs(shown, 1e-6));
}

TEST_CASE("the pair around now and one more frame are always in the window", "[playback]") {
    Scene scene(kTenths);
    for (int k = 0; k < 300; ++k) {
        scene.pass(0.013);
        const FrameWindow window = scene.playback.window();
        REQUIRE(window.count >= 3);
        REQUIRE(window.frames[0].time_s <= scene.moment_s());
        REQUIRE(window.frames[1].time_s > scene.moment_s());
    }
}

TEST_CASE("in a loop time goes on and the last frame blends into the first, counted once a lap",
          "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.65);
    CHECK(scene.playback.window().discontinuity == 1);  // the opening
    scene.pass(0.1);
    const FrameWindow window = scene.playback.window();
    CHECK(window.discontinuity == 2);
    CHECK_THAT(scene.shown(), WithinAbs(7.5, 1e-6));
    CHECK(window.frames[1].index == 0);
    CHECK_THAT(window.frames[1].time_s, WithinAbs(0.8, 1e-9));
    scene.pass(0.1);
    CHECK_THAT(scene.shown(), WithinAbs(0.5, 1e-6));
    scene.pass(8.0);
    CHECK_THAT(scene.shown(), WithinAbs(0.5, 1e-5));
    CHECK(scene.playback.window().discontinuity == 12);  // ten laps more
}

TEST_CASE("without looping, playing ends on the last frame, and play begins again", "[playback]") {
    Scene scene(kTenths);
    scene.playback.set_looping(false);
    scene.pass(0.65);
    CHECK(scene.playback.playing());
    scene.pass(0.2);
    CHECK_FALSE(scene.playback.playing());
    CHECK_THAT(scene.shown(), WithinAbs(7.0, 1e-9));
    CHECK_THAT(scene.playback.window().clock.speed, WithinAbs(0.0, 0.0));
    scene.playback.play(scene.now);
    scene.settle();
    CHECK(scene.playback.playing());
    CHECK_THAT(scene.shown(), WithinAbs(0.0, 1e-6));
}

TEST_CASE("looping switched off near the end forgets the next lap, and on again goes on",
          "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.55);
    scene.playback.set_looping(false);
    scene.pass(1.0);
    CHECK_THAT(scene.shown(), WithinAbs(7.0, 1e-9));
    scene.playback.set_looping(true);
    scene.playback.play(scene.now);
    scene.settle();
    scene.pass(0.05);
    CHECK_THAT(scene.shown(), WithinAbs(7.5, 1e-6));
}

TEST_CASE("a part is played again and again, and its last frame blends into its first",
          "[playback]") {
    Scene scene(kTenths);
    scene.playback.set_part(MediaPart{0.2, 0.5});
    scene.pass(0.35);
    CHECK_THAT(scene.shown(), WithinAbs(3.5, 1e-6));
    CHECK(scene.playback.window().discontinuity == 1);  // the opening
    scene.pass(0.2);
    CHECK_THAT(scene.shown(), WithinAbs(5.5, 1e-6));
    CHECK(scene.playback.window().discontinuity == 2);
    CHECK(scene.playback.window().frames[1].index == 2);
    scene.pass(0.1);
    CHECK_THAT(scene.shown(), WithinAbs(2.5, 1e-6));
    scene.pass(4.0);
    CHECK_THAT(scene.shown(), WithinAbs(2.5, 1e-5));
    CHECK(scene.playback.window().discontinuity == 12);  // ten laps more
    scene.playback.set_part({});
    scene.pass(0.4);
    CHECK_THAT(scene.shown(), WithinAbs(6.5, 1e-5));
}

TEST_CASE("without looping, playing ends with the part, and play begins with it again",
          "[playback]") {
    Scene scene(kTenths);
    scene.playback.set_looping(false);
    scene.playback.set_part(MediaPart{0.2, 0.5});
    scene.pass(1.0);
    CHECK_FALSE(scene.playback.playing());
    CHECK_THAT(scene.shown(), WithinAbs(5.0, 1e-9));
    scene.playback.play(scene.now);
    scene.settle();
    CHECK(scene.playback.playing());
    CHECK_THAT(scene.shown(), WithinAbs(2.0, 1e-6));
}

TEST_CASE("playing has ended once its last frame is shown, wherever the part ends", "[playback]") {
    const double end_s = GENERATE(0.0, 0.05, 0.25, 0.3, 0.7, 5.0);
    CAPTURE(end_s);
    Scene scene(kTenths);
    scene.playback.set_looping(false);
    scene.playback.set_part(MediaPart{0.0, end_s});
    scene.settle();
    while (scene.playback.playing()) {
        REQUIRE_FALSE(scene.playback.ended());
        scene.pass(0.01);
    }
    CHECK(scene.playback.ended());
    scene.playback.play(scene.now);
    scene.settle();
    CHECK(scene.playback.ended() != scene.playback.playing());
}

TEST_CASE("neither a pause nor a loop is the end of playing", "[playback]") {
    Scene scene(kTenths);
    scene.pass(5.0);
    CHECK_FALSE(scene.playback.ended());
    scene.playback.set_looping(false);
    scene.playback.pause(scene.now);
    scene.settle();
    CHECK_FALSE(scene.playback.ended());
    scene.playback.seek(0.6, scene.now);
    scene.settle();
    CHECK_FALSE(scene.playback.ended());
}

TEST_CASE("sought beyond the part the media goes on to its own end, and begins as a whole",
          "[playback]") {
    Scene scene(kTenths);
    scene.playback.set_part(MediaPart{0.2, 0.4});
    scene.playback.seek(0.6, scene.now);
    scene.settle();
    scene.pass(0.25);
    CHECK_THAT(scene.shown(), WithinAbs(0.5, 1e-6));
    scene.pass(0.4);  // and from there on in it
    CHECK_THAT(scene.shown(), WithinAbs(4.5, 1e-6));
    scene.pass(0.1);
    CHECK_THAT(scene.shown(), WithinAbs(2.5, 1e-6));
}

TEST_CASE("a part without an end goes to the media's, and begins where it was set", "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.35);
    scene.playback.set_part(MediaPart{0.35, std::numeric_limits<double>::infinity()});
    scene.pass(0.45);
    CHECK_THAT(scene.shown(), WithinAbs(3.0, 1e-5));
}

TEST_CASE("a part whose end is set where it is begins again from there", "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.45);
    scene.playback.set_part(MediaPart{0.2, 0.45});
    scene.pass(0.1);
    CHECK_THAT(scene.shown(), WithinAbs(5.5, 1e-6));
    CHECK(scene.playback.window().frames[1].index == 2);
    scene.pass(0.3);
    CHECK_THAT(scene.shown(), WithinAbs(4.5, 1e-5));
    CHECK(scene.playback.window().frames[1].index == 2);
}

TEST_CASE("a part whose end has been passed when it is set begins again at once", "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.65);
    scene.playback.set_part(MediaPart{0.2, 0.4});
    scene.pass(0.1);
    CHECK_THAT(scene.shown(), WithinAbs(7.5, 1e-6));  // towards a frame that was there already
    CHECK(scene.playback.window().frames[1].index == 2);
    scene.pass(0.2);
    CHECK_THAT(scene.shown(), WithinAbs(3.5, 1e-5));
}

TEST_CASE("a part of one frame is held", "[playback]") {
    Scene scene(kTenths);
    scene.playback.set_part(MediaPart{0.3, 0.35});
    scene.playback.seek(0.3, scene.now);
    scene.settle();
    scene.pass(1.0);
    CHECK_THAT(scene.shown(), WithinAbs(3.0, 1e-6));
}

TEST_CASE("a pause keeps the moment exactly, and play goes on from it", "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.33);
    const double moment_s = scene.moment_s();
    scene.playback.pause(scene.now);
    scene.pass(5.0);
    CHECK_THAT(scene.moment_s(), WithinAbs(moment_s, 1e-12));
    CHECK_THAT(scene.playback.window().clock.speed, WithinAbs(0.0, 0.0));
    scene.playback.play(scene.now);
    CHECK_THAT(scene.moment_s(), WithinAbs(moment_s, 1e-12));
    scene.pass(0.02);
    CHECK_THAT(scene.shown(), WithinAbs(3.5, 1e-6));
}

TEST_CASE("a change of speed is no jump, and the speed stays between 0.1 and 4", "[playback]") {
    Scene scene(kTenths);
    const auto [asked, given] = GENERATE(
        table<double, double>({{2.0, 2.0}, {0.5, 0.5}, {9.0, 4.0}, {0.0, 0.1}, {-3.0, 0.1}}));
    scene.pass(0.15);
    const double moment_s = scene.moment_s();
    scene.playback.set_speed(asked, scene.now);
    CHECK_THAT(scene.moment_s(), WithinAbs(moment_s, 1e-9));
    scene.pass(0.02);
    CHECK_THAT(scene.moment_s(), WithinAbs(moment_s + 0.02 * given, 1e-7));
}

TEST_CASE("steps move by whole frames both ways, paused on exactly the frame's time",
          "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.33);
    const auto step = [&](int frames) {
        scene.playback.step(frames, scene.now);
        scene.settle();
        CHECK_FALSE(scene.playback.playing());
        CHECK_THAT(scene.moment_s(), WithinAbs(scene.playback.window().frames[0].time_s, 0.0));
        return scene.shown();
    };
    CHECK_THAT(step(1), WithinAbs(4.0, 0.0));
    CHECK_THAT(step(-1), WithinAbs(3.0, 0.0));
    CHECK_THAT(step(-2), WithinAbs(1.0, 0.0));
    CHECK_THAT(step(-5), WithinAbs(0.0, 0.0));
    CHECK_THAT(step(6), WithinAbs(6.0, 0.0));
    CHECK_THAT(step(6), WithinAbs(7.0, 0.0));
}

TEST_CASE("stepping back through a long film reaches every frame", "[playback]") {
    std::vector<double> times;
    for (int n = 0; n < 120; ++n) times.push_back(0.1 * n);
    Scene scene(times);
    scene.playback.seek(11.9, scene.now);
    for (int n = 118; n >= 0; --n) {
        scene.playback.step(-1, scene.now);
        scene.settle();
        REQUIRE_THAT(scene.shown(), WithinAbs(n, 0.0));
    }
}

TEST_CASE("a seek shows that frame at once and counts as a discontinuity", "[playback]") {
    Scene scene(kTenths);
    const bool paused = GENERATE(false, true);
    scene.pass(0.25);
    if (paused) scene.playback.pause(scene.now);
    const FrameWindow before = scene.playback.window();
    scene.playback.seek(0.52, scene.now);
    scene.settle();
    CHECK_THAT(scene.shown(), WithinAbs(5.0, 0.0));
    CHECK(scene.playback.window().discontinuity == before.discontinuity + 1);
    CHECK(scene.playback.playing() == !paused);
    CHECK(scene.moment_s() > before.clock.playback_s(scene.now));
}

TEST_CASE("a jump that takes long to read comes behind all that is shown meanwhile", "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.25);
    const FrameWindow before = scene.playback.window();
    REQUIRE(before.count > 2);
    const bool steps = GENERATE(false, true);
    if (steps)
        scene.playback.step(-1, scene.now);
    else
        scene.playback.seek(0.52, scene.now);
    const FrameWindow jumped = scene.playback.window();
    for (const int later_ms : {0, 50, 100, 300, 1000}) {
        CAPTURE(later_ms);
        const Time later = scene.now + std::chrono::milliseconds(later_ms);
        const Frame* const shown = before.at(before.clock.playback_s(later)).from;
        CHECK(shown->time_s < jumped.at(jumped.clock.playback_s(later)).from->time_s);
    }
}

TEST_CASE("no playback time ever means two frames, whatever is done", "[playback]") {
    Scene scene(kTenths);
    double newest_s = scene.moment_s();
    for (int k = 0; k < 200; ++k) {
        scene.pass(0.03);
        REQUIRE(scene.moment_s() >= newest_s);
        newest_s = scene.moment_s();
        if (k % 7 == 3) scene.playback.seek(0.1 * (k % 9), scene.now);
        if (k % 11 == 5) scene.playback.step(k % 2 == 0 ? 1 : -1, scene.now);
        if (k % 11 == 8) scene.playback.play(scene.now);
    }
}

TEST_CASE("when decoding falls behind the surface is held, and meets the clock without a leap",
          "[playback]") {
    Scene scene(kTenths);
    // The thread was away for 0.6 s: the window ends with frame 3.
    scene.now += std::chrono::milliseconds(650);
    CHECK_THAT(scene.shown(), WithinAbs(3.0, 1e-9));
    scene.settle();
    CHECK_THAT(scene.shown(), WithinAbs(3.0, 1e-6));
    scene.pass(0.025);
    CHECK_THAT(scene.shown(), WithinAbs(3.5, 1e-6));  // half the way to frame 7
    scene.pass(0.03);
    CHECK(scene.playback.window().frames[0].index == 7);
    CHECK_THAT(scene.playback.window().frames[0].time_s, WithinAbs(0.7, 1e-9));
    CHECK(scene.playback.shown_per_s() < 9.0);
    CHECK_FALSE(scene.playback.falls_behind());
}

TEST_CASE("a machine too slow for all frames shows as many as it can, in their time",
          "[playback]") {
    std::vector<double> times;
    for (int n = 0; n < 300; ++n) times.push_back(0.1 * n);
    Scene scene(times);
    // Else steps are left out, and the surface does not move between two cleanings.
    scene.playback.set_cleaning({.preset = CleaningPreset::raw});
    const Time begin = scene.now;
    for (int k = 0; k < 80; ++k) {
        const bool reads = scene.playback.needs_frame();
        if (reads) REQUIRE(scene.playback.read_ahead(scene.now));
        scene.now += std::chrono::milliseconds(250);  // 2.5 intervals
        if (reads) scene.playback.on_frame_read(scene.now);
        scene.playback.advance(scene.now);
        const double passed_s = std::chrono::duration<double>(scene.now - begin).count();
        if (k < 10) continue;
        const FrameWindow window = scene.playback.window();
        const DepthBlend pair = window.at(scene.moment_s());
        const double media_s =
            pair.from->media_s + pair.blend * (pair.to->media_s - pair.from->media_s);
        REQUIRE_THAT(media_s, WithinAbs(passed_s, 0.15));
    }
    CHECK_THAT(scene.playback.shown_per_s(), WithinAbs(4.0, 1.0));
    CHECK_FALSE(scene.playback.falls_behind());
}

namespace {

using Seconds = std::chrono::duration<double>;

/// What a frame takes of a machine.
struct Work {
    double decoding_s{0.0};    ///< also where it is passed over
    double conversion_s{0.0};  ///< beyond that, on the thread that decodes
    double waiting_s{0.0};     ///< of the one that reads, for that
    double cleaning_s{0.0};    ///< and after it
};

/// A thousand frames, a hundred a second, of a machine that takes as long as it is told to.
class WorkingMedia : public FlatMedia {
  public:
    struct Done {
        std::atomic<int> made{0};
        std::atomic<std::chrono::nanoseconds> worked{std::chrono::nanoseconds{0}};
    };
    WorkingMedia(const Work& work, Done& done)
        : FlatMedia(hundredths(), -1, kFrames_per_s), work_(work), done_(done) {}

    std::optional<RawFrame> next() override { return next_from(0.0); }
    std::optional<RawFrame> next_from(double earliest_s) override {
        while (pass(earliest_s)) take(work_.decoding_s);
        take(work_.decoding_s + work_.conversion_s);
        std::optional<RawFrame> frame = FlatMedia::next();
        if (frame) frame->skipping_s = work_.decoding_s;
        ++done_.made;
        return frame;
    }

    static constexpr double kFrames_per_s = 100.0;

  private:
    [[nodiscard]] static std::vector<double> hundredths() {
        std::vector<double> times;
        for (int n = 0; n < 1000; ++n) times.push_back(n / kFrames_per_s);
        return times;
    }
    void take(double seconds) {
        done_.worked =
            done_.worked.load() + std::chrono::round<std::chrono::nanoseconds>(Seconds(seconds));
    }

    Work work_;
    Done& done_;
};

/// The frames that began to be shown in a while.
struct Arrivals {
    double while_s{0.0};
    int frames{0};
    double longest_s{0.0};  ///< from one to the next

    [[nodiscard]] double per_s() const { return frames / while_s; }
};

constexpr unsigned kManyProcessors = 8;

/// Plays on such a machine, whose time goes on with its work.
class WorkingScene {
  public:
    explicit WorkingScene(const Work& work) : work_(work) {
        playback.open(std::make_unique<FrameReader>(std::make_unique<WorkingMedia>(work, done), 0,
                                                    ReaderHeartbeats{}, [this] { return time(); }),
                      now);
    }
    /// Reads a frame, if one is wanted; else a millisecond passes.
    void go_on() {
        playback.advance(now);
        if (!playback.needs_frame()) return pass(0.001);
        looks_ = 0;
        REQUIRE(playback.read_ahead(now));
        pass(work_.waiting_s + work_.cleaning_s);
        playback.on_frame_read(now);
        ++shown;
    }
    void go_on_until(double played_s) {
        while (this->played_s() < played_s) go_on();
    }
    Arrivals arrivals_until(double played_s) {
        Arrivals arrivals{.while_s = played_s - this->played_s()};
        double last_s = this->played_s();
        double shown_s = media_s();
        while (this->played_s() < played_s) {
            go_on();
            playback.advance(now);
            if (media_s() == shown_s) continue;
            shown_s = media_s();
            ++arrivals.frames;
            arrivals.longest_s = std::max(arrivals.longest_s, this->played_s() - last_s);
            last_s = this->played_s();
        }
        return arrivals;
    }
    void pass(double seconds) { now += of(seconds); }
    [[nodiscard]] double played_s() const { return Seconds(now - kBegin).count(); }
    [[nodiscard]] double media_s() const { return playback.window().frames[0].media_s; }
    [[nodiscard]] std::int64_t newest() const {
        const FrameWindow window = playback.window();
        return window.frames[window.count - 1].index;
    }

    static constexpr Time kBegin{std::chrono::hours(1)};
    WorkingMedia::Done done{};
    Time now{kBegin};
    int shown{0};                        ///< or ready to be
    Playback playback{kManyProcessors};  // decoding takes no time from cleaning

  private:
    [[nodiscard]] static Time::duration of(double seconds) {
        return std::chrono::round<Time::duration>(Seconds(seconds));
    }
    /// Who decodes has worked so long. Who reads looks when it begins to wait, and again.
    [[nodiscard]] Time time() {
        if (std::this_thread::get_id() != reader_) return kBegin + done.worked.load();
        return ++looks_ > 1 ? now + of(work_.waiting_s) : now;
    }

    Work work_;
    std::thread::id reader_{std::this_thread::get_id()};
    int looks_{0};
};

}  // namespace

TEST_CASE("frames shown per second never fall while the speed rises, and none comes in a burst",
          "[playback]") {
    const Work work =
        GENERATE(Work{.decoding_s = 0.006, .waiting_s = 0.006, .cleaning_s = 0.012},
                 Work{.decoding_s = 0.002, .conversion_s = 0.018, .cleaning_s = 0.001},
                 Work{.decoding_s = 0.0003, .conversion_s = 0.004, .cleaning_s = 0.030},
                 Work{.decoding_s = 0.020, .waiting_s = 0.020, .cleaning_s = 0.001});
    CAPTURE(work.decoding_s, work.conversion_s, work.cleaning_s);
    double most_per_s = 0.0;
    for (const double speed : {0.5, 0.65, 0.8, 1.0, 1.5}) {
        CAPTURE(speed);
        WorkingScene scene(work);
        scene.playback.set_speed(speed, scene.now);
        scene.go_on_until(1.0);
        const Arrivals arrivals = scene.arrivals_until(4.0);
        CHECK(arrivals.per_s() >= (1.0 - kMostLost - 0.02) * most_per_s);
        most_per_s = std::max(most_per_s, arrivals.per_s());
        CHECK(arrivals.longest_s * arrivals.per_s() < 3.0);
    }
}

TEST_CASE("while frames are late the window draws less often and the panel says so; not at rest",
          "[playback]") {
    WorkingScene scene({.decoding_s = 0.020, .waiting_s = 0.020, .cleaning_s = 0.001});
    scene.playback.set_drawing_cost({.picture_s = 0.02, .share = 0.3});
    CHECK(scene.playback.most_pictures_per_s() == 0.0);
    scene.go_on_until(2.0);
    CHECK(scene.playback.most_pictures_per_s() >= 10.0);
    CHECK_THAT(scene.playback.dropped_in_words(), Contains("The window draws 10 coarse pictures"));
    scene.playback.pause(scene.now);
    CHECK(scene.playback.most_pictures_per_s() == 0.0);
    scene.playback.play(scene.now);
    scene.playback.set_speed(0.2, scene.now);
    scene.go_on_until(6.0);
    CHECK(scene.playback.most_pictures_per_s() == 0.0);
    CHECK(scene.playback.dropped_in_words().empty());
}

TEST_CASE("a standstill costs no frames after it, and the time is met again", "[playback]") {
    WorkingScene scene({.decoding_s = 0.0003, .conversion_s = 0.004, .cleaning_s = 0.030});
    scene.go_on_until(1.0);
    const double per_s = scene.arrivals_until(3.0).per_s();
    scene.pass(0.4);
    scene.go_on_until(scene.played_s() + 0.2);
    CHECK_THAT(scene.arrivals_until(scene.played_s() + 2.0).per_s(), WithinAbs(per_s, 2.0));
    CHECK_THAT(scene.media_s(), WithinAbs(scene.played_s(), 0.1));
    CHECK_FALSE(scene.playback.falls_behind());
}

TEST_CASE("what is waited for is not taken for what cleaning takes", "[playback]") {
    WorkingScene scene({.decoding_s = 0.001, .waiting_s = 0.008, .cleaning_s = 0.001});
    scene.go_on_until(4.0);
    CHECK(scene.newest() == scene.shown);  // there is time for all
    CHECK_THAT(scene.media_s(), WithinAbs(scene.played_s(), 0.1));
}

TEST_CASE("where decoding is too slow every frame is shown, and the clock waits", "[playback]") {
    WorkingScene scene({.decoding_s = 0.020, .waiting_s = 0.020});
    scene.go_on_until(6.0);
    CHECK(scene.playback.falls_behind());
    CHECK(scene.newest() == scene.shown);
    CHECK(scene.media_s() < 0.6 * scene.played_s());
}

TEST_CASE("where frames are slow to make and not to decode the time is kept", "[playback]") {
    WorkingScene scene({.decoding_s = 0.0002, .conversion_s = 0.0218, .cleaning_s = 0.001});
    scene.go_on_until(6.0);
    CHECK_FALSE(scene.playback.falls_behind());
    CHECK_THAT(scene.media_s(), WithinAbs(scene.played_s(), 0.1));
    CHECK(scene.shown > 6 * 40);                  // each takes 22 ms
    CHECK(scene.shown > 0.65 * scene.done.made);  // few of them come too late
    CHECK_FALSE(scene.playback.dropped_in_words().empty());
}

TEST_CASE("steps that a slow machine leaves out come back at rest; no surface blends two cleanings",
          "[playback]") {
    WorkingScene scene({.decoding_s = 0.0002, .conversion_s = 0.004, .cleaning_s = 0.030});
    const CleaningSteps whole = scene.playback.window().frames[0].cleaning.steps;
    REQUIRE(whole.sharpen_silhouettes);
    const auto steps_shown = [&scene] {
        const FrameWindow window = scene.playback.window();
        for (std::size_t k = 1; k < window.count; ++k)
            REQUIRE(window.frames[k].cleaning == window.frames[0].cleaning);
        return window.frames[0].cleaning.steps;
    };
    const std::uint64_t before = scene.playback.window().discontinuity;
    CleaningSteps last = whole;
    std::uint64_t changes = 0;
    while (scene.played_s() < 4.0) {
        scene.go_on();
        changes += !(steps_shown() == last);
        last = steps_shown();
    }
    CHECK(last == degraded(whole, kDegradationLevels - 1));
    CHECK(scene.playback.window().discontinuity == before + changes);
    CHECK_THAT(scene.media_s(), WithinAbs(scene.played_s(), 0.1));  // the clock has not waited
    CHECK_THAT(scene.playback.dropped_in_words(),
               Contains("leaves out sharp silhouettes, smooth outlines, "));
    const double media_s = scene.media_s();
    scene.playback.pause(scene.now);
    CHECK(steps_shown() == whole);
    CHECK_THAT(scene.media_s(), WithinAbs(media_s, 0.02));
    CHECK_THAT(scene.playback.dropped_in_words(), !Contains("leaves out"));
    scene.playback.play(scene.now);
    while (steps_shown() == whole) scene.go_on();
    CHECK(scene.media_s() < media_s + 0.2);
    scene.playback.set_cleaning({.preset = CleaningPreset::sensor});
    CHECK(steps_shown() == kSensorSteps);
    scene.playback.set_cleaning({.preset = CleaningPreset::gentle});
    scene.go_on_until(scene.played_s() + 4.0);
    CHECK(steps_shown() == kGentleSteps);
}

TEST_CASE("a change of cleaning shows at once, also when paused", "[playback]") {
    Scene scene(kTenths);
    scene.pass(0.25);
    scene.playback.pause(scene.now);
    const FrameWindow before = scene.playback.window();
    scene.playback.set_cleaning({.preset = CleaningPreset::raw});
    const FrameWindow after = scene.playback.window();
    REQUIRE(after.count == before.count);
    CHECK(after.discontinuity == before.discontinuity + 1);
    for (std::size_t k = 0; k < after.count; ++k) {
        CHECK(after.frames[k].depth != before.frames[k].depth);
        CHECK(after.frames[k].index == before.frames[k].index);
        CHECK_THAT(after.frames[k].time_s, WithinAbs(before.frames[k].time_s, 0.0));
    }
}

TEST_CASE("every frame says which media it is of and how it was cleaned; a window never mixes them",
          "[playback]") {
    Scene scene(kTenths);
    CHECK(scene.playback.window().frames[0].media == 0);
    scene.playback.open(std::make_unique<FrameReader>(std::make_unique<FlatMedia>(kTenths), 7),
                        scene.now);
    for (int k = 0; k < 40; ++k) {
        const CleaningOptions cleaning{.preset = CleaningPreset::own,
                                       .own = {.fill_holes = k % 2 == 0, .steady = k % 3 == 0}};
        scene.playback.set_cleaning(cleaning);
        if (k % 5 == 0) scene.playback.seek(0.1 * (k % 7), scene.now);
        for (int ticks = 0; ticks < 3; ++ticks) {
            scene.pass(0.07);
            const FrameWindow window = scene.playback.window();
            for (std::size_t n = 0; n < window.count; ++n) {
                REQUIRE(window.frames[n].media == 7);
                REQUIRE(window.frames[n].cleaning.steps == cleaning.own);
            }
        }
    }
}

TEST_CASE("one frame is held: nothing plays", "[playback]") {
    Scene scene({0.0});
    CHECK_FALSE(scene.playback.playing());
    CHECK(scene.playback.window().count == 1);
    scene.playback.play(scene.now);
    scene.playback.step(1, scene.now);
    scene.pass(1.0);
    CHECK_THAT(scene.shown(), WithinAbs(0.0, 0.0));
    CHECK_FALSE(scene.playback.playing());
}

TEST_CASE("a media without a frame is refused and the one before plays on", "[playback]") {
    Scene scene(kTenths);
    CHECK_THROWS_AS(scene.playback.open(std::make_unique<FrameReader>(
                                            std::make_unique<FlatMedia>(std::vector<double>{})),
                                        scene.now),
                    InputError);
    scene.pass(0.1);
    CHECK_THAT(scene.shown(), WithinAbs(1.0, 1e-6));
}

TEST_CASE("a file that breaks off plays what is there, and stops", "[playback]") {
    Playback playback;
    Time now{};
    playback.open(std::make_unique<FrameReader>(std::make_unique<FlatMedia>(kTenths, 3)), now);
    CHECK(playback.read_ahead(now));
    CHECK(playback.read_ahead(now));
    CHECK_THROWS_AS(playback.read_ahead(now), InputError);
    playback.end_here();
    CHECK_FALSE(playback.needs_frame());
    playback.advance(now + std::chrono::seconds(1));
    CHECK_FALSE(playback.playing());
    CHECK(playback.window().frames[0].index == 2);
}
