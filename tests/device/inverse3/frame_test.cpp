// The service's axes and the image's, and the box that a hand comfortably moves in.
#include "device/inverse3/frame.hpp"

#include <glm/geometric.hpp>

#include <limits>

#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::inverse3;
using Catch::Matchers::WithinAbs;

bool same(Vec3 a, Vec3 b) {
    return glm::distance(a, b) < 1e-12;
}

}  // namespace

TEST_CASE("upright, up is up in the image and towards the person comes out of it", "[inverse3]") {
    const ImageTilt tilt(0.0);
    CHECK(same(tilt.hand_from_service({1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}));
    CHECK(same(tilt.hand_from_service({0.0, 0.0, 1.0}), {0.0, 1.0, 0.0}));
    CHECK(same(tilt.hand_from_service({0.0, -1.0, 0.0}), {0.0, 0.0, 1.0}));
}

TEST_CASE("lying flat, forward is up in the image and down presses into it", "[inverse3]") {
    const ImageTilt tilt(90.0);
    CHECK(same(tilt.hand_from_service({0.0, 1.0, 0.0}), {0.0, 1.0, 0.0}));
    CHECK(same(tilt.hand_from_service({0.0, 0.0, -1.0}), {0.0, 0.0, -1.0}));
}

TEST_CASE("a force comes back in the axes that the pose came in, at every tilt", "[inverse3]") {
    const double tilt_deg =
        GENERATE(0.0, 20.0, 45.0, 90.0, -30.0, 400.0, std::numeric_limits<double>::quiet_NaN());
    const ImageTilt tilt(tilt_deg);
    const Vec3 v{0.3, -1.7, 2.9};
    CHECK(same(tilt.service_from_hand(tilt.hand_from_service(v)), v));
    CHECK(same(tilt.hand_from_service(tilt.service_from_hand(v)), v));
    CHECK_THAT(glm::length(tilt.hand_from_service(v)), WithinAbs(glm::length(v), 1e-12));
}

TEST_CASE("the image's longer side fits into the box", "[inverse3]") {
    const ImageFrame wide{.columns = 721, .rows = 577, .relief_px = 120.0, .pixel_pitch_mm = 0.2};
    CHECK_THAT(fitting_scale_to_box(wide, 72.0), WithinAbs(2.0, 1e-12));
    const ImageFrame tall{.columns = 577, .rows = 721, .relief_px = 120.0, .pixel_pitch_mm = 0.2};
    CHECK_THAT(fitting_scale_to_box(tall, 144.0), WithinAbs(1.0, 1e-12));
}

TEST_CASE("the box has 20 to 200 mm, and every scale that comes of it is usable", "[inverse3]") {
    const ImageFrame image{.columns = 721, .rows = 577, .relief_px = 120.0, .pixel_pitch_mm = 0.2};
    CHECK_THAT(fitting_scale_to_box(image, 1.0),
               WithinAbs(fitting_scale_to_box(image, 20.0), 1e-12));
    CHECK_THAT(fitting_scale_to_box(image, 1e9),
               WithinAbs(fitting_scale_to_box(image, 200.0), 1e-12));
    const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(), 0.0, -1.0, 1e300);
    const double scale = fitting_scale_to_box(
        {.columns = 2, .rows = 0, .relief_px = bad, .pixel_pitch_mm = bad}, bad);
    CHECK(scale >= 0.1);
    CHECK(scale <= 10.0);
}
