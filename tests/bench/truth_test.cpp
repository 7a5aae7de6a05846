// Whether cleaned depth is nearer to the truth than recorded depth, and whether its measures are
// right for simple errors.
#include "tests/bench/truth.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/sensors.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::bench {

namespace {

using Catch::Matchers::WithinAbs;

constexpr int kColumns = 320;
constexpr int kRows = 240;

constexpr CleaningPreset kRaw = CleaningPreset::raw;
constexpr CleaningPreset kAuto = CleaningPreset::automatic;

Nearness seen(const std::string& scene, const std::string& by, CleaningPreset cleaning,
              int columns = kColumns, int frames = 8) {
    const TrueFrames truth(known_scene(scene, columns, columns * 3 / 4), frames);
    return cleaned_against(truth, sensor(by).see(truth, 1), cleaning).nearness;
}

/// The measures of the true frames after `change(frames)`.
template <typename Change>
Nearness of_changed(const std::string& scene, int frames, const Change& change) {
    const TrueFrames truth(known_scene(scene, kColumns, kRows), frames);
    std::vector<DepthImage> images;
    for (int k = 0; k < frames; ++k) images.push_back(truth[k].elevation);
    change(images);
    NearnessMeter meter(truth);
    for (const DepthImage& image : images) meter.add(image);
    return meter.nearness();
}

}  // namespace

TEST_CASE("the truth has no error, no lag and no flicker", "[truth][long]") {
    const Nearness hand = of_changed("hand", 24, [](std::vector<DepthImage>&) {});
    CHECK(hand.elevation_px == 0.0);
    CHECK(hand.edge_px == 0.0);
    CHECK(hand.flicker_px == 0.0);
    CHECK_THAT(hand.lag_frames, WithinAbs(0.0, 0.01));
    CHECK(std::isnan(hand.bump_kept));
    const Nearness bumps = of_changed("bumps", 2, [](std::vector<DepthImage>&) {});
    CHECK(bumps.normal_deg < 1.0);  // of flat triangles on round bumps
    CHECK_THAT(bumps.bump_kept, WithinAbs(1.0, 1e-3));
}

TEST_CASE("an offset is an error, but turns no normal and moves no edge", "[truth][long]") {
    const Nearness lifted = of_changed("sphere", 2, [](std::vector<DepthImage>& images) {
        for (DepthImage& image : images)
            for (float& level : image.levels) level += 3.0F;
    });
    CHECK_THAT(lifted.elevation_px, WithinAbs(3.0, 1e-3));
    CHECK(lifted.normal_deg < 1.5);
    CHECK(lifted.edge_px == 0.0);
}

TEST_CASE("frames that come late are so late", "[truth][long]") {
    const std::string scene = GENERATE("hand", "chest");
    const int late = scene == "hand" ? 1 : 2;
    const Nearness found = of_changed(scene, 40, [late](std::vector<DepthImage>& images) {
        for (std::size_t k = images.size(); k-- > static_cast<std::size_t>(late);)
            images[k] = images[k - static_cast<std::size_t>(late)];
    });
    CHECK_THAT(found.lag_frames, WithinAbs(late, 0.25));
}

TEST_CASE("a picture that is moved has its edges elsewhere, and a ramp has none", "[truth][long]") {
    const Nearness moved = of_changed("chest", 2, [](std::vector<DepthImage>& images) {
        for (DepthImage& image : images) {
            const DepthImage there = image;
            for (int j = 0; j < image.rows; ++j)
                for (int i = 3; i < image.columns; ++i) image.at(i, j) = there.at(i - 3, j);
        }
    });
    CHECK_THAT(moved.edge_px, WithinAbs(3.0, 1e-9));
    CHECK(seen("chest", "lidar", kRaw, kColumns, 1).edge_px == kFarthestEdge_px);
}

TEST_CASE("a bump of half the height is half there, and noise that changes flickers",
          "[truth][long]") {
    const Nearness half = of_changed("bumps", 2, [](std::vector<DepthImage>& images) {
        const KnownScene scene = known_scene("bumps", kColumns, kRows);
        for (int j = 0; j < kRows; ++j)
            for (int i = 0; i < kColumns; ++i)
                images[1].at(i, j) -= static_cast<float>(scene.bump(i, j));
    });
    CHECK_THAT(half.bump_kept, WithinAbs(0.5, 1e-3));
    CHECK(half.flicker_px > 0.0);
    const Nearness shaken = seen("plane", "white", kRaw, kColumns, 20);
    CHECK_THAT(shaken.elevation_px, WithinAbs(0.5, 0.01));
    CHECK_THAT(shaken.flicker_px, WithinAbs(0.5 * std::sqrt(19.0 / 20.0), 0.01));
}

TEST_CASE("the same seed gives the same recording", "[truth][long]") {
    const TrueFrames truth(known_scene("face", 160, 120), 3);
    for (const Sensor& each : sensors()) {
        const std::vector<DepthImage> one = each.see(truth, 5);
        const std::vector<DepthImage> again = each.see(truth, 5);
        CAPTURE(each.name);
        REQUIRE(one.size() == 3);
        for (std::size_t k = 0; k < one.size(); ++k) {
            std::size_t other = 0;
            for (std::size_t n = 0; n < one[k].levels.size(); ++n)
                if (one[k].levels[n] != again[k].levels[n] && !std::isnan(one[k].levels[n]))
                    ++other;
            CHECK(other == 0);
        }
    }
}

TEST_CASE("what holds still or breathes is nearer to the truth than any sensor saw it",
          "[truth][long]") {
    const std::string scene = GENERATE("plane", "sphere", "face", "chest", "bumps");
    const TrueFrames truth(known_scene(scene, kColumns, kRows), 5);
    for (const Sensor& each : sensors()) {
        if (each.name == "mono") continue;  // its scale is no noise
        CAPTURE(scene, each.name);
        const std::vector<DepthImage> recorded = each.see(truth, 1);
        const Nearness before = cleaned_against(truth, recorded, kRaw).nearness;
        const Nearness after = cleaned_against(truth, recorded, kAuto).nearness;
        CHECK(after.elevation_px <= before.elevation_px);
        CHECK(after.normal_deg <= before.normal_deg);
        CHECK(after.flicker_px <= before.flicker_px);
    }
}

TEST_CASE("a hand at half a metre a second is nearer than a depth camera saw it", "[truth][long]") {
    const std::string by = GENERATE("white", "kinect", "stereo", "tof");
    CAPTURE(by);
    const TrueFrames truth(known_scene("hand", kColumns, kRows), 14);
    const std::vector<DepthImage> recorded = sensor(by).see(truth, 1);
    const Nearness before = cleaned_against(truth, recorded, kRaw).nearness;
    const Nearness after = cleaned_against(truth, recorded, kAuto).nearness;
    CHECK(after.elevation_px <= 0.85 * before.elevation_px);
    CHECK(after.normal_deg <= 0.8 * before.normal_deg);
    CHECK(std::fabs(after.lag_frames) <= 0.25);
}

TEST_CASE("a hand in motion keeps its silhouettes within a pixel, and is no noise",
          "[truth][long]") {
    const std::string by = GENERATE("exact", "white", "tof");
    CAPTURE(by);
    const Nearness after = seen("hand", by, kAuto, 640, 12);
    CHECK(after.edge_px <= 1.0);
    CHECK(after.elevation_px <= (by == "exact" ? 0.01 : 0.4));
}

TEST_CASE("a chest that breathes is not a quarter of a frame late", "[truth][long]") {
    const std::string by = GENERATE("white", "kinect");
    CAPTURE(by);
    CHECK(std::fabs(seen("chest", by, kAuto, kColumns, 40).lag_frames) <= 0.25);
}

TEST_CASE("the silhouettes of what holds still move by a pixel at most", "[truth][long]") {
    const std::string scene = GENERATE("sphere", "face", "chest");
    const std::string by = GENERATE("white", "kinect", "tof", "8-bit");
    CAPTURE(scene, by);
    CHECK(seen(scene, by, kAuto).edge_px <= 1.0);
}

TEST_CASE("a bump as high as twice the noise keeps two thirds of its height", "[truth][long]") {
    CHECK(seen("bumps", "white", kAuto, 640).bump_kept >= 2.0 / 3.0);
}

TEST_CASE("a sphere of 8 bits is felt as one, within 5 degrees", "[truth][long]") {
    CHECK(seen("sphere", "8-bit", kAuto, 640, 2).normal_deg <= 5.0);
}

TEST_CASE("a plane of which one pixel in 20 is seen comes within a pixel of the truth",
          "[truth][long]") {
    CHECK(seen("plane", "sparse", kAuto).elevation_px <= 1.0);
}

TEST_CASE("what is exact stays so", "[truth][long]") {
    const std::string scene = GENERATE("plane", "sphere", "face", "chest", "bumps");
    const Nearness before = seen(scene, "exact", kRaw);
    const Nearness after = seen(scene, "exact", kAuto);
    CHECK(after.elevation_px == before.elevation_px);
    CHECK(after.normal_deg == before.normal_deg);
}

}  // namespace dibhr::bench
