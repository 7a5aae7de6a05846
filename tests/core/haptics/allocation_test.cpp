// No tick allocates.
#include <cmath>
#include <vector>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

TEST_CASE("the counter counts an allocation", "[allocation]") {
    const int allocations = dibhr::test::allocations_in([] {
        int* volatile kept = new int(3);  // volatile: or the pair is optimised away
        delete kept;
    });
    CHECK(allocations == 1);
}

TEST_CASE("no tick allocates, in contact, in the air, on a bad goal or when the image changes",
          "[allocation]") {
    using namespace dibhr;
    const auto surfaces = test::hostile_surfaces(50, 40);
    const DepthImage other = test::flat(64, 64, 90.0);
    const BumpMap bump{2, 2, {0.0F, 1.0F, 1.0F, 0.0F}};
    TouchRenderer renderer;
    TouchParameters parameters;
    parameters.algorithm =
        GENERATE(Algorithm::dibhr, Algorithm::pga, Algorithm::neighborhood, Algorithm::god_object);
    parameters.shape.roughness_px = 2.0;
    parameters.coupling = {.damping_newton_s_per_m = 5.0, .damping_cutoff_hz = 50.0};
    parameters.carry = true;
    const MotionField field{50, 40, std::vector<MotionField::Way>(2000, {4.0F, -1.0F})};
    CAPTURE(name_of(parameters.algorithm));
    test::Dice dice(47);
    int contacts = 0;
    int carried = 0;
    const int allocations = test::allocations_in([&] {
        for (const auto& named : surfaces) {
            for (int k = 0; k < 2000; ++k) {
                const DepthImage& image = k % 500 == 499 ? other : named.image;
                const DepthSurface surface(image, image, 0.0, parameters.shape, &bump);
                Vec3 goal(dice.uniform(0.0, 49.0), dice.uniform(0.0, 39.0),
                          dice.uniform(0.0, 200.0));
                if (k % 97 == 0) goal.x = std::nan("");
                const SurfaceMotion motion{&field, k % 33 / 33.0, (k + 1) % 33 / 33.0};
                const Touch& touch = renderer.update(surface, goal, parameters, {}, {}, motion);
                contacts += touch.proxy.contact ? 1 : 0;
                carried += touch.carried != Vec3(0.0) ? 1 : 0;
            }
        }
    });
    CHECK(allocations == 0);
    CHECK(contacts > 1000);
    CHECK(carried > 100);
}
