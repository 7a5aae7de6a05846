// Sparse depth: it is told from depth with holes, and surfaces are continued between seen pixels.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/cleaning/sparse_meter.hpp"
#include "core/video/frames/colour_image.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int kWide = 200;
constexpr int kHigh = 150;
constexpr double kNearest_levels = 8000.0;
constexpr CleaningSteps kDensifyOnly{.densify = true};

using Truth = std::function<double(int i, int j)>;
using Seen = std::function<bool(int i, int j)>;

/// A way to see few pixels, and the share that is seen.
struct Sampling {
    std::string name{};
    double share{};
    Seen seen{};
};

Seen at_random(double share, unsigned seed = 7) {
    auto random = std::make_shared<std::mt19937>(seed);
    return [random, share](int, int) {
        return static_cast<int>((*random)() % 10000) < 10000.0 * share;
    };
}

/// Each sixth row, and of its pixels each second one.
bool by_lidar(int i, int j) {
    return j % 6 == 2 && i % 2 == 0;
}

std::vector<Sampling> samplings() {
    return {{"30 %", 0.3, at_random(0.3)},
            {"5 %", 0.05, at_random(0.05)},
            {"64 lines", 1.0 / 12.0, by_lidar}};
}

DepthImage seen_of(const Truth& truth, const Seen& seen, int columns = kWide, int rows = kHigh) {
    return image_of(columns, rows, kNearest_levels,
                    [&](int i, int j) { return seen(i, j) ? truth(i, j) : std::nan(""); });
}

double tilted(int i, int j) {
    return 20.0 * i + 15.0 * j;
}

/// A street before a camera: the distance is 1190 m over the rows below 40 rows above the picture.
double street(int, int j) {
    return 8000.0 - 300000.0 / (j + 40.0);
}

bool in_disc(int i, int j) {
    return (i - 100) * (i - 100) + (j - 75) * (j - 75) < 45 * 45;
}

/// A disc before a wall that is turned away.
double wall(int i, int) {
    return 1500.0 + 5.0 * i;
}
constexpr double kDisc = 6000.0;
double disc_and_wall(int i, int j) {
    return in_disc(i, j) ? kDisc : wall(i, j);
}

/// Of any size: the disc is light, the wall dark.
ColourImage disc_colours(int columns, int rows) {
    ColourImage colour{columns, rows, {}};
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const bool disc = in_disc(i * kWide / columns, j * kHigh / rows);
            for (const int shade : {180, 90, 40})
                colour.rgb.push_back(static_cast<std::uint8_t>(disc ? shade : 90));
        }
    return colour;
}

SingleFrameDepth densified(const DepthImage& image, const ColourImage* colour = nullptr) {
    return CleaningChain().clean_frame(image, {kDensifyOnly}, {}, colour);
}

/// Errors of the pixels that were not seen, in shares of the highest level, in rising order.
std::vector<double> errors_of(const DepthImage& filled, const DepthImage& seen,
                              const Truth& truth) {
    std::vector<double> errors;
    for (int j = 0; j < filled.rows; ++j)
        for (int i = 0; i < filled.columns; ++i)
            if (std::isnan(seen.at(i, j)))
                errors.push_back(std::fabs(static_cast<double>(filled.at(i, j)) - truth(i, j)) /
                                 kNearest_levels);
    std::sort(errors.begin(), errors.end());
    return errors;
}

double share_of(const std::vector<double>& rising, double share) {
    return rising.at(static_cast<std::size_t>(share * static_cast<double>(rising.size() - 1)));
}

std::optional<double> sparse_share(const DepthImage& image) {
    SparseMeter meter;
    meter.add(image);
    return meter.sparse_share();
}

}  // namespace

TEST_CASE("a plane of which few pixels are seen is a plane again", "[sparse]") {
    for (const Sampling& sampling : samplings()) {
        CAPTURE(sampling.name);
        const DepthImage seen = seen_of(tilted, sampling.seen);
        const SingleFrameDepth filled = densified(seen);
        const std::vector<double> errors = errors_of(filled.depth, seen, tilted);
        CHECK(share_of(errors, 0.5) < 0.001);
        CHECK(share_of(errors, 0.95) < 0.008);
        CHECK(filled.unseen.empty());
        for (std::size_t k = 0; k < seen.levels.size(); ++k) {
            const bool was_seen = !std::isnan(seen.levels[k]);
            REQUIRE((filled.filled[k] == 0) == was_seen);
            if (was_seen) REQUIRE(filled.depth.levels[k] == seen.levels[k]);
        }
    }
}

TEST_CASE("a street that rises by more than an object from one seen pixel to the next is no stair",
          "[sparse]") {
    for (const Sampling& sampling : samplings()) {
        CAPTURE(sampling.name);
        const DepthImage seen = seen_of(street, sampling.seen);
        const std::vector<double> errors = errors_of(densified(seen).depth, seen, street);
        CHECK(share_of(errors, 0.5) < 0.0015);
        CHECK(share_of(errors, 0.95) < 0.015);
    }
}

TEST_CASE("an outline lies at the colour's edge, whatever the colour picture's size", "[sparse]") {
    const int times = GENERATE(1, 2);
    const ColourImage colour = disc_colours(times * kWide, times * kHigh);
    for (const Sampling& sampling : samplings()) {
        CAPTURE(times, sampling.name);
        const DepthImage seen = seen_of(disc_and_wall, sampling.seen);
        const std::vector<double> errors =
            errors_of(densified(seen, &colour).depth, seen, disc_and_wall);
        CHECK(share_of(errors, 0.5) < 0.001);
        CHECK(share_of(errors, 0.95) < 0.005);
        // A picture of another size has mixed colours at its edges.
        if (times == 1) CHECK(errors.back() < 0.02);
    }
}

TEST_CASE("without colour an outline lies between seen pixels, and nothing floats before it",
          "[sparse]") {
    for (const Sampling& sampling : samplings()) {
        CAPTURE(sampling.name);
        const DepthImage seen = seen_of(disc_and_wall, sampling.seen);
        const DepthImage filled = densified(seen).depth;
        CHECK(share_of(errors_of(filled, seen, disc_and_wall), 0.95) < 0.01);
        int floating = 0;
        for (int j = 0; j < kHigh; ++j)
            for (int i = 0; i < kWide; ++i) {
                const double level = filled.at(i, j);
                const double off =
                    std::min(std::fabs(level - kDisc), std::fabs(level - wall(i, j)));
                floating += off > 0.02 * kNearest_levels ? 1 : 0;
            }
        CHECK(floating == 0);
    }
}

TEST_CASE("what is far from all seen pixels stays unseen", "[sparse]") {
    constexpr int kFirstSeenRow = 75;
    constexpr int kReach_px = 13;  // a sixteenth of the width, and a row
    const Seen lower = [few = at_random(0.05)](int i, int j) {
        return few(i, j) && j >= kFirstSeenRow;
    };
    const SingleFrameDepth filled = densified(seen_of(tilted, lower));
    REQUIRE_FALSE(filled.unseen.empty());
    int seen_above = 0;
    int unseen_below = 0;
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i) {
            const bool unseen = filled.unseen[filled.depth.index(i, j)] != 0;
            if (j < kFirstSeenRow - kReach_px && !unseen) ++seen_above;
            if (j > kFirstSeenRow + kReach_px && unseen) ++unseen_below;
        }
    CHECK(seen_above == 0);
    CHECK(unseen_below == 0);
}

TEST_CASE("spread pixels are sparse depth, at random, in lines, or as dots", "[sparse]") {
    for (const double share : {0.5, 0.3, 0.05, 0.01}) {
        CAPTURE(share);
        const auto found = sparse_share(seen_of(tilted, at_random(share)));
        REQUIRE(found);
        CHECK_THAT(*found, WithinAbs(share, 0.2 * share));
    }
    CHECK(sparse_share(seen_of(tilted, by_lidar)));
    CHECK(sparse_share(seen_of(tilted, [](int i, int j) { return j > 60 && by_lidar(i, j); })));
    CHECK(sparse_share(seen_of(tilted, [](int i, int j) { return i % 12 < 3 && j % 12 < 3; })));
}

TEST_CASE("holes are no sparse depth, however large or many they are", "[sparse]") {
    const auto [name, seen] = GENERATE(table<std::string, Seen>(
        {{"none", [](int, int) { return true; }},
         {"70 % in a region", [](int i, int) { return i < 60; }},
         {"70 % in regions", [](int i, int j) { return i % 40 < 22 && j % 40 < 22; }},
         {"stripes", [](int i, int j) { return (i + j) % 40 < 14; }},
         {"flickering pixels", at_random(0.9)},
         {"flickering pixels around regions",
          [few = at_random(0.85)](int i, int j) { return i % 40 < 26 && j > 40 && few(i, j); }},
         {"a thin plant", [](int i, int j) { return i == 100 || (i > 80 && i < 130 && j == 40); }},
         {"nothing", [](int, int) { return false; }}}));
    CAPTURE(name);
    CHECK_FALSE(sparse_share(seen_of(tilted, seen)));
}

TEST_CASE("sparse depth is densified by all presets but raw, and by own steps as they are",
          "[sparse]") {
    const CleaningPreset preset =
        GENERATE(CleaningPreset::automatic, CleaningPreset::gentle, CleaningPreset::sensor,
                 CleaningPreset::raw, CleaningPreset::own);
    const bool adds = preset != CleaningPreset::raw && preset != CleaningPreset::own;
    CHECK(plan_of({.preset = preset}, {}, 1000, true).steps.densify == adds);
    CHECK_FALSE(plan_of({.preset = preset}, {}, 1000, false).steps.densify);
    const CleaningOptions own{.preset = CleaningPreset::own, .own = kDensifyOnly};
    CHECK(plan_of(own, {}, 1000, false).steps == kDensifyOnly);
}

TEST_CASE("densifying changes no picture without holes, and always gives the same bits",
          "[sparse]") {
    const DepthImage whole = seen_of(disc_and_wall, [](int, int) { return true; });
    CHECK(densified(whole).depth.levels == whole.levels);
    const ColourImage colour = disc_colours(kWide, kHigh);
    const DepthImage few = seen_of(disc_and_wall, at_random(0.05));
    CleaningChain used;
    (void)used.clean_frame(seen_of(tilted, at_random(0.3), 64, 48), {kDensifyOnly});
    CHECK(used.clean_frame(few, {kDensifyOnly}, {}, &colour).depth.levels ==
          densified(few, &colour).depth.levels);
}

TEST_CASE("levels that were held are not needed where sparse depth is interpolated", "[sparse]") {
    CleaningPlan plan{kGentleSteps};
    plan.steps.densify = true;
    DepthMemory memory;
    CleaningChain chain;
    for (const unsigned seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        const DepthImage image = seen_of(tilted, at_random(0.1, seed));
        const auto held = memory.take(image, seed / 30.0);
        const DepthImage alone = CleaningChain().clean_frame(image, plan).depth;
        CHECK(chain.clean_frame(image, plan, held).depth.levels == alone.levels);
    }
}

TEST_CASE("the work for a picture is bounded, however few pixels are seen", "[sparse]") {
    SparseInterpolator interpolator;
    int before = 0;
    for (const double share : {0.3, 0.05, 0.01, 0.001}) {
        CAPTURE(share);
        DepthImage image = seen_of(tilted, at_random(share));
        interpolator.fill(image, nullptr);
        CHECK(interpolator.rounds() >= before);
        CHECK(interpolator.rounds() <= SparseInterpolator::kMostRounds);
        before = interpolator.rounds();
    }
    DepthImage nothing = seen_of(tilted, [](int, int) { return false; });
    interpolator.fill(nothing, nullptr);
    CHECK(interpolator.rounds() == 0);
}

TEST_CASE("a file of sparse depth is opened as such, and its notice says so", "[sparse]") {
    const TemporaryFolder folder;
    const auto mm = [](int i, int j) { return static_cast<int>(9000.0 - disc_and_wall(i, j)); };
    const Seen seen = at_random(0.05);
    write_picture(folder / "a_depth.png", kWide, kHigh, 16, 1,
                  [&](int i, int j, int) { return seen(i, j) ? mm(i, j) : 0; });
    write_picture(folder / "a_color.png", kWide, kHigh, 8, 3,
                  [](int i, int j, int) { return in_disc(i, j) ? 180 : 90; });
    auto media =
        open_media(folder / "a_color.png", folder / "a_depth.png",
                   {.find_out = true, .command_line = {.unit = DepthUnit::mm, .scale = 1.0}});
    const MediaDescription description = media->description();
    REQUIRE(description.sparse_share);
    CHECK_THAT(*description.sparse_share, WithinAbs(0.05, 0.005));
    CHECK(contains(description.notice, "% of the pixels are seen"));
    const double far_mm = description.meaning.value().range.value.far;
    FrameReader reader(std::move(media));
    const Frame frame = reader.at(0.0).value();
    CHECK(frame.cleaning.steps.densify);
    std::vector<double> errors;
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i)
            errors.push_back(
                std::fabs(static_cast<double>(frame.depth->at(i, j)) - (far_mm - mm(i, j))) /
                frame.depth->highest_level);
    std::sort(errors.begin(), errors.end());
    CHECK(share_of(errors, 0.5) < 0.002);
    CHECK(share_of(errors, 0.95) < 0.02);
    reader.set_cleaning({.preset = CleaningPreset::raw});
    CHECK_FALSE(reader.at(0.0).value().cleaning.steps.densify);
}
