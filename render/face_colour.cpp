// The colour of a face beside an outline.
#include "render/face_colour.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace dibhr {
namespace {

// In units (outline_unit()).
constexpr float kSameColour = 10.0F;  // a larger difference in elevation is another face
constexpr int kApart = 10;  // samples, so that the pattern of a cloth does not go on as stripes
constexpr int kApartNarrow = 3;  // where the face is too narrow
constexpr int kEachSide = 2;     // samples
constexpr int kFringe = 2;       // beside an outline, where the colours of both sides are mixed
constexpr int kFewest = 4;       // samples; fewer are in the shade of the near face

}  // namespace

FaceColour::FaceColour(const Frame* frame, const BlendedDepth& depth)
    : depth_(depth.from),
      elevation_(depth),
      unit_(outline_unit(depth.from)),
      fringe_(kFringe * unit_),
      same_face_px_(kSameColour * static_cast<float>(unit_)) {
    if (frame == nullptr || !frame->has_colour()) return;
    image_ = frame->colour.get();
    video_ = frame->video.get();
}

std::optional<glm::vec3> FaceColour::around(int x, int y) const {
    if (!has_colour()) return std::nullopt;
    const float face_px = elevation_(depth_.index(x, y));
    for (const int apart : {kApart * unit_, kApartNarrow * unit_})
        if (const auto mean = mean_around(x, y, face_px, apart)) return mean;
    return std::nullopt;
}

std::optional<glm::vec3> FaceColour::mean_around(int x, int y, float face_px, int apart) const {
    glm::vec3 sum(0.0F);
    int count = 0;
    for (int dy = -kEachSide * apart; dy <= kEachSide * apart; dy += apart) {
        for (int dx = -kEachSide * apart; dx <= kEachSide * apart; dx += apart) {
            if (!is_inside(x + dx, y + dy, face_px)) continue;
            sum += pixel(x + dx, y + dy);
            ++count;
        }
    }
    if (count < kFewest) return std::nullopt;
    return sum / static_cast<float>(count);
}

bool FaceColour::is_inside(int x, int y, float face_px) const {
    if (x < fringe_ || y < fringe_ || x + fringe_ >= depth_.columns || y + fringe_ >= depth_.rows)
        return false;
    const std::size_t here = depth_.index(x, y);
    const auto on_face = [this, face_px](std::size_t pixel) {
        return std::abs(elevation_(pixel) - face_px) <= same_face_px_;
    };
    const auto columns = static_cast<std::size_t>(fringe_);
    const std::size_t rows = columns * static_cast<std::size_t>(depth_.columns);
    return on_face(here) && on_face(here - columns) && on_face(here + columns) &&
           on_face(here - rows) && on_face(here + rows);
}

glm::vec3 FaceColour::pixel(int x, int y) const {
    const auto under = [](int at, int pixels, int of_depth) {
        return (2 * at + 1) * pixels / (2 * of_depth);
    };
    if (video_ != nullptr) {
        const auto rgb = rgb_at(*video_, under(x, video_->columns, depth_.columns),
                                under(y, video_->rows, depth_.rows));
        return {rgb[0], rgb[1], rgb[2]};
    }
    const auto column = static_cast<std::size_t>(under(x, image_->columns, depth_.columns));
    const auto row = static_cast<std::size_t>(under(y, image_->rows, depth_.rows));
    const std::uint8_t* rgb =
        &image_->rgb[3 * (row * static_cast<std::size_t>(image_->columns) + column)];
    return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace dibhr
