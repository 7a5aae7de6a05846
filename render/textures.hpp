// What the relief is drawn from, on the graphics side: depth, bump and colour textures.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/frame_window.hpp"
#include "render/gl_objects.hpp"
#include "render/relief_grid.hpp"

namespace dibhr {

/// A texture of one float a vertex of the grid.
class GridTexture {
  public:
    /// Row-major, `columns * rows` values.
    void upload(int columns, int rows, const float* values);
    [[nodiscard]] GLuint name() const noexcept { return texture_.get(); }

  private:
    GlTexture texture_{};
    int columns_{0};
    int rows_{0};
};

/// The two depth images of a moment. When playback goes on, the old `to` is the new `from` and
/// stays where it is: one upload a video frame.
class DepthTextures {
  public:
    struct Names {
        GLuint from{0};
        GLuint to{0};
    };
    /// Uploads what is not there yet. Both images have the grid's size.
    Names show(const std::shared_ptr<const DepthImage>& from,
               const std::shared_ptr<const DepthImage>& to, const ReliefGrid& grid);

  private:
    struct Slot {
        GridTexture texture{};
        std::shared_ptr<const DepthImage> image{};  ///< kept alive, so that its address names it
        ReliefGrid grid{};
    };
    GLuint upload(Slot& slot, const std::shared_ptr<const DepthImage>& image,
                  const ReliefGrid& grid);

    std::array<Slot, 2> slots_{};
    std::vector<float> staged_{};
};

/// The bump map's height at every drawn vertex, exactly as the hand feels it.
class BumpTexture {
  public:
    /// Uploads when the map's content or the grid changed. `depth` gives the size only.
    GLuint show(const BumpMap& bump, const DepthImage& depth, const ReliefGrid& grid);

  private:
    GridTexture texture_{};
    std::uint64_t fingerprint_{0};
    ReliefGrid grid_{};
};

/// The colour picture, filtered.
class ColourTexture {
  public:
    /// Uploads when it is another image than last time; larger than `most_side`: thinned out.
    GLuint show(const std::shared_ptr<const ColourImage>& image, int most_side, bool mipmaps);

  private:
    void upload(const ColourImage& image, int most_side, bool mipmaps);

    GlTexture texture_{};
    std::shared_ptr<const ColourImage> image_{};
    int columns_{0};
    int rows_{0};
    std::vector<std::uint8_t> staged_{};
};

}  // namespace dibhr
