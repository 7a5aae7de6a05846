// A framebuffer that is no window: for screenshots of any size.
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "render/gl_objects.hpp"

namespace dibhr {

/// Colour and depth of `size` pixels. Bound from construction to destruction, which puts back the
/// framebuffer and the viewport of before.
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

}  // namespace dibhr
