// The colour of a face beside an outline.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "core/video/frames/frame_window.hpp"
#include "render/blended_depth.hpp"

namespace dibhr {

/// The colour of a face around a vertex, from pixels that are well inside of the face.
class FaceColour {
  public:
    /// `frame`: whose colour it is, of the same view, of any size; may be null.
    FaceColour(const Frame* frame, const BlendedDepth& depth);

    /// The mean around a pixel of the depth image; nothing where an outline is near on all sides.
    [[nodiscard]] std::optional<glm::vec3> around(int x, int y) const;

    /// Of a pixel of the depth image alone; nothing without colour.
    [[nodiscard]] std::optional<glm::vec3> at(int x, int y) const {
        return has_colour() ? std::optional<glm::vec3>(pixel(x, y)) : std::nullopt;
    }

  private:
    [[nodiscard]] bool has_colour() const { return image_ != nullptr || video_ != nullptr; }
    [[nodiscard]] std::optional<glm::vec3> mean_around(int x, int y, float face_px,
                                                       int apart) const;
    [[nodiscard]] bool is_inside(int x, int y, float face_px) const;
    [[nodiscard]] glm::vec3 pixel(int x, int y) const;

    const ColourImage* image_{nullptr};
    const VideoPicture* video_{nullptr};
    const DepthImage& depth_;  // used for the size only
    PixelElevation elevation_;
    int unit_;    ///< [px of the depth image]
    int fringe_;  ///< likewise
    float same_face_px_;
};

}  // namespace dibhr
