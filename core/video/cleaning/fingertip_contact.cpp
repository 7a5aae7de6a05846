// Where a ball touches the surface: the nearest point of all TRIANGLEs under it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/haptics/facet.hpp"
#include "core/haptics/surface.hpp"
#include "core/video/cleaning/fingertip.hpp"

namespace dibhr {

namespace {

/// The offered point that is nearest to the ball's centre; of equally near ones the first.
struct Nearest {
    Vec3 centre;
    Vec3 point;
    double distance2;

    void offer(Vec3 other) noexcept {
        const Vec3 away = other - centre;
        const double away2 = glm::dot(away, away);
        if (away2 < distance2) {
            distance2 = away2;
            point = other;
        }
    }

    void offer_edge(Vec3 begin, Vec3 end) noexcept {
        const Vec3 along = end - begin;
        const double share = glm::dot(centre - begin, along) / glm::dot(along, along);
        offer(begin + std::clamp(share, 0.0, 1.0) * along);
    }

    void offer_inside(const Facet& facet) noexcept {
        const Vec3 foot = facet.project(centre).foot;
        const Barycentric at = facet.barycentric(foot.x, foot.y);
        if (at.row >= 0.0 && at.column >= 0.0 && at.diagonal >= 0.0) offer(foot);
    }
};

/// The four corners of a cell [px].
struct Corners {
    double a, b, c, d;  ///< (i, j), (i+1, j), (i, j+1), (i+1, j+1)

    [[nodiscard]] double highest() const noexcept { return std::max({a, b, c, d}); }
};

void offer_cell(int i, int j, const Corners& z, Nearest& nearest) noexcept {
    nearest.offer_inside(Facet(1, i, j, z.a, z.b, z.c));
    nearest.offer_inside(Facet(-1, i + 1, j + 1, z.d, z.c, z.b));
    const Vec3 a{i, j, z.a};
    const Vec3 b{i + 1, j, z.b};
    const Vec3 c{i, j + 1, z.c};
    const Vec3 d{i + 1, j + 1, z.d};
    nearest.offer_edge(a, b);
    nearest.offer_edge(a, c);
    nearest.offer_edge(b, c);
    nearest.offer_edge(b, d);
    nearest.offer_edge(c, d);
}

/// Distance from a coordinate to a row or column of cells, which ends one pixel after `cell`.
double gap(double along, int cell) noexcept {
    return std::max({cell - along, along - (cell + 1), 0.0});
}

/// Those of `count` cells in a row or column that are less than `reach` from a coordinate.
struct Range {
    Range(double along, double reach, int count)
        : first(static_cast<int>(std::clamp(along - reach, 0.0, count - 1.0))),
          last(static_cast<int>(std::clamp(along + reach, 0.0, count - 1.0))) {}
    int first, last;
};

}  // namespace

Vec3 contact_point(const DepthSurface& original, const Fingertip& finger, Vec3 proxy) noexcept {
    const double radius_px = std::clamp(finger.radius_px, 0.0, kWidestFinger_px);
    const Vec3 under = original.clamped_to_frame(proxy);
    const Vec3 foot{under.x, under.y, original.elevation_at(under.x, under.y)};
    Nearest nearest{{under.x, under.y, proxy.z + radius_px}, foot, 0.0};
    if (!(radius_px > 0.0)) return foot;
    nearest.distance2 = glm::dot(foot - nearest.centre, foot - nearest.centre);
    const Range columns(under.x, radius_px, original.columns() - 1);
    const Range rows(under.y, radius_px, original.rows() - 1);
    for (int j = rows.first; j <= rows.last; ++j) {
        const double gap_y = gap(under.y, j);
        Corners z{};
        z.b = original.elevation(columns.first, j);
        z.d = original.elevation(columns.first, j + 1);
        for (int i = columns.first; i <= columns.last; ++i) {
            z = {z.b, original.elevation(i + 1, j), z.d, original.elevation(i + 1, j + 1)};
            const double gap_x = gap(under.x, i);
            const double gap_z = std::max(nearest.centre.z - z.highest(), 0.0);
            if (gap_x * gap_x + gap_y * gap_y + gap_z * gap_z < nearest.distance2)
                offer_cell(i, j, z, nearest);
        }
    }
    return nearest.point;
}

}  // namespace dibhr
