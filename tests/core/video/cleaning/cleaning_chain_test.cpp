// Cleaning: holes, spikes and 8-bit steps, and what cleaning must never do.
#include "core/video/cleaning/cleaning_chain.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <thread>
#include <utility>

#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr CleaningSteps kHolesOnly{.fill_holes = true};
constexpr CleaningSteps kSpikesOnly{.remove_spikes = true};
constexpr CleaningSteps kStepsOnly{.smooth_steps = true};

const double kNone = std::nan("");

DepthImage chain_input(int columns, int rows, const std::function<double(int, int)>& level,
                       double highest_level = 255.0) {
    DepthImage image{columns, rows, highest_level, {}};
    image.levels.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) image.at(i, j) = static_cast<float>(level(i, j));
    return image;
}

/// The image with level 0 where it has no data.
DepthImage with_back_wall(DepthImage image) {
    for (float& level : image.levels)
        if (std::isnan(level)) level = 0.0F;
    return image;
}

DepthImage cleaned(DepthImage image, const CleaningSteps& steps) {
    return *CleaningChain().clean_and_finish(std::move(image), {steps}).depth;
}

double largest_difference(const DepthImage& a, const DepthImage& b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < a.levels.size(); ++k)
        largest = std::max(largest, static_cast<double>(std::fabs(a.levels[k] - b.levels[k])));
    return largest;
}

/// Root mean square of the differences of slopes along rows and columns from the plane's slope.
double slope_error(const DepthImage& image, double along_row, double along_column) {
    double sum = 0.0;
    int count = 0;
    for (int j = 0; j + 1 < image.rows; ++j)
        for (int i = 0; i + 1 < image.columns; ++i, count += 2) {
            const double here = image.at(i, j);
            const double across = image.at(i + 1, j) - here - along_row;
            const double down = image.at(i, j + 1) - here - along_column;
            sum += across * across + down * down;
        }
    return std::sqrt(sum / count);
}

/// An image with everything that real depth has: slopes, cliffs, noise, spikes, holes of all sizes.
DepthImage hostile(unsigned seed, double highest_level = 255.0) {
    std::mt19937 random(seed);
    const double scale = highest_level / 255.0;
    return chain_input(
        97, 61,
        [&](int i, int j) {
            if (random() % 20 == 0 || (i > 60 && j > 40)) return kNone;
            if (random() % 50 == 0) return highest_level;
            const double level =
                60.0 + 0.3 * i + 30.0 * std::sin(0.1 * j) + (i / 30 == 1 ? 90.0 : 0.0);
            return std::round(scale * (level + static_cast<double>(random() % 3)));
        },
        highest_level);
}

}  // namespace

TEST_CASE("cleaning that is off leaves every level as it is, and no data at the farthest",
          "[cleaning]") {
    const double highest = GENERATE(255.0, 65535.0);
    const DepthImage image = hostile(1, highest);
    CHECK(cleaned(image, kRawSteps).levels == with_back_wall(image).levels);
}

TEST_CASE("the same image always gives the same bits", "[cleaning]") {
    const DepthImage image = hostile(2);
    const CleaningPlan plan{kSensorSteps, {}, {.constant = 0.01F}};
    CleaningChain used;
    (void)used.clean_and_finish(hostile(3), plan);
    CHECK(used.clean_and_finish(image, plan).depth->levels ==
          CleaningChain().clean_and_finish(image, plan).depth->levels);
}

TEST_CASE("a frame finished in its own memory has the bits of one that is copied", "[cleaning]") {
    const CleaningSteps steps = GENERATE(kRawSteps, kGentleSteps, kSensorSteps);
    const CleaningPlan plan{steps, {}, {.constant = 0.01F}};
    CleaningChain chain;
    const SingleFrameDepth cleaned = chain.clean_frame(hostile(3), plan);
    const SingleFrameDepth* const frames = &cleaned;
    const Frame copied = chain.finish_frame({&frames, 1}, 0, plan);
    SingleFrameDepth alone = cleaned;
    const Frame own = chain.felt(chain.settle(std::move(alone), plan));
    CHECK(own.depth->levels == copied.depth->levels);
    CHECK((own.unseen == nullptr) == (copied.unseen == nullptr));
    CHECK((own.unseen == nullptr || *own.unseen == *copied.unseen));
}

TEST_CASE("the memory of a frame that nothing holds is that of a later one, on any thread",
          "[cleaning]") {
    CleaningChain chain;
    ObjectPool<DepthImage> images = chain.images();
    CHECK(images.take_out().levels.empty());
    Frame frame = chain.clean_and_finish(hostile(3), {kRawSteps});
    const float* const memory = frame.depth->levels.data();
    CHECK(images.take_out().levels.data() != memory);
    std::thread([&frame] { frame = {}; }).join();
    CHECK(images.take_out().levels.data() == memory);
    CHECK(images.take_out().levels.empty());
}

TEST_CASE("smoothing keeps every pixel within half a level, in range, and the farthest farthest",
          "[cleaning]") {
    const unsigned seed = GENERATE(range(10U, 20U));
    CAPTURE(seed);
    const DepthImage image = with_back_wall(hostile(seed));
    const DepthImage smooth = cleaned(image, kStepsOnly);
    CHECK(largest_difference(image, smooth) <= 0.5);
    CHECK(largest_difference(image, smooth) > 0.0);
    bool in_range = true;
    bool holes_kept = true;
    for (std::size_t k = 0; k < image.levels.size(); ++k) {
        in_range = in_range && smooth.levels[k] >= 0.0F && smooth.levels[k] <= 255.0F;
        holes_kept = holes_kept && (image.levels[k] != 0.0F || smooth.levels[k] == 0.0F);
    }
    CHECK(in_range);
    CHECK(holes_kept);
}

TEST_CASE("real numbers beyond the range of levels are smoothed as its ends", "[cleaning]") {
    DepthImage image = chain_input(70, 20, [](int i, int) { return std::floor(100.0 + 0.2 * i); });
    image.at(20, 10) = -5.0F;
    image.at(40, 10) = 600.0F;
    image.at(60, 10) = 1e12F;
    StepSmoother().smooth(image);
    for (const float level : image.levels) {
        REQUIRE(level >= 0.0F);
        REQUIRE(level <= 255.0F);
    }
    CHECK(image.at(20, 10) == 0.0F);
    CHECK(image.at(60, 10) == 255.0F);
    CHECK(std::fabs(image.at(20, 13) - 104.0F) <= 0.5F);
}

TEST_CASE("images of any size are smoothed by a smoother that has seen others as by a new one",
          "[cleaning]") {
    StepSmoother used;
    for (const int columns : {2, 31, 32, 33, 64, 33, 2}) {
        for (const int rows : {2, 40, 3, 100}) {
            DepthImage image = chain_input(columns, rows, [](int i, int j) {
                return std::floor(60.0 + 0.3 * i + 0.1 * j) + (i * 7 + j * 5) % 3;
            });
            DepthImage other = image;
            used.smooth(image);
            StepSmoother().smooth(other);
            CAPTURE(columns, rows);
            CHECK(image.levels == other.levels);
        }
    }
}

TEST_CASE("smoothing adds at most half a level to what filling and spike removal gave",
          "[cleaning]") {
    constexpr CleaningSteps kWithSmoothSteps{
        .remove_spikes = true, .fill_holes = true, .smooth_steps = true};
    const DepthImage image = hostile(GENERATE(range(30U, 35U)));
    // Filled levels lie between whole ones, so half a level from them has the rounding of floats.
    CHECK(largest_difference(cleaned(image, {.remove_spikes = true, .fill_holes = true}),
                             cleaned(image, kWithSmoothSteps)) < 0.50001);
}

TEST_CASE("a flat image stays flat, however often it is cleaned", "[cleaning]") {
    const double level = GENERATE(0.0, 1.0, 128.0, 255.0);
    const DepthImage flat = chain_input(50, 40, [&](int, int) { return level; });
    CHECK(cleaned(cleaned(flat, kGentleSteps), kGentleSteps).levels == flat.levels);
}

TEST_CASE("a plane cut into 8-bit terraces becomes a slope again", "[cleaning]") {
    const auto [across, down] =
        GENERATE(table<double, double>({{0.1, 0.05}, {0.3, 0.0}, {0.0, 0.07}, {0.2, -0.13}}));
    CAPTURE(across, down);
    const auto plane = [across = across, down = down](int i, int j) {
        return std::round(100.0 + across * i + down * j);
    };
    const DepthImage stepped = chain_input(200, 160, plane);
    const DepthImage smooth = cleaned(stepped, kStepsOnly);
    CHECK(slope_error(smooth, across, down) < 0.25 * slope_error(stepped, across, down));
    CHECK(slope_error(smooth, across, down) < 0.05);
}

TEST_CASE("a curved surface in 8 bits becomes smoother, too", "[cleaning]") {
    const auto wave = [](int i, int j) {
        return 128.0 + 90.0 * std::sin(0.02 * i) * std::cos(0.017 * j);
    };
    const DepthImage exact = chain_input(320, 240, wave);
    const DepthImage stepped =
        chain_input(320, 240, [&](int i, int j) { return std::round(wave(i, j)); });
    const auto roughness = [&](const DepthImage& image) {
        DepthImage difference = image;
        for (std::size_t k = 0; k < difference.levels.size(); ++k)
            difference.levels[k] -= exact.levels[k];
        return slope_error(difference, 0.0, 0.0);
    };
    CHECK(roughness(cleaned(stepped, kStepsOnly)) < 0.25 * roughness(stepped));
}

TEST_CASE("a real edge keeps its height and its place", "[cleaning]") {
    const DepthImage cliff = chain_input(60, 40, [](int i, int) { return i < 30 ? 50.0 : 150.0; });
    CHECK(cleaned(cliff, kGentleSteps).levels == cliff.levels);
}

TEST_CASE("16-bit levels are small: they are not smoothed", "[cleaning]") {
    const DepthImage image = hostile(4, 65535.0);
    CHECK(cleaned(image, kStepsOnly).levels == with_back_wall(image).levels);
}

TEST_CASE("a small hole in a plane is filled with the plane", "[cleaning]") {
    const auto [left, top, width, height] = GENERATE(table<int, int, int, int>(
        {{50, 40, 1, 1}, {50, 40, 7, 7}, {50, 40, 10, 3}, {30, 20, 2, 10}}));
    CAPTURE(width, height);
    const auto plane = [](int i, int j) { return 80.0 + 0.25 * i + 0.5 * j; };
    const DepthImage whole = chain_input(200, 100, plane);
    DepthImage holed = whole;
    for (int j = top; j < top + height; ++j)
        for (int i = left; i < left + width; ++i) holed.at(i, j) = std::nanf("");
    CHECK_THAT(largest_difference(cleaned(holed, kHolesOnly), whole), WithinAbs(0.0, 1e-4));
}

TEST_CASE("small holes are filled from within the levels around them, at the border too",
          "[cleaning]") {
    std::mt19937 random(5);
    DepthImage image = chain_input(160, 90, [](int i, int j) { return 90.0 + (i + 2 * j) % 60; });
    for (int k = 0; k < 40; ++k) {
        const int i = static_cast<int>(random() % 157);
        const int j = static_cast<int>(random() % 87);
        for (int n = 0; n < 9; ++n) image.at(i + n % 3, j + n / 3) = std::nanf("");
    }
    for (int i = 0; i < 5; ++i) image.at(i, 0) = std::nanf("");
    const DepthImage filled = cleaned(image, kHolesOnly);
    const auto [low, high] = std::minmax_element(filled.levels.begin(), filled.levels.end());
    CHECK(*low >= 90.0F);
    CHECK(*high <= 149.0F);
}

TEST_CASE("holes in the highest level are no higher, whatever number that is", "[cleaning]") {
    for (int k = 1; k < 400; ++k) {
        const double highest = 13625.0 * k / 7.0;
        const DepthImage image = cleaned(
            chain_input(
                90, 60,
                [&](int i, int j) {
                    const bool small = i % 9 < 3 && j % 7 < 1 + i / 30;
                    const bool large = i > 60 && j > 20;
                    return small || large ? kNone
                                          : static_cast<double>(static_cast<float>(highest));
                },
                highest),
            kGentleSteps);
        const auto [lowest, most] = std::minmax_element(image.levels.begin(), image.levels.end());
        REQUIRE(*lowest >= 0.0F);
        REQUIRE(*most == static_cast<float>(highest));
    }
}

TEST_CASE("a single pixel that stands out of all its neighbours takes their median", "[cleaning]") {
    const auto [highest, level, spike] =
        GENERATE(table<double, double, double>({{255.0, 100.0, 130.0},
                                                {255.0, 100.0, 5.0},
                                                {65535.0, 1500.0, 65535.0},
                                                {65535.0, 1500.0, 900.0}}));
    CAPTURE(highest, spike);
    const DepthImage clean = chain_input(
        20, 20, [level = level](int i, int j) { return level + (i + j) % 2; }, highest);
    DepthImage spiked = clean;
    spiked.at(7, 9) = static_cast<float>(spike);
    CHECK(largest_difference(cleaned(spiked, kSpikesOnly), clean) <= 1.0);
    CHECK(cleaned(clean, kSpikesOnly).levels == clean.levels);
}

TEST_CASE("two pixels side by side are a shape, not a spike", "[cleaning]") {
    DepthImage image = chain_input(20, 20, [](int, int) { return 100.0; });
    image.at(7, 9) = image.at(8, 9) = 140.0F;
    CHECK(cleaned(image, kSpikesOnly).levels == image.levels);
}

TEST_CASE("no pixel is left in a pit, at the border or beside a deeper one either", "[cleaning]") {
    const DepthImage flat = chain_input(20, 20, [](int, int) { return 100.0; });
    DepthImage image = flat;
    image.at(0, 5) = image.at(10, 0) = image.at(19, 19) = 95.0F;
    image.at(7, 9) = 60.0F;
    image.at(8, 9) = 90.0F;
    image.at(15, 15) = 95.0F;
    CHECK(cleaned(image, kSpikesOnly).levels == flat.levels);
    image.at(15, 15) = 96.0F;  // that is no pit
    CHECK(cleaned(image, kSpikesOnly).at(15, 15) == 96.0F);
}

TEST_CASE("a speck of depth in empty background is removed, not spread", "[cleaning]") {
    DepthImage image = chain_input(100, 100, [](int, int) { return kNone; });
    image.at(50, 50) = 200.0F;
    const DepthImage clean = cleaned(image, kGentleSteps);
    CHECK(std::count(clean.levels.begin(), clean.levels.end(), 0.0F) == 10000);
}

TEST_CASE("images of any small size are cleaned without reading beside them", "[cleaning]") {
    const auto [columns, rows] =
        GENERATE(table<int, int>({{1, 1}, {2, 2}, {1, 9}, {3, 2}, {9, 3}, {2, 40}, {17, 16}}));
    CAPTURE(columns, rows);
    std::mt19937 random(6);
    const DepthImage image = chain_input(columns, rows, [&](int, int) {
        return random() % 4 == 0 ? kNone : static_cast<double>(random() % 4 * 60);
    });
    const CleaningPlan plan{
        GENERATE(kGentleSteps, kSensorSteps), {GENERATE(0.0, 3.0), 255.0}, {.constant = 0.01F}};
    const DepthImage clean = *CleaningChain().clean_and_finish(image, plan).depth;
    REQUIRE(clean.levels.size() == image.levels.size());
    CHECK(std::all_of(clean.levels.begin(), clean.levels.end(),
                      [](float level) { return level >= 0.0F && level <= 255.0F; }));
}
