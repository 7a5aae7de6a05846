// Depth in colours.
#include "render/relief_paint.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

std::vector<int> pixel(const ColourImage& picture, int i, int j) {
    const std::size_t at = 3 * static_cast<std::size_t>(j * picture.columns + i);
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

}  // namespace

TEST_CASE("depth in grey is as bright as it is near, and what was never seen is no grey",
          "[paint]") {
    const DepthImage depth =
        image_of(16, 4, 65535.0, [](int i, int j) { return 65535.0 * (i + 16 * j) / 63.0; });
    std::vector<std::uint8_t> unseen(64, 0);
    unseen[20] = 1;
    const auto picture = depth_picture(depth, &unseen, ReliefPaint::grey, 100);
    REQUIRE(picture);
    REQUIRE(picture->columns == 16);
    REQUIRE(picture->rows == 4);
    for (int k = 0; k < 64; ++k) {
        CAPTURE(k);
        const std::vector<int> colour = pixel(*picture, k % 16, k / 16);
        if (k == 20) {
            CHECK(colour[2] > colour[0]);
        } else {
            CHECK(std::abs(colour[0] - 255 * k / 63) <= 1);
            CHECK(colour == std::vector<int>(3, colour[0]));
        }
    }
}

TEST_CASE("a large depth image is thinned out, its nearest and farthest in the ramp's end colours",
          "[paint]") {
    const DepthImage depth =
        image_of(900, 300, 255.0, [](int i, int) { return i < 450 ? -1.0 : 300.0; });
    const auto picture = depth_picture(depth, nullptr, ReliefPaint::turbo, 100);
    REQUIRE(picture);
    CHECK(picture->columns == 100);
    CHECK(picture->rows == 34);
    const auto ramp = depth_colours(ReliefPaint::turbo);
    CHECK(pixel(*picture, 0, 0) == pixel(*ramp, 0, 0));
    CHECK(pixel(*picture, 99, 33) == pixel(*ramp, 255, 0));
    CHECK_FALSE(depth_picture(depth, nullptr, ReliefPaint::clay, 100));
}
