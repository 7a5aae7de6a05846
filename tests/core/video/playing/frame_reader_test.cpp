// The frame reader: what it passes over, shows before it has it, and keeps.
#include "core/video/playing/frame_reader.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/video/playing/cleaning_degradation.hpp"
#include "core/video/playing/playback.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/noisy_scene.hpp"
#include "tests/support/own_memory.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kFrame_s = 0.04;
constexpr int kKeyFrames = 10;  ///< one in so many

double frame_s(int k) {
    return k * kFrame_s;
}

/// What a media did, and how long it took by its own clock.
struct Disk {
    std::atomic<int> jumps{0};          ///< that arrived
    std::atomic<int> made{0};           ///< frames that were given out
    std::chrono::milliseconds jump{0};  ///< takes so long
    double skipping_s{1e-6};            ///< as it says of a frame
    std::atomic<std::chrono::milliseconds> worked{std::chrono::milliseconds{0}};

    [[nodiscard]] std::chrono::steady_clock::time_point now() const {
        return std::chrono::steady_clock::time_point{} + worked.load();
    }
};

/// Frames that lie in memory; going to one takes a jump of the disk, but for those that stand
/// alone.
class KeyedMedia : public Media {
  public:
    explicit KeyedMedia(std::vector<DepthImage> frames,
                        std::shared_ptr<Disk> disk = std::make_shared<Disk>())
        : frames_(std::move(frames)), disk_(std::move(disk)) {
        description_.frames_per_s = 1.0 / kFrame_s;
        description_.depth_columns = frames_.front().columns;
        description_.depth_rows = frames_.front().rows;
    }
    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override {
        if (position_ >= frames_.size()) return std::nullopt;
        RawFrame frame;
        frame.depth = frames_[position_];
        frame.media_s = frame_s(static_cast<int>(position_));
        frame.index = static_cast<std::int64_t>(position_++);
        frame.never_has_holes = true;
        frame.skipping_s = disk_->skipping_s;
        ++disk_->made;
        return frame;
    }
    std::optional<RawFrame> next_from(double earliest_s) override {
        while (position_ + 1 < frames_.size() && frame_s(static_cast<int>(position_)) < earliest_s)
            ++position_;
        return next();
    }
    void seek(double media_s) override {
        disk_->worked = disk_->worked.load() + disk_->jump;
        position_ = std::min(index_at(media_s), frames_.size() - 1);
        ++disk_->jumps;
    }
    void seek_near(double media_s) override {
        position_ = index_at(media_s) / kKeyFrames * kKeyFrames;
    }

  private:
    [[nodiscard]] static std::size_t index_at(double media_s) {
        return static_cast<std::size_t>((media_s + kTimeTolerance_s) / kFrame_s);
    }
    std::vector<DepthImage> frames_;
    std::shared_ptr<Disk> disk_;
    std::size_t position_{0};
    MediaDescription description_{};
};

std::vector<DepthImage> shaken_frames(int count) {
    const NoisyScene shaken{[](int k, int i, int j) { return 80.0 + 0.3 * i + 0.1 * j + 0.05 * k; },
                            [](double) { return 0.8; }, 64, 48};
    return shaken.frames(count);
}

/// A texture on a plane, so many pixels to the right.
Frame gone_by(int px, int index) {
    auto colour = std::make_shared<ColourImage>(ColourImage{128, 96, {}});
    for (int j = 0; j < colour->rows; ++j)
        for (int i = 0; i < colour->columns; ++i) {
            const double x = i - px;
            const double bright =
                128.0 + 50.0 * std::sin(0.31 * x + 0.07 * j) + 50.0 * std::sin(0.47 * j - 0.11 * x);
            colour->rgb.insert(colour->rgb.end(), 3, static_cast<std::uint8_t>(bright));
        }
    Frame frame;
    frame.depth = std::make_shared<const DepthImage>(
        dibhr::image_of(128, 96, 255.0, [](int, int) { return 100.0; }));
    frame.colour = std::move(colour);
    frame.colour_of_view = true;
    frame.media_s = frame_s(index);
    frame.index = index;
    return frame;
}

constexpr std::chrono::milliseconds kSlowJump{150};

/// Of 60 frames on that disk, by whose clock everything is timed.
std::unique_ptr<FrameReader> timed_reader(const std::shared_ptr<Disk>& disk) {
    return std::make_unique<FrameReader>(std::make_unique<KeyedMedia>(shaken_frames(60), disk), 0,
                                         ReaderHeartbeats{}, [disk] { return disk->now(); });
}

std::unique_ptr<FrameReader> sensor_reader(const std::vector<DepthImage>& frames) {
    auto reader = std::make_unique<FrameReader>(std::make_unique<KeyedMedia>(frames));
    reader->set_cleaning({.preset = CleaningPreset::sensor});
    return reader;
}

}  // namespace

TEST_CASE("frames that would come too late are passed over and counted, the last one never",
          "[reader]") {
    const auto frames = shaken_frames(30);
    const auto reader = sensor_reader(frames);
    REQUIRE(reader->at(0.0));
    const auto in_time = reader->after(0.0, {.earliest_s = frame_s(7)});
    REQUIRE(in_time);
    CHECK(in_time->index == 7);
    CHECK(reader->skipped_frames() == 6);
    const auto next = reader->after(frame_s(7), {.earliest_s = frame_s(3)});
    REQUIRE(next);
    CHECK(next->index == 8);
    const auto last = reader->after(frame_s(8), {.earliest_s = 100.0});
    REQUIRE(last);
    CHECK(last->index == 29);
    CHECK_FALSE(reader->after(frame_s(29), {.earliest_s = 100.0}));
    CHECK(reader->skipped_frames() == 6 + 20);
}

TEST_CASE("frames that are passed over share the wait, and what is waited for is summed up",
          "[reader]") {
    constexpr double kWait_s = 0.050;
    constexpr double kNewest = 0.1;  // the weight of the newest of a moving mean
    // Who reads looks at the clock when it begins to wait; whenever it looks again it is later.
    int looks = 0;
    const auto reader_looks = [&looks, here = std::this_thread::get_id()] {
        const bool later = std::this_thread::get_id() == here && ++looks > 1;
        return std::chrono::steady_clock::time_point{} +
               std::chrono::milliseconds(later ? std::lround(1000.0 * kWait_s) : 0);
    };
    const auto disk = std::make_shared<Disk>();
    disk->skipping_s = 0.0;  // it does not say how long that takes
    FrameReader reader(std::make_unique<KeyedMedia>(shaken_frames(30), disk), 0, ReaderHeartbeats{},
                       reader_looks);
    reader.set_cleaning({.preset = CleaningPreset::raw});
    REQUIRE(reader.at(0.0));
    CHECK_THAT(reader.decoding_s(), WithinAbs(0.0, 1e-9));
    CHECK_THAT(reader.waited_s(), WithinAbs(0.0, 1e-9));
    double mean_s = 0.0;
    double from_s = 0.0;
    for (const int frames : {10, 1, 5}) {
        looks = 0;
        const auto next = reader.after(from_s, {.earliest_s = from_s + frame_s(frames) - 1e-6});
        REQUIRE(next);
        CHECK(next->media_s - from_s == Approx(frame_s(frames)));
        from_s = next->media_s;
        mean_s += kNewest * (kWait_s / frames - mean_s);
        CHECK_THAT(reader.decoding_s(), WithinAbs(mean_s, 1e-9));
    }
    CHECK_THAT(reader.waited_s(), WithinAbs(3.0 * kWait_s, 1e-9));
}

TEST_CASE("where frames are passed over in-betweens rest first, then motion, and both come back",
          "[reader]") {
    const auto reader = sensor_reader(shaken_frames(30));
    reader->set_motion({.motion = true, .in_betweens = true});
    Frame first = gone_by(0, 0);
    const Frame second = gone_by(6, 1);
    const auto connected = [&] {
        reader->connect(first, second);
        return MotionRequest{.motion = first.motion != nullptr,
                             .in_betweens = first.in_betweens != nullptr};
    };
    REQUIRE(reader->at(0.0));
    CHECK(connected() == MotionRequest{true, true});
    REQUIRE(reader->after(0.0, {.earliest_s = frame_s(7)}));
    CHECK(connected() == MotionRequest{true, false});  // it may fit alone
    REQUIRE(reader->after(frame_s(7), {.earliest_s = frame_s(14)}));
    CHECK(connected() == MotionRequest{});
    int frames = 0;
    while (!(connected() == MotionRequest{true, true}) && frames < 1000) ++frames;
    CHECK(frames > 20);
    CHECK(frames < 200);
}

TEST_CASE("a frame is the same bits whether those before it were passed over or not", "[reader]") {
    const auto frames = shaken_frames(60);
    const auto every = sensor_reader(frames);
    std::vector<std::vector<float>> in_order;
    for (auto frame = every->at(0.0); frame; frame = every->after(frame->media_s))
        in_order.push_back(frame->depth->levels);
    REQUIRE(in_order.size() == 60);
    const double step_s = GENERATE(2, 3, 7, 19) * kFrame_s;
    const auto few = sensor_reader(frames);
    for (auto frame = few->at(0.0); frame;
         frame = few->after(frame->media_s, {.earliest_s = frame->media_s + step_s})) {
        CAPTURE(frame->index);
        REQUIRE((frame->depth->levels == in_order[static_cast<std::size_t>(frame->index)]));
    }
}

TEST_CASE("a fingertip feels the same bits whether a frame was cleaned ahead or not", "[reader]") {
    const auto preset =
        GENERATE(CleaningPreset::gentle, CleaningPreset::automatic, CleaningPreset::sensor);
    const CleaningOptions cleaning{.preset = preset, .finger = {3.0, 80.0}};
    const CleaningOptions wider{.preset = preset, .finger = {5.0, 80.0}};
    const std::vector<DepthImage> frames = shaken_frames(24);
    FrameReader played(std::make_unique<KeyedMedia>(frames));
    FrameReader sought(std::make_unique<KeyedMedia>(frames));
    played.set_cleaning(cleaning);
    sought.set_cleaning(cleaning);
    REQUIRE(played.at(0.0));
    for (int k = 1; k < 20; ++k) {
        CAPTURE(k);
        if (k == 10) {  // frames that wait may be cleaned for the narrower one
            played.set_cleaning(wider);
            sought.set_cleaning(wider);
        }
        const auto next = played.after(frame_s(k - 1));
        const auto alone = sought.at(frame_s(k));
        REQUIRE(next);
        REQUIRE(alone);
        CHECK(next->depth->levels == alone->depth->levels);
        CHECK(next->undilated->levels == alone->undilated->levels);
        CHECK(next->cleaning == alone->cleaning);
    }
}

TEST_CASE("another level of cleaning begins with the next frames, without a jump of the decoder",
          "[reader]") {
    const std::vector<DepthImage> frames = shaken_frames(60);
    const auto disk = std::make_shared<Disk>();
    FrameReader reader(std::make_unique<KeyedMedia>(frames, disk));
    reader.set_cleaning({.preset = CleaningPreset::sensor});
    reader.set_degradation(1);  // the filter in time needs jumps
    const auto has_own_bits = [&frames](const Frame& frame) {
        FrameReader alone(std::make_unique<KeyedMedia>(frames));
        alone.set_cleaning({.preset = CleaningPreset::own, .own = frame.cleaning.steps});
        return frame.depth->levels == alone.at(frame.media_s)->depth->levels;
    };
    std::optional<Frame> frame = reader.at(0.0);
    REQUIRE(frame);
    const int jumps = disk->jumps;
    for (const std::size_t level : {2U, 3U, 4U, 5U, 4U, 1U}) {
        CAPTURE(level);
        reader.degrade_next(level);
        for (int k = 0; k < 8; ++k) {
            const std::int64_t before = frame->index;
            frame = reader.after(frame->media_s);
            REQUIRE(frame);
            CHECK(frame->index == before + 1);
            CHECK(has_own_bits(*frame));
        }
        CHECK(frame->cleaning.steps == degraded(kSensorSteps, level));
    }
    CHECK(disk->jumps == jumps);
    reader.set_degradation(0);
    frame = reader.at(frame->media_s);
    CHECK(frame->cleaning.steps == kSensorSteps);
    CHECK(has_own_bits(*frame));
}

TEST_CASE("at rest every frame has all steps again, also those that were kept or ahead",
          "[reader]") {
    CleaningSteps whole = kGentleSteps;
    whole.sharpen_silhouettes = true;
    FrameReader reader(std::make_unique<KeyedMedia>(shaken_frames(60)));
    reader.set_cleaning({.preset = CleaningPreset::own, .own = whole});
    std::optional<Frame> frame = reader.at(0.0);
    const auto play = [&](int count) {
        for (int k = 0; k < count; ++k) frame = reader.after(frame->media_s);
        REQUIRE(frame);
    };
    reader.degrade_next(4);
    play(8);
    reader.degrade_next(0);
    play(1);
    CHECK(reader.is_mixed());
    reader.set_degradation(0);
    CHECK(reader.at(frame->media_s)->cleaning.steps == whole);
    CHECK(reader.before(frame->media_s)->cleaning.steps == whole);
    CHECK_FALSE(reader.is_mixed());
    play(8);
    CHECK(frame->cleaning.steps == whole);
}

TEST_CASE("what is passed over while it plays is not made, and a step is one frame all the same",
          "[reader]") {
    const auto frames = shaken_frames(400);
    const auto disk = std::make_shared<Disk>();
    FrameReader reader(std::make_unique<KeyedMedia>(frames, disk));
    reader.set_cleaning({.preset = CleaningPreset::gentle});
    FrameReader every(std::make_unique<KeyedMedia>(frames));
    every.set_cleaning({.preset = CleaningPreset::gentle});
    std::vector<std::vector<float>> in_order;
    for (auto frame = every.at(0.0); frame; frame = every.after(frame->media_s))
        in_order.push_back(frame->depth->levels);

    const double spacing_s = 6.0 * kFrame_s;
    auto frame = reader.at(0.0);
    std::int64_t skipped_frames = 0;
    for (int shown = 0; shown < 40; ++shown) {
        auto next = reader.after(frame->media_s, {frame->media_s + spacing_s, spacing_s});
        REQUIRE(next);
        REQUIRE(next->media_s >= frame->media_s + spacing_s);
        REQUIRE((next->depth->levels == in_order[static_cast<std::size_t>(next->index)]));
        skipped_frames += next->index - frame->index - 1;
        frame = std::move(next);
    }
    CHECK(reader.skipped_frames() == skipped_frames);
    CHECK(skipped_frames >= 5 * 40);
    CHECK(disk->made < 5 * 41);

    // Also while the decoder has passed over the next one, or kept frames end.
    const auto next = reader.after(frame->media_s);
    REQUIRE(next);
    CHECK(next->index == frame->index + 1);
    const auto before = reader.before(frame->media_s);
    REQUIRE(before);
    CHECK(before->index == frame->index - 1);
    const auto again = reader.after(before->media_s, {before->media_s, spacing_s});
    REQUIRE(again);
    CHECK(again->index == frame->index);
}

TEST_CASE("where kept frames end while they are played, the decoder has jumped before",
          "[reader]") {
    const auto frames = shaken_frames(80);
    const bool steady = GENERATE(false, true);
    const auto disk = std::make_shared<Disk>();
    FrameReader reader(std::make_unique<KeyedMedia>(frames, disk));
    reader.set_cleaning({.preset = steady ? CleaningPreset::sensor : CleaningPreset::gentle});
    std::vector<std::vector<float>> played;
    for (auto frame = reader.at(0.0); frame && played.size() < 60;
         frame = reader.after(frame->media_s))
        played.push_back(frame->depth->levels);
    REQUIRE(played.size() == 60);
    auto frame = reader.at(0.0);  // long gone: where kept frames begin is found again
    REQUIRE(frame);
    const int jumps = disk->jumps;
    for (int k = 1; k < 30; ++k) {
        frame = reader.after(frame->media_s);
        REQUIRE(frame);
        REQUIRE((frame->depth->levels == played[static_cast<std::size_t>(k)]));
    }
    REQUIRE(eventually([&] { return disk->jumps > jumps; }));
    const int on_its_way = disk->jumps;
    for (int k = 30; k < 60; ++k) {
        frame = reader.after(frame->media_s);
        CAPTURE(k);
        REQUIRE(frame);
        REQUIRE(frame->index == k);
        REQUIRE((frame->depth->levels == played[static_cast<std::size_t>(k)]));
    }
    CHECK(disk->jumps == on_its_way);  // no other jump was to be waited for
}

TEST_CASE("where a jump takes long a frame near it is there at once, and says how it was cleaned",
          "[reader]") {
    const auto disk = std::make_shared<Disk>();
    disk->jump = kSlowJump;
    const auto slow = timed_reader(disk);
    slow->set_cleaning({.preset = CleaningPreset::sensor});
    REQUIRE(slow->at(0.0));
    CHECK_FALSE(slow->preview(0.0));  // it is kept
    const int jumps = disk->jumps;
    const auto preview = slow->preview(frame_s(37));
    REQUIRE(preview);
    CHECK(disk->jumps == jumps);
    CHECK(preview->index == 30);
    CleaningSteps alone = kSensorSteps;
    alone.steady = false;
    CHECK(preview->cleaning.steps == alone);
    const auto sought = slow->at(frame_s(37));
    REQUIRE(sought);
    CHECK(sought->index == 37);
    CHECK(disk->jumps > jumps);
    const auto quick = sensor_reader(shaken_frames(60));
    CHECK_FALSE(quick->preview(frame_s(37)));  // as quick itself
    CHECK(sought->depth->levels == quick->at(frame_s(37))->depth->levels);
}

TEST_CASE("a preview is seen and not touched, and the frame that was sought takes its place",
          "[playback]") {
    Playback::Time now{std::chrono::hours(1)};
    Playback playback;
    playback.set_cleaning({.preset = CleaningPreset::sensor});
    const auto disk = std::make_shared<Disk>();
    disk->jump = kSlowJump;
    playback.open(timed_reader(disk), now);
    const bool paused = GENERATE(false, true);
    if (paused) playback.pause(now);
    playback.seek(frame_s(25), now);  // the first jump tells how long one takes
    const auto discontinuity = playback.window().discontinuity;
    playback.seek(frame_s(48), now);
    CHECK(playback.seek_target_s() == frame_s(48));
    CHECK(playback.window().frames[0].index == 40);
    CHECK(playback.window().discontinuity == discontinuity + 1);
    CHECK(playback.touchable().count == 0);
    CHECK(playback.touchable().discontinuity == discontinuity + 1);
    REQUIRE(playback.needs_frame());
    REQUIRE(playback.read_ahead(now));
    playback.on_frame_read(now);
    CHECK_FALSE(playback.seek_target_s());
    CHECK(playback.window().frames[0].index == 48);
    CHECK(playback.touchable().count == playback.window().count);
    CHECK(playback.touchable().discontinuity == discontinuity + 2);
    CHECK(playback.playing() == !paused);
}

TEST_CASE("a preview of a frame that cannot be read stays untouched", "[playback]") {
    const Playback::Time now{std::chrono::hours(1)};
    Playback playback;
    const auto disk = std::make_shared<Disk>();
    disk->jump = kSlowJump;
    playback.open(timed_reader(disk), now);
    playback.seek(frame_s(25), now);
    playback.seek(frame_s(48), now);
    REQUIRE(playback.shows_preview());
    playback.end_here();
    CHECK(playback.shows_preview());
    CHECK(playback.touchable().count == 0);
    CHECK(playback.window().count == 1);
    playback.seek(frame_s(25), now);
    if (playback.needs_frame() && playback.read_ahead(now)) playback.on_frame_read(now);
    CHECK_FALSE(playback.shows_preview());
    CHECK(playback.touchable().count > 0);
}

TEST_CASE("the first frame is seen as recorded, not touched, until it is known how to clean it",
          "[playback]") {
    const Playback::Time now{std::chrono::hours(1)};
    const NoisyScene noisy{[](int, int i, int j) { return 80.0 + 0.1 * i + 0.05 * j; },
                           [](double) { return 0.8; }, 400, 300};
    const std::vector<DepthImage> frames = noisy.frames(12);
    const auto cleaning = GENERATE(CleaningPreset::sensor, CleaningPreset::automatic);
    FrameReader reader(std::make_unique<KeyedMedia>(frames));
    reader.set_cleaning({.preset = cleaning});
    const auto cleaned = reader.at(0.0);
    REQUIRE(cleaned);

    Playback playback;
    playback.set_cleaning({.preset = cleaning});
    playback.open(std::make_unique<FrameReader>(std::make_unique<KeyedMedia>(frames)), now);
    REQUIRE(playback.window().count == 1);
    CHECK(playback.window().frames[0].depth->levels == frames[0].levels);
    CHECK(playback.touchable().count == 0);
    CHECK(playback.playing());
    REQUIRE(playback.needs_frame());
    REQUIRE(playback.read_ahead(now));
    playback.on_frame_read(now);
    REQUIRE(playback.touchable().count == 1);
    CHECK(playback.touchable().frames[0].depth->levels == cleaned->depth->levels);
    CHECK(cleaned->depth->levels != frames[0].levels);
}

TEST_CASE("what needs no measuring is touched from its first picture on", "[playback]") {
    const Playback::Time now{std::chrono::hours(1)};
    const DepthImage frame = dibhr::image_of(400, 300, 255.0, [](int i, int) { return 0.5 * i; });
    Playback playback;
    playback.set_cleaning({.preset = GENERATE(CleaningPreset::raw, CleaningPreset::gentle)});
    playback.open(std::make_unique<FrameReader>(
                      std::make_unique<KeyedMedia>(std::vector<DepthImage>(12, frame))),
                  now);
    CHECK(playback.touchable().count == 1);
}

TEST_CASE("a step from a preview is one from the frame that was sought", "[playback]") {
    Playback::Time now{std::chrono::hours(1)};
    Playback playback;
    const auto disk = std::make_shared<Disk>();
    disk->jump = kSlowJump;
    playback.open(timed_reader(disk), now);
    playback.seek(frame_s(25), now);
    playback.seek(frame_s(48), now);
    REQUIRE(playback.seek_target_s());
    playback.step(-1, now);
    CHECK_FALSE(playback.seek_target_s());
    CHECK(playback.window().frames[0].index == 47);
}

TEST_CASE("while nothing else is to be done the step back is made ready", "[playback]") {
    Playback::Time now{std::chrono::hours(1)};
    Playback playback;
    const auto disk = std::make_shared<Disk>();
    disk->jump = kSlowJump;
    playback.open(timed_reader(disk), now);
    CHECK_FALSE(playback.can_prepare_step_back());  // it plays
    playback.seek(frame_s(48), now);
    playback.pause(now);
    while (playback.needs_frame())
        if (playback.read_ahead(now)) playback.on_frame_read(now);
    CHECK_FALSE(playback.can_prepare_step_back());  // nobody steps back
    playback.step(-1, now);
    for (int frame = 46; frame > 40; --frame) {
        while (playback.needs_frame())
            if (playback.read_ahead(now)) playback.on_frame_read(now);
        REQUIRE(playback.can_prepare_step_back());
        playback.prepare_step_back();
        CHECK_FALSE(playback.can_prepare_step_back());
        const int jumps = disk->jumps;
        playback.step(-1, now);
        CHECK(disk->jumps == jumps);
        CHECK(playback.window().frames[0].index == frame);
    }
}

#if !DIBHR_SANITIZED  // which need memory, too
TEST_CASE("a reader of large frames keeps within its memory", "[reader]") {
    const CleaningPreset preset = GENERATE(CleaningPreset::gentle, CleaningPreset::sensor);
    const NoisyScene shaken{[](int, int i, int j) { return 80.0 + 0.05 * i + 0.01 * j; },
                            [](double) { return 0.8; }, 1280, 720};
    malloc_trim(0);  // memory that earlier cases have freed would be used again, and not counted
    const std::size_t before = resident_bytes();
    FrameReader reader(std::make_unique<KeyedMedia>(std::vector<DepthImage>(60, shaken.truth(0))));
    const std::size_t given = resident_bytes();  // 220 MB of frames
    reader.set_cleaning({.preset = preset});
    for (auto frame = reader.at(0.0); frame; frame = reader.after(frame->media_s)) {
    }
    // Some of it may lie in memory that threads of earlier cases have freed since.
    CHECK(given > before + (std::size_t{150} << 20));
    CHECK(resident_bytes() < given + (std::size_t{260} << 20));
}
#endif

TEST_CASE(
    "a wide ramp's step is at the colour's edge where that is asked for, whatever was read "
    "before",
    "[reader]") {
    constexpr int kFrames = 12;
    const TemporaryFolder folder;
    const std::string picture = "-f lavfi -i color=size=480x60:rate=25:duration=0.48,format=gray,";
    ffmpeg(picture + "geq=lum='50+130*clip((X-73.5)/13\\,0\\,1)' -c:v ffv1 " +
           (folder / "clip_depth.mkv").string());
    ffmpeg(picture + "geq=lum='if(gt(X\\,74+N)\\,200\\,50)' -c:v ffv1 -g 6 " +
           (folder / "clip_color.mkv").string());
    CleaningSteps steps{.sharpen_silhouettes = true, .colour_edges = true};
    const auto reader = [&](std::unique_ptr<Media> media) {
        auto made = std::make_unique<FrameReader>(std::move(media));
        made->set_cleaning({.preset = CleaningPreset::own, .own = steps});
        return made;
    };
    const auto pair = [&] {
        return reader(open_media(folder / "clip_color.mkv", folder / "clip_depth.mkv"));
    };
    const auto step_of = [](const Frame& frame) {
        const DepthImage& depth = *frame.depth;
        int i = 0;
        while (i + 1 < depth.columns &&
               depth.at(i, 30) < 0.5 * (depth.at(0, 30) + depth.at(479, 30)))
            ++i;
        return i;
    };
    const auto in_order = pair();
    std::vector<Frame> frames{in_order->at(0.0).value()};
    while (auto next = in_order->after(frames.back().media_s)) frames.push_back(std::move(*next));
    REQUIRE(frames.size() == kFrames);
    for (int k = 0; k < kFrames; ++k) {
        CAPTURE(k);
        CHECK(std::abs(step_of(frames[static_cast<std::size_t>(k)]) - (75 + k)) <= 1);
    }
    const auto jumping = pair();
    for (const int k : {7, 2, 11, 10, 3, 0, 6}) {
        CAPTURE(k);
        const Frame& same = frames[static_cast<std::size_t>(k)];
        CHECK(jumping->at(same.media_s).value().depth->levels == same.depth->levels);
    }
    for (int k = kFrames - 1; k > 0; --k)
        CHECK(step_of(in_order->before(frames[static_cast<std::size_t>(k)].media_s).value()) ==
              step_of(frames[static_cast<std::size_t>(k - 1)]));
    const int half_way = step_of(reader(open_depth(folder / "clip_depth.mkv"))->at(0.4).value());
    CHECK(std::abs(half_way - 80) <= 1);
    steps.colour_edges = false;
    CHECK(step_of(pair()->at(0.4).value()) == half_way);
}
