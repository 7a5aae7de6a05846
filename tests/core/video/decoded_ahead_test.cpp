// Decoding on a thread of its own: nobody who reads can tell, but by the clock.
#include "core/video/decoded_ahead.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using dibhr::test::eventually;

namespace {

/// Small frames, a tenth of a second apart, of which each takes its time; `breaks_at` cannot be
/// read.
class SlowMedia : public Media {
  public:
    struct Log {
        std::atomic<int> decoded{0};
        std::atomic<int> passed{0};
        std::atomic<int> jumps{0};
    };
    SlowMedia(int frames, std::chrono::milliseconds each, std::shared_ptr<Log> log,
              int breaks_at = -1)
        : frames_(frames), each_(each), breaks_at_(breaks_at), log_(std::move(log)) {}

    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override {
        std::this_thread::sleep_for(each_);
        if (position_ == breaks_at_) throw InputError("'clip' breaks off: record it again");
        if (position_ == frames_) {
            description_.frames_exact = true;
            return std::nullopt;
        }
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
    std::chrono::milliseconds each_;
    int breaks_at_;
    std::shared_ptr<Log> log_;
    int position_{0};
    MediaDescription description_{};
};

std::shared_ptr<SlowMedia::Log> new_log() {
    return std::make_shared<SlowMedia::Log>();
}

std::int64_t index_of_next(Media& media) {
    const std::optional<RawFrame> frame = media.next();
    return frame ? frame->index : -1;
}

}  // namespace

TEST_CASE("frames decoded ahead are the media's, in its order, and then its end", "[decoding]") {
    const std::chrono::milliseconds each(GENERATE(0, 2));
    DecodedAhead media(std::make_unique<SlowMedia>(30, each, new_log()));
    for (int lap = 0; lap < 2; ++lap) {
        for (int k = 0; k < 30; ++k) {
            REQUIRE(index_of_next(media) == k);
            if (k % 7 == 3) std::this_thread::sleep_for(each);
        }
        CHECK(index_of_next(media) == -1);
        CHECK(index_of_next(media) == -1);
        CHECK(media.description().frames_exact);
        media.seek(0.0);
    }
}

TEST_CASE("after a jump the next frame is the one there, whatever was decoded ahead",
          "[decoding]") {
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(1), new_log()));
    for (const int there : {40, 3, 99, 0, 57, 58}) {
        media.seek(0.1 * (there / 2));
        media.seek(0.1 * there);  // the last one counts
        for (int k = there; k < std::min(there + 4, 100); ++k) REQUIRE(index_of_next(media) == k);
    }
}

TEST_CASE("a frame alone is decoded alone; who reads on finds the next ones there", "[decoding]") {
    const auto log = new_log();
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(1), log));
    CHECK(log->decoded == 0);
    media.seek(1.0);
    CHECK(index_of_next(media) == 10);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    CHECK(log->decoded == 1);
    CHECK(log->jumps == 1);
    CHECK(index_of_next(media) == 11);
    CHECK(eventually([&] { return log->decoded >= 6; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    CHECK(log->decoded == 6);  // four ahead, and no more
}

TEST_CASE("what is passed over is not made, but for the last frame of all", "[decoding]") {
    const auto log = new_log();
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(1), log));
    const auto first = media.next_from(0.75);
    REQUIRE(first);
    CHECK(first->index == 8);
    CHECK(log->decoded <= 6);  // of nine up to there; four ahead of it, however late this thread is
    std::int64_t last = 8;
    for (int read = 0; read < 8; ++read) {
        const double earliest_s = 0.1 * static_cast<double>(last) + 0.75;
        const auto next = media.next_from(earliest_s, 0.75);
        REQUIRE(next);
        CHECK(next->index == last + 8);
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
    const auto log = new_log();
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(5), log));
    double last_s = 0.0;
    int read = 0;
    for (; last_s < 9.0; ++read) {
        const auto next = media.next_from(last_s + kApart_s, kApart_s);
        REQUIRE(next);
        last_s = next->media_s;
    }
    CHECK(read > 20);
    CHECK(log->decoded <= read + 6);  // some before they were asked for so, and four ahead
}

TEST_CASE("where frames will be read in a while they are decoded at once", "[decoding]") {
    const auto log = new_log();
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(1), log));
    media.decode_from(5.0);
    CHECK(eventually([&] { return log->decoded >= 4; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    CHECK(log->decoded == 4);
    for (int k = 50; k < 60; ++k) REQUIRE(index_of_next(media) == k);
    media.decode_from(2.0);
    media.seek(7.0);  // the last one counts
    CHECK(index_of_next(media) == 70);
}

TEST_CASE("frames that wait are prepared in order, once each, and none that is waited for",
          "[decoding]") {
    std::vector<std::int64_t> prepared;  // read once the thread that writes it has come to rest
    std::atomic<int> count{0};
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(1), new_log()));
    media.prepare_with([&](RawFrame& frame) {
        prepared.push_back(frame.index);
        frame.depth.levels.front() = -1.0F;
        ++count;
    });
    const auto is_prepared = [&media] { return media.next()->depth.levels.front() < 0.0F; };
    const auto all_wait_prepared = [&count](int wanted) {
        (void)eventually([&] { return count >= wanted; });
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        return count == wanted;
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
    std::atomic<bool> begun{false};
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(0), new_log()));
    media.prepare_with([&begun](RawFrame& frame) {
        begun = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        frame.depth.levels.front() = -1.0F;
    });
    CHECK(index_of_next(media) == 0);
    CHECK(index_of_next(media) == 1);
    REQUIRE(eventually([&] { return begun.load(); }));
    const std::optional<RawFrame> frame = media.next();
    REQUIRE(frame);
    CHECK(frame->index == 2);
    CHECK(frame->depth.levels.front() < 0.0F);

    begun = false;
    CHECK(index_of_next(media) == 3);  // and one more is prepared
    REQUIRE(eventually([&] { return begun.load(); }));
    media.seek(7.0);  // what is in work is nobody's any more
    for (int k = 70; k < 76; ++k) REQUIRE(index_of_next(media) == k);
}

TEST_CASE("a preparation that fails is told by the frame that it failed for", "[decoding]") {
    std::atomic<std::int64_t> last{0};
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(0), new_log()));
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
    DecodedAhead media(std::make_unique<SlowMedia>(30, std::chrono::milliseconds(0), new_log(), 5));
    for (int k = 0; k < 5; ++k) REQUIRE(index_of_next(media) == k);
    CHECK_THROWS_AS(media.next(), InputError);
    CHECK_THROWS_AS(media.next(), InputError);
    media.seek(0.3);
    CHECK(index_of_next(media) == 3);
    media.seek(0.6);
    CHECK(index_of_next(media) == 6);
}

TEST_CASE("a media is left at once, also while it decodes ahead", "[decoding]") {
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < 20; ++k) {
        DecodedAhead media(
            std::make_unique<SlowMedia>(1000, std::chrono::milliseconds(2), new_log()));
        for (int n = 0; n < k % 4; ++n) CHECK(index_of_next(media) == n);
    }
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(5));
}

TEST_CASE("the decoder's heart is heard only while it decodes", "[decoding]") {
    Heartbeat decoder;
    Heartbeat reader;
    reader.beat();
    DecodedAhead media(std::make_unique<SlowMedia>(100, std::chrono::milliseconds(400), new_log()),
                       {&decoder, &reader});
    std::thread reading([&media] { static_cast<void>(media.next()); });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    // It sleeps in what stands for a disk: that is silence, and the reader is not to blame.
    const auto waiting = std::chrono::steady_clock::now();
    CHECK(HeartbeatListener(&decoder).silence(waiting) > std::chrono::milliseconds(150));
    CHECK(HeartbeatListener(&reader).silence(waiting) == std::chrono::milliseconds(0));
    reading.join();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const auto now = std::chrono::steady_clock::now();
    CHECK(HeartbeatListener(&decoder).silence(now) == std::chrono::milliseconds(0));
}
