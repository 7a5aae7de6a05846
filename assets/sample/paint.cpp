// Chooses the paint of a part; the wall's own.
#include "assets/sample/paint.hpp"

#include <cmath>

namespace dibhr::sample {

Vec3 colour(unsigned rgb) noexcept {
    const auto channel = [rgb](unsigned shift) {
        return std::pow(static_cast<float>((rgb >> shift) & 255U) / 255.0F, 2.2F);
    };
    return {channel(16U), channel(8U), channel(0U)};
}

Paint paint_wall(Vec3 world) noexcept {
    const float halo = hill(glm::length(Vec2{world.x + 60.0F, world.y - 70.0F}), 330.0F);
    const float plaster =
        noise(world.x * 0.02F, world.y * 0.02F) + 0.5F * noise(world.x * 0.06F, world.y * 0.06F);
    Paint paint;
    paint.albedo = glm::mix(colour(0x6f8f98), colour(0x9dbcbf), halo) * (0.96F + 0.04F * plaster);
    return paint;
}

Paint paint_at(const Scene& scene, Vec3 world, Part part, Vec3 normal) noexcept {
    switch (part) {
        case Part::Face:
            return paint_face(scene, world);
        case Part::Eye:
            return paint_eye(scene, world);
        case Part::Hair:
            return paint_hair(scene, world, normal);
        case Part::Hand:
            return paint_hand(scene, world);
        case Part::Sweater:
            return paint_sweater(scene, world);
        case Part::Sleeve:
            return paint_sleeve(scene, world);
        case Part::Wall:
            break;
    }
    return paint_wall(world);
}

}  // namespace dibhr::sample
