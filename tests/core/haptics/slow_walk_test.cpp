// DIBHR ends where a slow walk by the written rules ends, on the most hostile ground there is.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/surface.hpp"
#include "tests/core/haptics/slow_walk.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr int kSize = 300;

/// A hand that wanders and turns back at the border, some way below the surface or under all of it.
class Wanderer {
  public:
    Wanderer(const DepthSurface& surface, double speed_px, double depth_px)
        : surface_(surface), speed_px_(speed_px), depth_px_(depth_px) {}

    Vec3 next() {
        heading_ += dice_.uniform(-0.2, 0.2);
        Vec3 to = at_ + speed_px_ * Vec3(std::cos(heading_), std::sin(heading_), 0.0);
        const Vec3 held = glm::clamp(to, Vec3(20.0), Vec3(kSize - 20.0));
        if (Vec2(held) != Vec2(to)) heading_ += std::numbers::pi;
        at_ = held;
        to = held;
        to.z = depth_px_ > 0.0 ? surface_.elevation_at(to.x, to.y) - depth_px_ : -5.0;
        return to;
    }

  private:
    const DepthSurface& surface_;
    const double speed_px_, depth_px_;
    test::Dice dice_{5};
    double heading_{1.0};
    Vec3 at_{150.0, 150.0, 20.0};
};

}  // namespace

TEST_CASE("on white noise the walk ends where a slow walk by the written rules ends",
          "[reference]") {
    const double relief_px = GENERATE(20.0, 255.0, 4096.0);
    const double mu = GENERATE(0.0, 0.2, 0.4, 0.8);
    const double speed_px = GENERATE(0.5, 5.0, 40.0);
    // 0: under all of it. Out of a cliff of thousands of px round-off may hide the way
    // (README.md, "Exact answers").
    const double depth_px = relief_px > 1000.0 ? 0.0 : GENERATE(0.0, 6.0);
    test::Dice dice(3);
    const DepthImage image = image_of(
        kSize, kSize, 255.0, [&](int, int) { return std::floor(dice.uniform(0.0, 256.0)); });
    const DepthSurface surface(image, image, 0.0, {relief_px, 0.0});
    Wanderer hand(surface, speed_px, depth_px);
    const Friction friction{mu, 0.8 * mu};
    Dibhr dibhr;
    Proxy before = dibhr.update(surface, hand.next(), friction);
    for (int update = 0; update < 1000; ++update) {
        const Vec3 goal = hand.next();
        const Proxy proxy = dibhr.update(surface, goal, friction);
        REQUIRE_FALSE(proxy.bound_met);
        const Proxy slow = test::SlowWalk(surface, goal, friction, before).run();
        const double apart_px = glm::length(slow.position - proxy.position);
        CAPTURE(relief_px, mu, speed_px, depth_px, update, apart_px);
        CHECK(
            (apart_px < 1e-6 && slow.contact == proxy.contact && slow.slipping == proxy.slipping));
        before = proxy;
    }
}
