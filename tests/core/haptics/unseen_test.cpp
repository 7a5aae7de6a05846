// Where no surface was ever seen: a wall at the back, or nothing.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr int kColumns = 80;
constexpr int kRows = 40;

/// A hand that moves 0.1 px a tick to the right, 5 px deep, over a surface that was only seen in
/// its left half.
struct Stroke {
    DepthImage image{flat(kColumns, kRows, 100.0)};
    std::vector<std::uint8_t> unseen = [] {
        std::vector<std::uint8_t> mask(kColumns * kRows, 0);
        for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = k % kColumns >= 40 ? 1 : 0;
        return mask;
    }();
    TouchParameters parameters{};
    TouchRenderer renderer{};

    [[nodiscard]] std::vector<Touch> ticks(double from_x, double to_x, bool masked = true) {
        const DepthSurface surface(image, image, 0.0, parameters.shape, nullptr,
                                   masked ? &unseen : nullptr);
        std::vector<Touch> all;
        const double step = from_x < to_x ? 0.1 : -0.1;
        const int count = static_cast<int>((to_x - from_x) / step);
        for (int k = 0; k < count; ++k)
            all.push_back(
                renderer.update(surface, {from_x + k * step, 20.0, 95.0}, parameters, {}, {}));
        return all;
    }
};

}  // namespace

TEST_CASE("what was never seen is touched as any surface, to the bit", "[unseen]") {
    Stroke masked;
    Stroke plain;
    const std::vector<Touch> over_unseen = masked.ticks(5.0, 75.0);
    const std::vector<Touch> over_seen = plain.ticks(5.0, 75.0, false);
    int differing = 0;
    for (std::size_t k = 0; k < over_seen.size(); ++k) {
        const bool same = over_unseen[k].sent_force_newton == over_seen[k].sent_force_newton &&
                          over_unseen[k].proxy.contact;
        differing += same ? 0 : 1;
    }
    CHECK(differing == 0);
}

TEST_CASE("not touched, it takes contact and force away within a fade, and gives them back",
          "[unseen]") {
    Stroke stroke;
    stroke.parameters.coupling.unseen_share = 0.0;
    for (int k = 0; k < 3; ++k) {  // until the force has risen
        static_cast<void>(stroke.ticks(0.0, 20.0));
        static_cast<void>(stroke.ticks(20.0, 0.0));
    }
    static_cast<void>(stroke.ticks(0.0, 20.0));
    const std::vector<Touch> there = stroke.ticks(20.0, 70.0);
    const std::vector<Touch> back = stroke.ticks(70.0, 20.0);
    const double full_newton = glm::length(there.front().sent_force_newton);
    CHECK(full_newton > 0.3);
    double worst_step_newton = 0.0;
    const auto watch = [&](const std::vector<Touch>& ticks) {
        for (std::size_t k = 1; k < ticks.size(); ++k)
            worst_step_newton =
                std::max(worst_step_newton,
                         glm::length(ticks[k].sent_force_newton - ticks[k - 1].sent_force_newton));
    };
    watch(there);
    watch(back);
    CHECK(worst_step_newton < 1.5 * full_newton / 40.0);  // of a fade of 40 ms
    // The border is crossed after 19.5 px, 195 ticks.
    CHECK(there[190].proxy.contact);
    for (std::size_t k = 245; k < there.size(); ++k) {
        CHECK_FALSE(there[k].proxy.contact);
        CHECK(there[k].sent_force_newton == Vec3(0.0));
    }
    CHECK(back.back().proxy.contact);
    CHECK(glm::length(back.back().sent_force_newton) > 0.9 * full_newton);
}

TEST_CASE("whether a place was seen is told by the vertex next to it, beyond the image too",
          "[unseen]") {
    const Stroke stroke;
    const DepthSurface surface(stroke.image, stroke.image, 0.0, {}, nullptr, &stroke.unseen);
    CHECK(surface.seen_at(39.4, 5.0));
    CHECK_FALSE(surface.seen_at(39.6, 5.0));
    CHECK(surface.seen_at(-1e5, 1e5));
    CHECK_FALSE(surface.seen_at(1e5, -1e5));
    CHECK(DepthSurface(stroke.image, stroke.image, 0.0, {}).seen_at(79.0, 39.0));
}
