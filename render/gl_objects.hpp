// OpenGL names that free themselves, shader programs, and the textures the relief is drawn from;
// all need a current context.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/frame_window.hpp"
#include "render/object_mark.hpp"
#include "render/relief_grid.hpp"

namespace dibhr {

/// Owns one OpenGL name, made by `Generate` and freed by `Delete`, of the family that takes (count,
/// names).
template <auto& Generate, auto& Delete>
class GlName {
  public:
    GlName() { Generate(1, &name_); }
    ~GlName() { Delete(1, &name_); }
    GlName(const GlName&) = delete;
    GlName& operator=(const GlName&) = delete;
    [[nodiscard]] GLuint get() const noexcept { return name_; }

  private:
    GLuint name_{0};
};

using GlTexture = GlName<glGenTextures, glDeleteTextures>;
using GlBuffer = GlName<glGenBuffers, glDeleteBuffers>;
using GlVertexArray = GlName<glGenVertexArrays, glDeleteVertexArrays>;
using GlFramebuffer = GlName<glGenFramebuffers, glDeleteFramebuffers>;
using GlRenderbuffer = GlName<glGenRenderbuffers, glDeleteRenderbuffers>;

/// The offset of an attribute in its vertex, in OpenGL's form.
[[nodiscard]] inline const void* attribute_offset(std::size_t bytes) noexcept {
    return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr): its way
}

/// A linked program. Throws DeviceError with the driver's log when it refuses the source.
class ShaderProgram {
  public:
    /// `defines` are lines put right after `#version`, the same for both stages.
    ShaderProgram(std::string_view vertex, std::string_view fragment,
                  const std::string& defines = {});
    ~ShaderProgram();
    ShaderProgram(const ShaderProgram&) = delete;
    ShaderProgram& operator=(const ShaderProgram&) = delete;

    void use() const;
    // The program must be in use; a name the driver removed as unused is no error.
    void set(const char* name, int value) const;
    void set(const char* name, float value) const;
    void set(const char* name, glm::ivec2 value) const;
    void set(const char* name, glm::vec2 value) const;
    void set(const char* name, glm::vec3 value) const;
    void set(const char* name, glm::vec4 value) const;
    void set(const char* name, const glm::mat4& value) const;

  private:
    GLuint name_{0};
};

/// The driver's limits, read once.
struct GlLimits {
    bool software{false};  ///< drawn by the processor: llvmpipe, softpipe and the like
    int texture_side{0};   ///< largest width and height of a texture
    int samples{0};        ///< most samples a pixel
};

/// Throws DeviceError when the current context is older than OpenGL 3.3.
[[nodiscard]] GlLimits read_limits();

/// Of the bound texture, whose edge goes on beyond it.
void filter_texture(GLenum minify, GLenum magnify);

/// Waits until all is drawn, or until `go_on`, called every 5 ms, returns false.
void wait_for_drawing(const std::function<bool()>& go_on);

/// Call it after each picture. Throws DeviceError if the driver was reset or is out of memory:
/// after that nothing is drawn.
void require_graphics();

/// A framebuffer with colour and depth of `size` pixels, bound from construction to destruction.
/// The destructor restores the previous framebuffer and viewport.
class Offscreen {
  public:
    /// `samples` a pixel, 0: one, without smoothing. Throws DeviceError when the driver cannot make
    /// it.
    Offscreen(glm::ivec2 size, int samples);
    ~Offscreen();
    Offscreen(const Offscreen&) = delete;
    Offscreen& operator=(const Offscreen&) = delete;

    /// Merges the samples, so that the bound framebuffer can be read.
    void resolve();

  private:
    glm::ivec2 size_{0};
    int samples_{0};
    GLint framebuffer_before_{0};
    std::array<GLint, 4> viewport_before_{};
    GlFramebuffer drawn_{};
    GlRenderbuffer colour_{};
    GlRenderbuffer depth_{};
    GlFramebuffer merged_{};
    GlRenderbuffer merged_colour_{};
};

/// Identifies the shared object that a texture was filled from.
template <typename T>
class UploadedFrom {
  public:
    [[nodiscard]] bool is(const std::shared_ptr<const T>& object) const noexcept {
        return object_ == ObjectMark(object);
    }
    void set(const std::shared_ptr<const T>& object) noexcept { object_ = ObjectMark(object); }

  private:
    std::optional<ObjectMark> object_{};
};

/// A texture with one float for each vertex of the grid.
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

/// The surface between two depth images at every vertex of a grid [px].
class ElevationTexture {
  public:
    /// Uploads if an image, the blend, the scale or the grid has changed. Whether it did.
    bool show(const DepthBlend& depth, double px_per_level, const ReliefGrid& grid);
    [[nodiscard]] GLuint name() const noexcept { return texture_.name(); }
    [[nodiscard]] const std::vector<float>& elevations() const noexcept { return elevations_; }

  private:
    struct Source {
        ObjectMark from{}, to{};
        double blend{0.0};
        double px_per_level{0.0};
        ReliefGrid grid{};
        bool operator==(const Source&) const = default;
    };
    GridTexture texture_{};
    std::optional<Source> source_{};
    std::vector<float> elevations_{};
};

/// The mask of places where no surface was ever seen (1), filtered.
class UnseenTexture {
  public:
    /// Uploads if the mask or the grid has changed. The mask has the size of the grid's image.
    GLuint show(const std::shared_ptr<const std::vector<std::uint8_t>>& mask,
                const ReliefGrid& grid);

  private:
    GlTexture texture_{};
    UploadedFrom<std::vector<std::uint8_t>> mask_{};
    ReliefGrid grid_{};
    std::vector<std::uint8_t> staged_{};
};

/// The bump map's height at every drawn vertex, exactly as it is rendered to the hand.
class BumpTexture {
  public:
    /// Uploads when the map's content, its size (SurfaceShape::bump_size_px) or the grid changed.
    /// `depth` is used for the image's size only.
    GLuint show(const BumpMap& bump, double size_px, const DepthImage& depth,
                const ReliefGrid& grid);

  private:
    GridTexture texture_{};
    std::uint64_t fingerprint_{0};
    double size_px_{0.0};
    ReliefGrid grid_{};
};

/// Painted heights at every drawn vertex.
class HeightTexture {
  public:
    /// Uploads if the maps or the grid have changed. The maps have the size of the grid's image.
    GLuint show(const std::shared_ptr<const TouchMaps>& maps, const ReliefGrid& grid);

  private:
    GridTexture texture_{};
    UploadedFrom<TouchMaps> maps_{};
    ReliefGrid grid_{};
    std::vector<float> staged_{};
};

/// The colour picture, filtered.
class ColourTexture {
  public:
    /// Uploads if the image has changed. An image larger than `most_side` is subsampled.
    GLuint show(const std::shared_ptr<const ColourImage>& image, int most_side, bool mipmaps);
    [[nodiscard]] GLuint name() const noexcept { return texture_.get(); }

  private:
    void upload(const ColourImage& image, int most_side, bool mipmaps);

    GlTexture texture_{};
    UploadedFrom<ColourImage> image_{};
    int columns_{0};
    int rows_{0};
    std::vector<std::uint8_t> staged_{};
};

}  // namespace dibhr
