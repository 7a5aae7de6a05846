// Whether the measures of detail are right for simple changes, and the noises what they are said
// to be.
#include "tests/bench/detail.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/bench/sensors.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::bench {

namespace {

using Catch::Matchers::WithinAbs;

/// Of frames 0 and 1.
Detail detail_of(const std::vector<DepthImage>& frames, const CameraPath& path = {}) {
    DetailMeter meter(path);
    meter.add(0, frames[0], frames[1]);
    meter.add(1, frames[1], frames[0]);
    return meter.detail();
}

std::vector<DepthImage> true_frames(const CameraPath& path) {
    const TrueFrames truth(detail_scene(path), 2);
    return {truth[0].elevation, truth[1].elevation};
}

/// Means of so many columns around each.
DepthImage smeared(const DepthImage& image, int columns) {
    DepthImage smooth = image;
    for (int j = 0; j < image.rows; ++j)
        for (int i = columns; i < image.columns - columns; ++i) {
            double sum = 0.0;
            for (int x = i - columns / 2; x < i - columns / 2 + columns; ++x)
                sum += static_cast<double>(image.at(x, j));
            smooth.at(i, j) = static_cast<float>(sum / columns);
        }
    return smooth;
}

}  // namespace

TEST_CASE("the truth keeps all detail, without noise and pimples, also where the camera moves",
          "[detail][long]") {
    const CameraPath path = GENERATE(CameraPath{}, CameraPath{.right_px = 50.0 / kRate},
                                     CameraPath{.roll = 0.01}, CameraPath{.nearer_mm = 7.0});
    CAPTURE(path.right_px, path.roll, path.nearer_mm);
    const Detail detail = detail_of(true_frames(path), path);
    for (const double kept : detail.ridges) CHECK_THAT(kept, WithinAbs(1.0, 1e-3));
    const bool is_straight = path.roll == 0.0 && path.nearer_mm == 0.0;
    if (is_straight) CHECK_THAT(detail.step, WithinAbs(1.0, 1e-3));
    CHECK(std::isnan(detail.step) != is_straight);
    CHECK(detail.noise_mm < 1e-3);
    CHECK(detail.flat.pimples == 0.0);
}

TEST_CASE(
    "a mean over columns keeps as much of ridges as its formula says, and of a step over 8 "
    "px half within 4 px",
    "[detail][long]") {
    std::vector<DepthImage> frames = true_frames({});
    std::vector<DepthImage> wide;
    for (DepthImage& frame : frames) {
        wide.push_back(smeared(frame, 8));
        frame = smeared(frame, 3);
    }
    CHECK_THAT(detail_of(wide).step, WithinAbs(0.5, 0.01));
    const Detail detail = detail_of(frames);
    for (std::size_t k = 0; k < kRidges.size(); ++k) {
        const double beside = std::cos(2.0 * 3.14159265 / kRidges[k].period_px);
        CHECK_THAT(detail.ridges[k], WithinAbs((1.0 + 2.0 * beside) / 3.0, 1e-3));
    }
    CHECK_THAT(detail.step, WithinAbs(1.0, 1e-3));
}

TEST_CASE("each noise is as strong as a mean of 11 frames leaves it, and takes no detail",
          "[detail][long]") {
    const std::vector<double> left_mm{0.49, 0.14, 0.53, 0.76};
    const TrueFrames truth(detail_scene({}), 13);
    const std::vector<Sensor> all = noises();
    REQUIRE(all.size() == left_mm.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        CAPTURE(all[k].name);
        const std::vector<DepthImage> recorded = all[k].see(truth, 1);
        const Detail detail = detail_of({mean_of(recorded, 0, 11), mean_of(recorded, 2, 11)});
        CHECK_THAT(detail.noise_mm, WithinAbs(left_mm[k], 0.1 * left_mm[k]));
        for (const double kept : detail.ridges) CHECK_THAT(kept, WithinAbs(1.0, 0.1));
        CHECK_THAT(detail.step, WithinAbs(1.0, 0.1));
    }
}

}  // namespace dibhr::bench
