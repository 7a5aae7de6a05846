// The colour of a frame as the relief's shader samples it: luma and chroma of a video as they come
// where a graphics processor converts them, else red, green and blue.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/video/frames/frame_window.hpp"
#include "render/gl_objects.hpp"

namespace dibhr {

/// 3: luma, blue chroma, red chroma; 2: luma, both chromas; 1: red, green and blue.
[[nodiscard]] int textures_of(const Frame& frame, const GlLimits& limits) noexcept;

class FrameTexture {
  public:
    static constexpr GLint kUnits = 3;

    /// Uploads if the colour has changed. Of larger pictures than `most_side`, and than the limits
    /// allow, every n-th pixel.
    void show(const Frame& frame, int most_side, const GlLimits& limits);
    /// To the units from the first one on.
    void bind(GLint first_unit) const;
    /// The samplers, and how they become a colour. The program must be in use.
    void set(const ShaderProgram& program, GLint first_unit) const;

  private:
    /// A texture that keeps its memory while size and form stay.
    struct Plane {
        GlTexture texture{};
        int columns{0}, rows{0};
        GLint form{0};
    };
    void upload(std::size_t at, const SamplePlane& plane, int channels, int sample_bytes);
    void upload_planes(const VideoPicture& picture);
    void upload_converted(const VideoPicture& picture, int most_side);

    ColourTexture image_{};
    std::array<Plane, kUnits> planes_{};
    std::array<GLuint, kUnits> names_{};
    UploadedFrom<void> colour_{};
    int count_{1};
    PlaneTurn turn_{};
    glm::vec2 chroma_scale_{1.0F};
    std::array<std::array<float, 4>, 3> rgb_of_samples_{};
    std::vector<std::uint32_t> staged_{};
};

}  // namespace dibhr
