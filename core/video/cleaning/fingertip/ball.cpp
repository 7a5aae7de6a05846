#include "core/video/cleaning/fingertip/ball.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dibhr::fingertip {

Ball::Ball(const Fingertip& finger, double highest_level)
    : radius_px(finger.radius_px),
      radius(static_cast<float>(finger.radius_px)),
      radius_levels(static_cast<float>(finger.radius_px * highest_level / finger.relief_px)),
      px_per_level(static_cast<float>(finger.relief_px / highest_level)),
      levels_per_px(static_cast<float>(highest_level / finger.relief_px)) {}

double Ball::height_px(double away_px) const {
    return std::sqrt(std::max(0.0, radius_px * radius_px - away_px * away_px));
}

void RoomyImage::fit(int columns, int rows, int room, float in_room) {
    if (columns == columns_ && rows == rows_ && room == room_) return;
    columns_ = columns;
    rows_ = rows;
    room_ = room;
    pitch_ = columns + 2 * room;
    levels_.assign(static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(rows + 2 * room),
                   in_room);
}

void RoomyImage::copy(const DepthImage& image) {
    for (int j = 0; j < rows_; ++j)
        std::copy_n(image.levels.data() + image.index(0, j), columns_, pixel(0, j));
}

}  // namespace dibhr::fingertip
