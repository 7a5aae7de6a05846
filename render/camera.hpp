// The camera: orbit, pan and zoom around the relief, or straight down like the recording camera.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "core/haptics/vec.hpp"

namespace dibhr {

/// World space is grid space centred and turned upright: x right, y up, z to the viewer, pixels.
/// `world = (x - (columns-1)/2, (rows-1)/2 - y, z)`.
class Camera {
  public:
    /// straight: orthographic, along the recording axis.
    enum class Projection { perspective, straight };

    /// Puts the whole relief of this size into view, from the default three-quarter angle, whatever
    /// the window's proportions.
    void frame_relief(int columns, int rows, double relief_px);
    void reset();  ///< back to what frame_relief() set; the projection stays

    /// Turns the near side of the relief to the right and down, as if dragged. Pitch stays within
    /// +-85 degrees. Has no effect in the straight projection.
    void orbit(double yaw_rad, double pitch_rad);

    /// Turns back so far that the relief is seen from the front: within 60 degrees of the recording
    /// axis to the sides and 40 up and down.
    void keep_in_front();

    /// Moves the picture by so many screen pixels (in the plane through the middle of the relief;
    /// exact in a window no narrower, in proportion, than the relief).
    void pan(double right_px, double up_px, int viewport_height);

    /// > 1: larger, by a narrower view, so that the camera never enters the relief. Bounded.
    void zoom(double factor);

    /// Moves a ball of grid space into the middle, as large as fits (within the bounds of zoom()).
    /// Keeps the direction.
    void close_up(Vec3 centre_in_grid, double radius_px);

    /// The view in numbers, which are valid for all reliefs of one size.
    struct View {
        double yaw_rad{0.0}, pitch_rad{0.0}, zoom{1.0};
        Vec3 centre_in_world{0.0};

        bool operator==(const View&) const = default;
    };
    [[nodiscard]] View view() const { return {yaw_rad_, pitch_rad_, zoom_, centre_in_world_}; }
    /// Clamped to the bounds of orbit() and zoom().
    void set_view(const View& view);

    void set_projection(Projection projection) { projection_ = projection; }

    /// The lower share of the viewport, from 0 to 0.5, that something else covers: the relief is
    /// put into view above it.
    void set_covered_below(double share);

    [[nodiscard]] glm::dmat4 view_from_world() const;
    [[nodiscard]] glm::dmat4 clip_from_view(double aspect) const;  ///< aspect = width / height
    /// From grid space to the clip space of such a viewport, for drawings over the picture.
    [[nodiscard]] glm::dmat4 clip_from_grid(double aspect) const;
    [[nodiscard]] Vec3 grid_from_world(Vec3 world) const;
    [[nodiscard]] Vec3 world_from_grid(Vec3 grid) const;

    /// The segment under a screen position (pixels from the upper left), in grid space, from near
    /// to far.
    struct Ray {
        Vec3 near_in_grid{0.0}, far_in_grid{0.0};
    };
    [[nodiscard]] Ray ray_under(glm::dvec2 screen_px, glm::ivec2 viewport) const;

    bool operator==(const Camera&) const = default;

  private:
    [[nodiscard]] double radius_px() const;
    [[nodiscard]] double distance_px() const;
    [[nodiscard]] glm::dvec2 half_extent() const;
    [[nodiscard]] double free_share() const { return 1.0 - covered_below_; }

    int columns_{2}, rows_{2};
    double relief_px_{0.0};
    Projection projection_{Projection::perspective};
    double covered_below_{0.0};
    double yaw_rad_{0.0}, pitch_rad_{0.0}, zoom_{1.0};
    Vec3 centre_in_world_{0.0};
};

}  // namespace dibhr
