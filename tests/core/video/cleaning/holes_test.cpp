// Holes: which levels fill them, for how long, and which areas were never seen.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/cleaning/holes/large_holes.hpp"
#include "core/video/cleaning/patches.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/pits.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/listed_media.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int kColumns = 160;
constexpr int kRows = 120;
constexpr double kHighest = 3000.0;  // millimetres
constexpr double kFrame_s = 1.0 / 30.0;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr double kPixel_levels = kHighest / kRelief_px;

using Level = std::function<double(int i, int j)>;
using Lost = std::function<bool(int i, int j)>;

DepthImage image_with(const Level& level, const Lost& lost = {}) {
    return image_of(kColumns, kRows, kHighest, [&](int i, int j) {
        return lost && lost(i, j) ? static_cast<double>(kNone) : level(i, j);
    });
}

double plane(int i, int j) {
    return 900.0 + 4.0 * i + 2.0 * j;
}

/// A box before a slanted wall.
double box(int i, int j) {
    return i >= 50 && i < 100 && j >= 30 && j < 90 ? 2400.0 : plane(i, j);
}

/// Two boxes with no data behind them.
double far_and_near_box(int i, int j) {
    if (i >= 20 && i < 60 && j >= 30 && j < 90) return 1200.0;
    return i >= 100 && i < 140 && j >= 30 && j < 90 ? 2500.0 : static_cast<double>(kNone);
}

/// Noise, pixels that flicker, and holes that are always there.
struct Recording {
    Level scene{};
    double flicker{0.0};  ///< the share of pixels without data in a frame
    Lost always{};
    double noise_levels{6.0};

    [[nodiscard]] std::vector<DepthImage> frames(int count) const {
        std::mt19937 random(5);
        std::normal_distribution<double> noise(0.0, noise_levels);
        std::uniform_real_distribution<double> chance(0.0, 1.0);
        std::vector<DepthImage> made;
        for (int k = 0; k < count; ++k)
            made.push_back(image_with(
                [&](int i, int j) {
                    return std::clamp(scene(i, j) + noise(random), 0.0, kHighest);
                },
                [&](int i, int j) {
                    const bool flickers = chance(random) < flicker;
                    return flickers || (always && always(i, j));
                }));
        return made;
    }
};

/// What fills holes alone: smoothing outlines rounds corners by a pixel, also where nothing was
/// seen behind them.
constexpr CleaningSteps kHolesAlone{.remove_spikes = true, .fill_holes = true};

/// Cleans frames with a memory of depth, as the reader does.
std::vector<DepthImage> cleaned(const std::vector<DepthImage>& frames,
                                const CleaningSteps& steps = kGentleSteps) {
    DepthMemory memory;
    CleaningChain chain;
    std::vector<DepthImage> done;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const auto held = memory.take(frames[k], static_cast<double>(k) * kFrame_s);
        done.push_back(*chain.clean_and_finish(frames[k], {steps}, held).depth);
    }
    return done;
}

DepthImage cleaned(const DepthImage& image, const CleaningSteps& steps = kGentleSteps) {
    return cleaned(std::vector<DepthImage>{image}, steps).front();
}

std::vector<std::uint8_t> unseen_of(const DepthImage& image,
                                    const CleaningSteps& steps = kGentleSteps) {
    const auto unseen = CleaningChain().clean_and_finish(image, {steps}).unseen;
    return unseen ? *unseen : std::vector<std::uint8_t>{};
}

bool same(const DepthImage& a, const DepthImage& b) {
    return a.levels == b.levels;
}

bool in_rectangle(int i, int j, int left, int top, int width, int height) {
    return i >= left && i < left + width && j >= top && j < top + height;
}

}  // namespace

TEST_CASE("nothing falls into a hole, wherever it is and however it flickers", "[holes]") {
    const double flicker = GENERATE(some_of<double>({0.013, 0.0, 0.007, 0.06}, 1));
    const Level scene = GENERATE(some_of<Level>({box, plane, far_and_near_box}, 1));
    const Lost always = GENERATE(
        Lost([](int, int) { return false; }),
        Lost([](int i, int j) { return in_rectangle(i, j, 60, 40, 30, 30); }),   // in the box
        Lost([](int i, int j) { return in_rectangle(i, j, 90, 10, 24, 100); }),  // at its rim
        Lost([](int i, int) { return i < 30; }),                                 // at the border
        Lost([](int i, int j) { return (i + j) % 40 < 26; }),
        Lost([](int i, int j) { return (i - 80) * (i - 80) + (j - 60) * (j - 60) > 1000; }));
    CAPTURE(flicker);
    const std::vector<DepthImage> raw = Recording{scene, flicker, always}.frames(4);
    const std::vector<DepthImage> done = cleaned(raw, kHolesAlone);
    for (std::size_t k = 0; k < raw.size(); ++k) CHECK(count_pits(raw[k], done[k]) == 0);
}

TEST_CASE("a hole's level is at most a pit below the lowest around, whatever is in its row",
          "[holes]") {
    constexpr float kPit = 0.015F * static_cast<float>(kHighest);
    constexpr int kReach_px = 10;
    const Lost lost =
        GENERATE(Lost([](int i, int j) { return (7 * i + 11 * j) % 31 == 0; }),  // single pixels
                 Lost([](int, int j) { return j % 25 < 4; }),                    // whole rows
                 Lost([](int i, int) { return i % 40 < 23; }),                   // whole columns
                 Lost([](int i, int j) { return i < 100 && j < 100; }));
    const DepthImage seen = image_with(box, lost);
    std::mt19937 random(3);
    DepthImage image = seen;  // with any levels in its holes
    for (float& level : image.levels)
        if (std::isnan(level)) level = static_cast<float>(random() % 3000);
    DepthImage lifted = image;
    std::vector<std::uint8_t> unseen(seen.levels.size());
    LargeHoleFiller().fill(lifted, seen, {}, unseen);
    int other = 0;  // pixels
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i) {
            float lowest = std::numeric_limits<float>::infinity();
            for (int y = std::max(j - kReach_px, 0); y <= std::min(j + kReach_px, kRows - 1); ++y)
                for (int x = std::max(i - kReach_px, 0); x <= std::min(i + kReach_px, kColumns - 1);
                     ++x)
                    if ((x - i) * (x - i) + (y - j) * (y - j) <= kReach_px * kReach_px &&
                        !std::isnan(seen.at(x, y)))
                        lowest = std::min(lowest, seen.at(x, y));
            const bool is_lifted = std::isnan(seen.at(i, j)) && std::isfinite(lowest);
            const float level = image.at(i, j);
            other +=
                lifted.at(i, j) != (is_lifted ? std::max(level, lowest - kPit) : level) ? 1 : 0;
        }
    CHECK(other == 0);
}

TEST_CASE("a finger at rest stays in contact where data flickers", "[holes]") {
    const double flicker = GENERATE(some_of<double>({0.013, 0.007, 0.06}, 1));
    const Level scene = GENERATE(Level(plane), Level(box), Level(far_and_near_box));
    const Lost always = [](int i, int j) { return in_rectangle(i, j, 60, 40, 30, 30); };
    CAPTURE(flicker);
    const std::vector<DepthImage> done = cleaned(Recording{scene, flicker, always}.frames(60));
    std::mt19937 random(9);
    double least = 1.0;
    for (int spot = 0; spot < 300; ++spot)
        least =
            std::min(least, contact_share(done, random() % done.front().levels.size(), kFrame_s));
    CHECK(least == 1.0);
}

TEST_CASE("a small hole between an object and what is behind it takes what is behind", "[holes]") {
    const auto [left, top, width, height] = GENERATE(table<int, int, int, int>(
        {{100, 50, 6, 6}, {98, 50, 6, 6}, {44, 50, 6, 8}, {70, 24, 8, 6}, {97, 87, 6, 6}}));
    CAPTURE(left, top);
    const DepthImage filled = cleaned(
        image_with(box, [&, left = left, top = top, width = width, height = height](
                            int i, int j) { return in_rectangle(i, j, left, top, width, height); }),
        kHolesAlone);
    double farthest_off = 0.0;
    for (int j = top; j < top + height; ++j)
        for (int i = left; i < left + width; ++i)
            farthest_off = std::max(farthest_off, std::fabs(filled.at(i, j) - plane(i, j)));
    CHECK(farthest_off < 3.0 * kPixel_levels);
}

TEST_CASE("what is not behind anything is averaged: noise does not pull a hole down", "[holes]") {
    Recording noisy{[](int, int) { return 1500.0; }};
    noisy.noise_levels = 20.0;
    noisy.always = [](int i, int j) { return i % 20 < 6 && j % 20 < 6; };
    const DepthImage raw = noisy.frames(1).front();
    const DepthImage filled = cleaned(raw);
    double sum = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < raw.levels.size(); ++k)
        if (std::isnan(raw.levels[k])) {
            sum += static_cast<double>(filled.levels[k]);
            ++count;
        }
    CHECK_THAT(sum / count, WithinAbs(1500.0, 2.0));
}

TEST_CASE("a large hole within an object is bridged", "[holes]") {
    const DepthImage filled =
        cleaned(image_with(box, [](int i, int j) { return in_rectangle(i, j, 66, 50, 18, 18); }));
    for (int i = 66; i < 84; ++i) CHECK_THAT(filled.at(i, 59), WithinAbs(2400.0, 1.0));
}

TEST_CASE("what was never seen is the farthest, and told apart", "[holes]") {
    const DepthImage raw = image_with(far_and_near_box);
    const DepthImage filled = cleaned(raw);
    const std::vector<std::uint8_t> unseen = unseen_of(raw);
    REQUIRE(unseen.size() == raw.levels.size());
    CHECK(filled.at(80, 110) == 0.0F);
    CHECK(unseen[raw.index(80, 110)] == 1);
    CHECK(unseen[raw.index(62, 60)] == 1);  // right beside a box, too
    CHECK(unseen[raw.index(40, 60)] == 0);
}

TEST_CASE("a small patch of data alone in a hole is refused", "[holes]") {
    const auto scene = [](int i, int j) {
        return in_rectangle(i, j, 10, 10, 1, 3) ? 2900.0 : far_and_near_box(i, j);
    };
    CHECK(same(cleaned(image_with(scene)), cleaned(image_with(far_and_near_box))));
}

TEST_CASE("nothing falls away beside data that was refused", "[holes]") {
    std::mt19937 random(3);
    const Level sparkling = [&](int i, int j) {
        const double level = far_and_near_box(i, j);
        const bool sparkles = std::isnan(level) && random() % 100 == 0;
        return sparkles ? static_cast<double>(random() % 3000) : level;
    };
    const std::vector<DepthImage> raw = Recording{sparkling, 0.013}.frames(6);
    const std::vector<DepthImage> done = cleaned(raw, kHolesAlone);
    for (std::size_t k = 0; k < raw.size(); ++k)
        CHECK(count_pits(raw[k], done[k], Pits::in_holes) == 0);
}

TEST_CASE("small holes and whole images have nothing unseen", "[holes]") {
    CHECK(unseen_of(image_with(plane)).empty());
    CHECK(unseen_of(image_with(plane, [](int i, int j) {
              return i % 30 < 6 && j % 30 < 6;
          })).empty());
}

TEST_CASE("an image without any data is unseen all over", "[holes]") {
    const DepthImage nothing = image_with([](int, int) { return static_cast<double>(kNone); });
    const std::vector<std::uint8_t> unseen = unseen_of(nothing);
    CHECK(std::count(unseen.begin(), unseen.end(), 1) == kColumns * kRows);
    const DepthImage filled = cleaned(nothing);
    CHECK(std::count(filled.levels.begin(), filled.levels.end(), 0.0F) == kColumns * kRows);
}

TEST_CASE("without filling, no data is unseen and the farthest", "[holes]") {
    const auto lost = [](int i, int j) { return in_rectangle(i, j, 60, 40, 5, 5); };
    const std::vector<std::uint8_t> unseen = unseen_of(image_with(plane, lost), kRawSteps);
    CHECK(std::count(unseen.begin(), unseen.end(), 1) == 25);
    const DepthImage raw =
        *CleaningChain().clean_and_finish(image_with(plane, lost), {kRawSteps}).depth;
    CHECK(raw.at(62, 42) == 0.0F);
    CHECK(raw.at(59, 42) == static_cast<float>(plane(59, 42)));
}

TEST_CASE("a pixel that loses its data keeps its last level for a second", "[holes]") {
    // A step in the middle of the hole, of which no rim gives evidence.
    const auto scene = [](int i, int j) { return i < 80 ? plane(i, j) : plane(i, j) + 40.0; };
    const auto lost = [](int i, int j) { return in_rectangle(i, j, 70, 50, 20, 20); };
    std::vector<DepthImage> frames{image_with(scene)};
    for (int k = 1; k < 40; ++k) frames.push_back(image_with(scene, lost));
    const std::vector<DepthImage> done = cleaned(frames);
    for (std::size_t k = 1; k < 30; ++k) CHECK(same(done[k], frames[0]));
    CHECK_FALSE(same(done[30], frames[0]));
}

TEST_CASE("a new level is used at once", "[holes]") {
    const auto lost = [](int i, int j) { return in_rectangle(i, j, 70, 50, 6, 6); };
    const auto farther = [](int i, int j) { return plane(i, j) - 40.0; };
    const std::vector<DepthImage> frames{image_with(plane), image_with(plane, lost),
                                         image_with(farther)};
    CHECK(same(cleaned(frames)[2], frames[2]));
}

TEST_CASE("what moved away leaves no ghost in the hole behind it", "[holes]") {
    // A hand moves to the right before a wall; the wall is lost for a while where the hand was.
    const auto wall = [](int, int) { return 600.0; };
    const auto hand = [&](int k) {
        return [k, wall](int i, int j) {
            return in_rectangle(i, j, 20 + 8 * k, 40, 30, 40) ? 2200.0 : wall(i, j);
        };
    };
    std::vector<DepthImage> frames;
    for (int k = 0; k < 8; ++k)
        frames.push_back(image_with(
            hand(k), [k](int i, int j) { return in_rectangle(i, j, 10 + 8 * k, 40, 10, 40); }));
    const DepthImage done = cleaned(frames).back();
    CHECK(done.at(70, 60) <= 600.0F + outline_levels(done));  // the hand was there a frame before
    CHECK(done.at(76, 60) == 2200.0F);
}

TEST_CASE("a frame has the same bits whichever way it was come to", "[holes]") {
    const auto frames = Recording{
        box, 0.06, [](int i, int j) {
            return in_rectangle(i, j, 60, 40, 30, 30);
        }}.frames(75);
    const std::vector<DepthImage> in_order = cleaned(frames);
    const auto frame_s = [](int k) { return static_cast<double>(k) * kFrame_s; };
    const auto is_frame = [&](const std::optional<Frame>& frame, int k) {
        return frame && frame->index == k &&
               frame->depth->levels == in_order[static_cast<std::size_t>(k)].levels;
    };
    FrameReader reader(std::make_unique<ListedMedia>(frames, kFrame_s));
    reader.set_cleaning({.preset = CleaningPreset::gentle});
    SECTION("sought") {
        for (const int k : {50, 3, 74, 31, 0, 60, 29}) CHECK(is_frame(reader.at(frame_s(k)), k));
    }
    SECTION("stepped back") {
        CHECK(is_frame(reader.at(frame_s(74)), 74));
        for (int k = 74; k > 0; --k) CHECK(is_frame(reader.before(frame_s(k)), k - 1));
    }
    SECTION("played on from a jump, and cleaned anew") {
        CHECK(is_frame(reader.at(frame_s(40)), 40));
        for (int k = 40; k < 74; ++k) CHECK(is_frame(reader.after(frame_s(k)), k + 1));
        reader.set_cleaning({.preset = CleaningPreset::raw});
        CHECK_FALSE(is_frame(reader.at(frame_s(70)), 70));
        reader.set_cleaning({.preset = CleaningPreset::gentle});
        CHECK(is_frame(reader.at(frame_s(70)), 70));
    }
}

TEST_CASE("a seek reads a second back only to a frame with holes", "[holes]") {
    const bool holed = GENERATE(false, true);
    const auto lost = [holed](int i, int j) { return holed && i == 70 && j == 50; };
    int read = 0;
    FrameReader reader(std::make_unique<ListedMedia>(
        std::vector<DepthImage>(75, image_with(plane, lost)), kFrame_s, &read));
    reader.set_cleaning({.preset = CleaningPreset::gentle});
    REQUIRE(reader.at(60 * kFrame_s));
    CHECK((holed ? read >= 31 && read <= 34 : read == 1));
}

TEST_CASE("where nothing was ever seen is told with the frame", "[holes]") {
    FrameReader reader(std::make_unique<ListedMedia>(
        std::vector<DepthImage>{image_with(far_and_near_box), image_with(plane)}, kFrame_s));
    const auto first = reader.at(0.0);
    REQUIRE((first && first->unseen));
    CHECK(first->unseen->size() == first->depth->levels.size());
    const auto second = reader.after(0.0);
    CHECK((second && !second->unseen));
}

TEST_CASE("a steadied frame has the same bits whichever way it was come to", "[holes]") {
    const auto frames = Recording{
        box, 0.06, [](int i, int j) {
            return in_rectangle(i, j, 60, 40, 30, 30);
        }}.frames(60);
    const auto frame_s = [](int k) { return static_cast<double>(k) * kFrame_s; };
    std::vector<DepthImage> in_order;
    FrameReader forward(std::make_unique<ListedMedia>(frames, kFrame_s));
    forward.set_cleaning({.preset = CleaningPreset::sensor});
    in_order.push_back(*forward.at(0.0)->depth);
    for (int k = 0; k < 59; ++k) in_order.push_back(*forward.after(frame_s(k))->depth);
    FrameReader other(std::make_unique<ListedMedia>(frames, kFrame_s));
    other.set_cleaning({.preset = CleaningPreset::raw});
    (void)other.at(frame_s(20));
    other.set_cleaning({.preset = CleaningPreset::sensor});
    for (const int k : {50, 3, 59, 31, 0, 29})
        CHECK(same(*other.at(frame_s(k))->depth, in_order[static_cast<std::size_t>(k)]));
    for (int k = 40; k > 30; --k)
        CHECK(same(*other.before(frame_s(k))->depth, in_order[static_cast<std::size_t>(k - 1)]));
}

TEST_CASE("after a jump nothing is known of what was seen before it", "[holes]") {
    const auto level = [](int, int) { return 100.0; };
    const DepthImage whole = image_with(level, [](int, int) { return false; });
    const DepthImage pitted = image_with(level, [](int i, int j) { return i == j; });
    const DepthImage before = GENERATE_COPY(whole, pitted);
    DepthMemory memory;
    CHECK(memory.take(before, 0.0).empty());
    memory.forget();
    CHECK(memory.take(pitted, kFrame_s).empty());
}

TEST_CASE("runs of marks are those found mark by mark, at any length and value", "[holes]") {
    std::mt19937 random(11);
    const auto any_of = [&random](int most) {
        return std::uniform_int_distribution<int>(0, most)(random);
    };
    for (int count = 0; count < 200; ++count) {
        // Long runs of marks, and of none, of any values.
        std::vector<std::uint8_t> marks(static_cast<std::size_t>(count));
        const int change = 1 + any_of(20);
        int mark = 0;
        for (std::uint8_t& at : marks) {
            if (any_of(change) == 0) mark = any_of(1) == 0 ? 0 : 1 + any_of(254);
            at = static_cast<std::uint8_t>(mark);
        }
        std::vector<std::uint8_t> visited(marks.size(), 0);
        int last = -1;
        visit_marked(marks.data(), count, [&](int begin, int end) {
            CHECK(begin > last);
            CHECK(end > begin);
            for (int i = begin; i < end; ++i) visited[static_cast<std::size_t>(i)] = 1;
            last = end;
        });
        for (std::size_t i = 0; i < marks.size(); ++i)
            if ((marks[i] != 0) != (visited[i] != 0)) FAIL("mark " << i << " of " << count);
    }
}
