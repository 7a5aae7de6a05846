// No tick allocates: counted by replacing operator new for this program.
#include <cmath>
#include <cstdlib>
#include <new>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

namespace {

thread_local int no_alloc_depth = 0;
thread_local int alloc_in_tick = 0;

}  // namespace

void* operator new(std::size_t size) {
    if (no_alloc_depth > 0) ++alloc_in_tick;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc{};
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    if (no_alloc_depth > 0) ++alloc_in_tick;
    return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

TEST_CASE("the counter counts an allocation", "[allocation]") {
    ++no_alloc_depth;
    int* volatile kept = new int(3);  // volatile: or the pair is optimised away
    delete kept;
    --no_alloc_depth;
    CHECK(alloc_in_tick == 1);
    alloc_in_tick = 0;
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
    CAPTURE(name_of(parameters.algorithm));
    test::Dice dice(47);
    int contacts = 0;
    ++no_alloc_depth;
    for (const auto& named : surfaces) {
        for (int k = 0; k < 2000; ++k) {
            const DepthImage& image = k % 500 == 499 ? other : named.image;
            const DepthSurface surface(image, image, 0.0, parameters.shape, &bump);
            Vec3 goal(dice.uniform(0.0, 49.0), dice.uniform(0.0, 39.0), dice.uniform(0.0, 200.0));
            if (k % 97 == 0) goal.x = std::nan("");
            contacts += renderer.update(surface, goal, parameters, {}, {}).proxy.contact ? 1 : 0;
        }
    }
    --no_alloc_depth;
    CHECK(alloc_in_tick == 0);
    CHECK(contacts > 1000);
}
