// Touch maps: sampled at the proxy, effective there and nowhere else.
#include "core/haptics/touch_maps.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/explanation.hpp"
#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int kSide = 40;
constexpr SafetyInput kTick{.dt_s = 0.001, .from_zero = false};

/// Covers the left half with one value.
TouchMap left_half(TouchMapKind kind, double value) {
    TouchMap map = bare_map(kind, kSide, kSide);
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide / 2; ++i) map.at(i, j) = {map.level_of(value), 65535};
    }
    return map;
}

/// The last of some updates with the same goal on flat ground 100 px high.
Touch pressed(const TouchMaps* maps, Vec3 goal, const TouchParameters& parameters = {},
              const SafetyLimits& limits = {.max_change_newton_per_ms = 100.0, .ramp_s = 0.0}) {
    const DepthImage image = test::flat(kSide, kSide, 100.0);
    const DepthSurface surface(image, image, 0.0, parameters.shape, nullptr, nullptr, maps);
    TouchRenderer renderer;
    Touch touch;
    for (int k = 0; k < 4; ++k) touch = renderer.update(surface, goal, parameters, kTick, limits);
    return touch;
}

}  // namespace

TEST_CASE("a stiffness map that doubles the left half doubles the force there and nowhere else",
          "[maps]") {
    TouchParameters parameters;
    TouchMaps maps;
    maps.stiffness =
        left_half(TouchMapKind::stiffness, 2.0 * parameters.coupling.stiffness_newton_per_mm);
    for (const double x : {3.0, 10.4, 18.9}) {
        const Vec3 goal{x, 20.0, 95.0};
        const Vec3 ratio =
            pressed(&maps, goal).spring_force_newton / pressed(nullptr, goal).spring_force_newton;
        CHECK_THAT(ratio.z, WithinAbs(2.0, 1e-4));
    }
    for (const double x : {20.0, 30.3, 39.0}) {
        const Vec3 goal{x, 20.0, 95.0};
        CHECK(pressed(&maps, goal).spring_force_newton ==
              pressed(nullptr, goal).spring_force_newton);
    }
    // Linear between the last pixel of the one and the first of the other.
    const Vec3 between{19.25, 20.0, 95.0};
    CHECK_THAT(pressed(&maps, between).spring_force_newton.z /
                   pressed(nullptr, between).spring_force_newton.z,
               WithinAbs(1.75, 1e-4));
}

TEST_CASE("a stiffness map is felt no stiffer than the device can stand", "[maps]") {
    TouchMaps maps;
    maps.stiffness = left_half(TouchMapKind::stiffness, 2.0);
    const SafetyLimits limits = held_limits({.max_force_newton = 8.0, .ramp_s = 0.0},
                                            {.max_stiffness_newton_per_mm = 0.75});
    TouchParameters parameters;
    const Vec3 goal{5.0, 5.0, 95.0};
    const Touch touch = pressed(&maps, goal, parameters, limits);
    const double pressed_mm = 5.0 * parameters.coupling.pixel_pitch_mm;
    CHECK_THAT(touch.spring_force_newton.z, WithinAbs(0.75 * pressed_mm, 1e-9));
}

TEST_CASE("where a map is stiffer, a device that moves is damped as it needs it there", "[maps]") {
    TouchMaps maps;
    maps.stiffness = left_half(TouchMapKind::stiffness, 0.9);
    const DepthImage image = test::flat(kSide, kSide, 100.0);
    const DepthSurface surface(image, image, 0.0, {}, nullptr, nullptr, &maps);
    SafetyLimits limits;
    limits.watched = {.mass_kg = 0.15, .friction_newton_s_per_m = 1.0, .delay_s = 0.003};
    const Coupling soft{.stiffness_newton_per_mm = 0.1};
    Proxy proxy;
    proxy.contact = true;
    proxy.position = {5.0, 5.0, 100.0};
    const Coupling stiff = local_coupling(surface, proxy, soft, limits);
    CHECK_THAT(stiff.stiffness_newton_per_mm, WithinAbs(0.9, 1e-4));
    CHECK(stability_margin(stiff, limits.watched) >= limits.watched.margin_newton_s_per_m - 1e-9);
    proxy.position.x = 30.0;
    CHECK(local_coupling(surface, proxy, soft, limits) == soft);
}

TEST_CASE("over a friction map the proxy lags by the cone of the pixel it is on", "[maps]") {
    TouchMaps maps;
    maps.friction = left_half(TouchMapKind::friction, 1.5);
    TouchParameters parameters;
    parameters.friction = {0.5, 0.25};
    const DepthImage image = test::flat(kSide, kSide, 100.0);
    const DepthSurface surface(image, image, 0.0, parameters.shape, nullptr, nullptr, &maps);
    const auto lag_at = [&](double from_x, double to_x) {
        TouchRenderer renderer;
        Touch touch;
        for (double x = from_x; x < to_x; x += 0.01)
            touch = renderer.update(surface, {x, 20.0, 98.0}, parameters, kTick, {});
        return touch.goal.x - touch.proxy.position.x;
    };
    // It slips: the dynamic coefficient, half of the static one as everywhere.
    CHECK_THAT(lag_at(4.0, 16.0), WithinAbs(0.75 * 2.0, 0.02));
    CHECK_THAT(lag_at(24.0, 36.0), WithinAbs(0.25 * 2.0, 0.02));
}

TEST_CASE("a height map is elevation, and the walk over it is that over such ground", "[maps]") {
    TouchMaps maps;
    maps.height = bare_map(TouchMapKind::height, kSide, kSide);
    DepthImage higher = test::flat(kSide, kSide, 100.0);
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            // Whole heights that the levels give exactly: 65535 levels over 64 px.
            TouchMap::Pixel& pixel = maps.height.at(i, j);
            pixel = {static_cast<std::uint16_t>((7 * i + 3 * j) % 5 * 4369 + 30000), 65535};
            higher.at(i, j) += static_cast<float>(maps.height.value_of(pixel));
        }
    }
    lay_heights(maps, kSide, kSide);
    const DepthImage image = test::flat(kSide, kSide, 100.0);
    const SurfaceShape shape{};
    const DepthSurface painted(image, image, 0.0, shape, nullptr, nullptr, &maps);
    const DepthSurface real(higher, higher, 0.0, shape);
    TouchRenderer one, other;
    for (int k = 0; k < 400; ++k) {
        const Vec3 goal{20.0 + 18.0 * std::cos(0.031 * k), 20.0 + 18.0 * std::sin(0.047 * k),
                        96.0 + 6.0 * std::sin(0.1 * k)};
        const Touch& over_paint = one.update(painted, goal, {}, kTick, {});
        const Touch& over_ground = other.update(real, goal, {}, kTick, {});
        REQUIRE(glm::length(over_paint.proxy.position - over_ground.proxy.position) < 1e-4);
        REQUIRE(over_paint.proxy.position.z >=
                painted.elevation_at(over_paint.proxy.position.x, over_paint.proxy.position.y) -
                    1e-9);
    }
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) REQUIRE(painted.elevation(i, j) <= painted.ceiling());
    }
    // Laid over images of another size the map has no effect.
    const DepthImage large = test::flat(kSide + 1, kSide, 100.0);
    CHECK(DepthSurface(large, large, 0.0, shape, nullptr, nullptr, &maps).elevation(3, 3) == 100.0);
}

TEST_CASE("maps that cover nothing change no bit", "[maps]") {
    TouchMaps maps;
    for (const TouchMapKind kind : all_touch_map_kinds()) maps.of(kind) = bare_map(kind, 13, 7);
    lay_heights(maps, kSide, kSide);
    TouchParameters parameters;
    parameters.friction = {0.7, 0.3};
    for (const Vec3 goal : {Vec3(3.3, 4.4, 97.0), Vec3(39.0, 0.0, 20.0), Vec3(12.0, 30.0, 120.0)}) {
        const Touch with = pressed(&maps, goal, parameters);
        const Touch without = pressed(nullptr, goal, parameters);
        CHECK(with.proxy == without.proxy);
        CHECK(with.spring_force_newton == without.spring_force_newton);
    }
}

TEST_CASE("a map of its own resolution is stretched over the image", "[maps]") {
    TouchMap map = bare_map(TouchMapKind::friction, 4, 2);
    map.at(0, 0) = {map.level_of(2.0), 65535};
    CHECK_THAT(map_value(map, 0.0, 0.0, 40, 40, 0.5), WithinAbs(2.0, 1e-12));
    CHECK_THAT(map_value(map, 4.5, 9.5, 40, 40, 0.5), WithinAbs(2.0, 1e-12));
    CHECK_THAT(map_value(map, 9.5, 9.5, 40, 40, 0.5), WithinAbs(1.25, 1e-12));
    CHECK(map_value(map, 30.0, 30.0, 40, 40, 0.5) == 0.5);
}

TEST_CASE("levels are linear between the limits and hold what is beyond them", "[maps]") {
    TouchMap map = bare_map(TouchMapKind::height, 2, 2);
    for (const double value : {-32.0, -1.0, 0.0, 0.001, 17.3, 32.0})
        CHECK_THAT(map.value_of({map.level_of(value), 65535}), WithinAbs(value, 64.0 / 65535.0));
    CHECK(map.level_of(-100.0) == 0);
    CHECK(map.level_of(100.0) == 65535);
    CHECK(map.level_of(std::nan("")) == 0);
}

TEST_CASE("an update over maps is explained with the friction that it is felt with", "[maps]") {
    TouchMaps maps;
    maps.friction = left_half(TouchMapKind::friction, 1.0);
    const DepthImage image = test::flat(kSide, kSide, 100.0);
    const DepthSurface surface(image, image, 0.0, {}, nullptr, nullptr, &maps);
    TouchRenderer renderer;
    Proxy before;
    TouchParameters parameters;
    for (int k = 0; k < 300; ++k) {
        const Vec3 goal{5.0 + 0.1 * k, 20.0, 97.0};
        const Proxy after = renderer.update(surface, goal, parameters, kTick, {}).proxy;
        if (k > 0) REQUIRE(explain(surface, before, goal, parameters.friction).result == after);
        before = after;
    }
}
