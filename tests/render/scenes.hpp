// Small frames and pixels for the tests of the picture.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <utility>

#include "core/video/frames/frame_window.hpp"
#include "render/camera.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

using Rgb = std::array<int, 3>;

inline std::shared_ptr<const DepthImage> depth_image(int columns, int rows,
                                                     const std::function<double(int, int)>& level) {
    auto image = std::make_shared<DepthImage>();
    image->columns = columns;
    image->rows = rows;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) image->levels.push_back(static_cast<float>(level(i, j)));
    }
    return image;
}

inline std::shared_ptr<const ColourImage> colour_image(int columns, int rows,
                                                       const std::function<Rgb(int, int)>& colour) {
    auto image = std::make_shared<ColourImage>();
    image->columns = columns;
    image->rows = rows;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            for (const int channel : colour(i, j)) {
                image->rgb.push_back(static_cast<std::uint8_t>(channel));
            }
        }
    }
    return image;
}

inline Frame frame(std::shared_ptr<const DepthImage> depth,
                   std::shared_ptr<const ColourImage> colour = nullptr) {
    Frame made;
    made.depth = std::move(depth);
    made.colour = std::move(colour);
    return made;
}

/// Along the recording axis.
inline Camera straight(int columns, int rows, double relief_px = 255.0) {
    Camera camera;
    camera.frame_relief(columns, rows, relief_px);
    camera.set_projection(Camera::Projection::straight);
    return camera;
}

/// Shows one frame that does not move.
inline SceneContent still(const Frame& shown) {
    SceneContent content;
    content.depth = {&shown, &shown, 0.0};
    content.colour = &shown;
    return content;
}

inline Rgb pixel(const ColourImage& image, glm::ivec2 at) {
    const std::size_t first =
        3 * (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(image.columns) +
             static_cast<std::size_t>(at.x));
    return {image.rgb.at(first), image.rgb.at(first + 1), image.rgb.at(first + 2)};
}

/// The largest difference among the channels.
inline int difference(const Rgb& a, const Rgb& b) {
    int most = 0;
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

/// Where a grid point is on the screen, pixels from the upper left.
inline glm::dvec2 on_screen(const Camera& camera, Vec3 grid, glm::ivec2 size) {
    const double aspect = static_cast<double>(size.x) / size.y;
    const glm::dvec4 clip = camera.clip_from_view(aspect) * camera.view_from_world() *
                            glm::dvec4(camera.world_from_grid(grid), 1.0);
    return {(clip.x / clip.w + 1.0) * 0.5 * size.x, (1.0 - clip.y / clip.w) * 0.5 * size.y};
}

}  // namespace dibhr
