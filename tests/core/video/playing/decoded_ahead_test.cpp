// Decoding on a thread of its own: nobody who reads can tell.
#include "core/video/playing/decoded_ahead.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/video/playing/frame_plan.hpp"
#include "tests/core/realtime/blocked_thread.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using dibhr::test::comes_to_wait_in;
using dibhr::test::eventually;

namespace {

/// What becomes of a media, and how far it may go.
struct Log {
    std::atomic<int> decoded{0};
    std::atomic<int> passed{0};
    std::atomic<int> jumps{0};
    std::atomic<int> may_decode{std::numeric_limits<int>::max()};  ///< in all; then it waits

    void allow_one_more() {
        ++may_decode;
        may_decode.notify_one();
    }
};

/// Small frames, a tenth of a second apart; `breaks_at` cannot be read.
class LoggedMedia : public Media {
  public:
    LoggedMedia(int frames, std::shared_ptr<Log> log, int breaks_at = -1)
        : frames_(frames), breaks_at_(breaks_at), log_(std::move(log)) {}

    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override {
        if (position_ == breaks_at_) throw InputError("'clip' breaks off: record it again");
        if (position_ == frames_) {
            description_.frames_exact = true;
            return std::nullopt;
        }
        while (log_->decoded >= log_->may_decode) log_->may_decode.wait(log_->decoded);
        ++log_->decoded;
        RawFrame frame;
        frame.depth = {2, 2, 255.0, std::vector<float>(4, static_cast<float>(position_))};
        frame.media_s = 0.1 * position_;
        frame.index = position_++;
        return frame;
    }
    std::optional<RawFrame> next_from(double earliest_s) override {
        for (; position_ < frames_ - 1 && 0.1 * position_ < earliest_s; ++position_) ++log_->passed;
        return next();
    }
    void seek(double media_s) override {
        ++log_->jumps;
        position_ = static_cast<int>(media_s * 10.0 + 0.5);
    }

  private:
    int frames_;
    int breaks_at_;
    std::shared_ptr<Log> log_;
    int position_{0};
    MediaDescription description_{};
};

/// A media that is decoded ahead, and whom to listen to.
struct Decoding {
    explicit Decoding(int frames = 100, int breaks_at = -1)
        : media(std::make_unique<LoggedMedia>(frames, log, breaks_at), {&decoder, &reader}) {
        reader.beat();
    }
    ~Decoding() {
        log->may_decode = std::numeric_limits<int>::max();
        log->may_decode.notify_one();
    }
    Decoding(const Decoding&) = delete;
    Decoding& operator=(const Decoding&) = delete;
    [[nodiscard]] static bool rests(const Heartbeat& heart) {
        const auto later = Heartbeat::Clock::now() + std::chrono::hours(1);
        return HeartbeatMonitor(&heart).silence(later) == std::chrono::hours(0);
    }
    /// It comes to rest when so many frames have been decoded in all, and no more are.
    [[nodiscard]] bool rests_after(int frames) const {
        return eventually([&] { return log->decoded == frames && rests(decoder); });
    }

    std::shared_ptr<Log> log{std::make_shared<Log>()};
    Heartbeat decoder{}, reader{};
    DecodedAhead media;
};

std::int64_t index_of_next(Media& media) {
    const std::optional<RawFrame> frame = media.next();
    return frame ? frame->index : -1;
}

}  // namespace

TEST_CASE("frames decoded ahead are the media's, in its order, and then its end", "[decoding]") {
    const bool waited_for = GENERATE(false, true);  // or read when they are there
    CAPTURE(waited_for);
    constexpr int kFrames = 30;
    Decoding decoding(kFrames);
    Log& log = *decoding.log;
    if (waited_for) log.may_decode = 0;
    for (int lap = 0; lap < 2; ++lap) {
        for (int k = 0; k < kFrames; ++k) {
            if (waited_for) log.allow_one_more();
            REQUIRE(index_of_next(decoding.media) == k);
            const int ahead = lap * kFrames + std::min(k + 5, kFrames);
            if (!waited_for && k > 0) REQUIRE(eventually([&] { return log.decoded >= ahead; }));
        }
        CHECK(index_of_next(decoding.media) == -1);
        CHECK(index_of_next(decoding.media) == -1);
        CHECK(decoding.media.description().frames_exact);
        decoding.media.seek(0.0);
    }
}

TEST_CASE("after a jump the next frame is the one there, whatever was decoded ahead",
          "[decoding]") {
    Decoding decoding;
    DecodedAhead& media = decoding.media;
    for (const int there : {40, 3, 99, 0, 57, 58}) {
        media.seek(0.1 * (there / 2));
        media.seek(0.1 * there);  // the last one counts
        for (int k = there; k < std::min(there + 4, 100); ++k) REQUIRE(index_of_next(media) == k);
    }
}

TEST_CASE("a frame alone is decoded alone; who reads on finds the next ones there", "[decoding]") {
    Decoding decoding;
    CHECK(decoding.log->decoded == 0);
    decoding.media.seek(1.0);
    CHECK(index_of_next(decoding.media) == 10);
    CHECK(Decoding::rests(decoding.decoder));
    CHECK(decoding.log->decoded == 1);
    CHECK(decoding.log->jumps == 1);
    CHECK(index_of_next(decoding.media) == 11);
    CHECK(decoding.rests_after(6));  // four ahead, and no more
}

TEST_CASE("what is passed over is not made, but for the last frame of all", "[decoding]") {
    Decoding decoding;
    DecodedAhead& media = decoding.media;
    const auto log = decoding.log;
    const auto first = media.next_from(0.75);
    REQUIRE(first);
    CHECK(first->index == 8);
    CHECK(log->decoded <= 6);  // of nine up to there; four ahead of it, however late this thread is
    std::int64_t last = 8;
    for (int read = 0; read < 8; ++read) {
        const double earliest_s = next_shown_s(0.1 * static_cast<double>(last), 0.75);
        const auto next = media.next_from(earliest_s, 0.75);
        REQUIRE(next);
        CHECK(next->index >= last + 7);
        CHECK(next->index <= last + 8);
        CHECK(eventually([&] { return log->decoded + log->passed > next->index; }));
        last = next->index;
    }
    CHECK(log->decoded <= 1 + 4 * 8 + 4);
    CHECK(log->passed >= 20);
    const auto end = media.next_from(1000.0);
    REQUIRE(end);
    CHECK(end->index == 99);
    CHECK_FALSE(media.next_from(1000.0));
    CHECK_FALSE(media.next());
    media.seek(2.0);
    CHECK(index_of_next(media) == 20);
    CHECK(index_of_next(media) == 21);
}

TEST_CASE("frames that are asked for as far apart as they take are all that is made",
          "[decoding]") {
    constexpr double kApart_s = 0.25;
    Decoding decoding;
    double last_s = 0.0;
    int read = 0;
    for (; last_s < 9.0; ++read) {
        const auto next = decoding.media.next_from(next_shown_s(last_s, kApart_s), kApart_s);
        REQUIRE(next);
        last_s = next->media_s;
    }
    CHECK(read > 20);
    CHECK(decoding.log->decoded <= read + 6);  // some before they were asked for so, and four ahead
}

TEST_CASE("where frames will be read in a while they are decoded at once", "[decoding]") {
    Decoding decoding;
    DecodedAhead& media = decoding.media;
    media.decode_from(5.0);
    CHECK(decoding.rests_after(4));
    for (int k = 50; k < 60; ++k) REQUIRE(index_of_next(media) == k);
    media.decode_from(2.0);
    media.seek(7.0);  // the last one counts
    CHECK(index_of_next(media) == 70);
}

TEST_CASE("frames that wait are prepared in order, once each, and none that is waited for",
          "[decoding]") {
    std::vector<std::int64_t> prepared;  // read once the thread that writes it has come to rest
    std::atomic<int> count{0};
    Decoding decoding;
    DecodedAhead& media = decoding.media;
    media.prepare_with([&](RawFrame& frame) {
        prepared.push_back(frame.index);
        frame.depth.levels.front() = -1.0F;
        ++count;
    });
    const auto is_prepared = [&media] { return media.next()->depth.levels.front() < 0.0F; };
    const auto all_wait_prepared = [&](int wanted) {
        return eventually([&] { return count == wanted && Decoding::rests(decoding.decoder); });
    };
    CHECK_FALSE(is_prepared());
    CHECK_FALSE(is_prepared());
    REQUIRE(all_wait_prepared(4));
    for (int k = 2; k < 6; ++k) CHECK(is_prepared());

    media.seek(5.0);  // what waits there is dropped, and what is prepared meanwhile, too
    CHECK_FALSE(is_prepared());
    const int before = count;  // nothing else is decoded before one more is read
    CHECK_FALSE(is_prepared());
    REQUIRE(all_wait_prepared(before + 4));
    media.prepare_with(nullptr);
    for (int k = 52; k < 56; ++k) CHECK(is_prepared());
    REQUIRE(all_wait_prepared(before + 4));
    CHECK_FALSE(is_prepared());
    std::vector<std::int64_t> last(prepared.end() - 4, prepared.end());
    CHECK(last == std::vector<std::int64_t>{52, 53, 54, 55});
}

TEST_CASE("a frame that is being prepared is waited for, and comes whole", "[decoding]") {
    std::atomic<int> begun{0};
    std::atomic<int> may_end{0};  // preparations, in all
    Decoding decoding;
    DecodedAhead& media = decoding.media;
    media.prepare_with([&](RawFrame& frame) {
        const int number = ++begun;
        while (may_end < number) std::this_thread::yield();
        frame.depth.levels.front() = -1.0F;
    });
    CHECK(index_of_next(media) == 0);
    CHECK(index_of_next(media) == 1);
    REQUIRE(eventually([&] { return begun == 1; }));
    std::optional<RawFrame> frame;
    std::thread reading([&] { frame = media.next(); });
    CHECK(eventually([&] { return Decoding::rests(decoding.reader); }));  // it waits
    may_end = 1;
    reading.join();
    REQUIRE(frame);
    CHECK(frame->index == 2);
    CHECK(frame->depth.levels.front() < 0.0F);

    REQUIRE(eventually([&] { return begun == 2; }));
    media.seek(7.0);  // what is in work is nobody's any more
    may_end = 1000;
    for (int k = 70; k < 76; ++k) REQUIRE(index_of_next(media) == k);
}

TEST_CASE("a preparation that fails is told by the frame that it failed for", "[decoding]") {
    std::atomic<std::int64_t> last{0};
    Decoding decoding;
    DecodedAhead& media = decoding.media;
    media.prepare_with([&last](RawFrame& frame) {
        last = frame.index;
        if (frame.index == 3) throw std::bad_alloc();
    });
    CHECK(index_of_next(media) == 0);
    CHECK(index_of_next(media) == 1);
    REQUIRE(eventually([&] { return last >= 4; }));
    CHECK(index_of_next(media) == 2);
    CHECK_THROWS_AS(media.next(), std::bad_alloc);
    CHECK(index_of_next(media) == 4);
}

TEST_CASE("what breaks off is told after the frames before it, each time it is asked for",
          "[decoding]") {
    Decoding decoding(30, 5);
    DecodedAhead& media = decoding.media;
    for (int k = 0; k < 5; ++k) REQUIRE(index_of_next(media) == k);
    CHECK_THROWS_AS(media.next(), InputError);
    CHECK_THROWS_AS(media.next(), InputError);
    media.seek(0.3);
    CHECK(index_of_next(media) == 3);
    media.seek(0.6);
    CHECK(index_of_next(media) == 6);
}

TEST_CASE("a media is left at once, also while it decodes ahead", "[decoding]") {
    for (int read = 0; read < 8; ++read) {
        std::shared_ptr<Log> log;
        {
            Decoding decoding(1000);
            log = decoding.log;
            for (int n = 0; n < read; ++n) CHECK(index_of_next(decoding.media) == n);
        }
        CHECK(log->decoded <= read + 4);
    }
}

namespace {

/// One frame, read from a disk that does not answer before it is let.
class StuckMedia : public Media {
  public:
    StuckMedia() { REQUIRE(::pipe(ends_.data()) == 0); }
    ~StuckMedia() override {
        for (const int end : ends_) ::close(end);
    }
    void let_go() const { [[maybe_unused]] const auto written = ::write(ends_[1], "x", 1); }
    [[nodiscard]] const std::atomic<pid_t>& thread() const { return thread_; }

    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override {
        thread_ = static_cast<pid_t>(::syscall(SYS_gettid));
        char byte{};
        [[maybe_unused]] const auto got = ::read(ends_[0], &byte, 1);
        return std::nullopt;
    }
    void seek(double /*media_s*/) override {}

  private:
    std::array<int, 2> ends_{};
    std::atomic<pid_t> thread_{0};
    MediaDescription description_{};
};

}  // namespace

TEST_CASE("the decoder's heart is heard only while it decodes", "[decoding]") {
    Heartbeat decoder;
    Heartbeat reader;
    reader.beat();
    auto stuck = std::make_unique<StuckMedia>();
    const StuckMedia& disk = *stuck;
    DecodedAhead media(std::move(stuck), {&decoder, &reader});
    CHECK(Decoding::rests(decoder));
    std::thread reading([&media] { static_cast<void>(media.next()); });
    REQUIRE(eventually([&disk] { return disk.thread() != 0; }));
    REQUIRE(comes_to_wait_in(SYS_read, disk.thread()));
    // It waits for a disk: that is silence, and the reader is not to blame.
    const auto waiting = std::chrono::steady_clock::now();
    CHECK(HeartbeatMonitor(&decoder).silence(waiting + std::chrono::milliseconds(150)) >=
          std::chrono::milliseconds(150));
    CHECK(Decoding::rests(reader));
    disk.let_go();
    reading.join();
    CHECK(Decoding::rests(decoder));
    CHECK_FALSE(Decoding::rests(reader));
}
