// A VERTEX and what surrounds it, read once.
#pragma once

#include <array>
#include <cstddef>

#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// A VERTEX with its six EDGEs, its spokes, in the order of `kSpokes`. Between a spoke and the next
/// lies a TRIANGLE of the same number. Fewer on the image's border.
class VertexFan {
  public:
    VertexFan(const DepthSurface& surface, const Primitive& vertex) noexcept
        : i_(vertex.i), j_(vertex.j), z_(surface.elevation(vertex.i, vertex.j)) {
        const bool is_inner =
            surface.has_vertex(i_ - 1, j_ - 1) && surface.has_vertex(i_ + 1, j_ + 1);
        for (std::size_t k = 0; k < kSpokes.size(); ++k) {
            const int i = i_ + kSpokes[k].i;
            const int j = j_ + kSpokes[k].j;
            if (!is_inner && !surface.has_vertex(i, j)) continue;
            present_ |= 1U << k;
            around_[k] = surface.elevation(i, j);
        }
    }

    /// Elevation of the VERTEX.
    [[nodiscard]] double elevation() const noexcept { return z_; }
    [[nodiscard]] bool is_whole() const noexcept { return present_ == 0x3F; }
    [[nodiscard]] bool has(std::size_t spoke) const noexcept {
        return ((present_ >> spoke) & 1U) != 0;
    }
    [[nodiscard]] bool has_facet(std::size_t k) const noexcept {
        return has(k) && has((k + 1) % kSpokes.size());
    }
    /// From the VERTEX to the far end of a spoke.
    [[nodiscard]] Vec3 along(std::size_t spoke) const noexcept {
        return {kSpokes[spoke].i, kSpokes[spoke].j, around_[spoke] - z_};
    }

    /// At the ends of the EDGE along a spoke.
    [[nodiscard]] EdgeElevations elevations_along(std::size_t spoke) const noexcept {
        return spoke < 3 ? EdgeElevations{z_, around_[spoke]} : EdgeElevations{around_[spoke], z_};
    }

    [[nodiscard]] Facet facet(std::size_t k) const noexcept {
        const auto& z = around_;
        switch (k) {
            case 0:
                return {1, i_, j_, z_, z[0], z[1]};
            case 1:
                return {-1, i_, j_ + 1, z[1], z[2], z_};
            case 2:
                return {1, i_ - 1, j_, z[3], z_, z[2]};
            case 3:
                return {-1, i_, j_, z_, z[3], z[4]};
            case 4:
                return {1, i_, j_ - 1, z[4], z[5], z_};
            default:
                return {-1, i_ + 1, j_, z[0], z_, z[5]};
        }
    }

  private:
    int i_, j_;
    unsigned present_{0};
    double z_;
    std::array<double, 6> around_{};
};

}  // namespace dibhr
