// A framebuffer that is no window.
#include "render/offscreen.hpp"

#include <string>

#include "core/error.hpp"

namespace dibhr {
namespace {

void attach(GLenum point, const GlRenderbuffer& buffer, GLenum format, glm::ivec2 size,
            int samples) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.get());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size.x, size.y);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer.get());
}

}  // namespace

Offscreen::Offscreen(glm::ivec2 size, int samples) : size_(size), samples_(samples) {
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &framebuffer_before_);
    glGetIntegerv(GL_VIEWPORT, viewport_before_.data());
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.get());
    attach(GL_COLOR_ATTACHMENT0, colour_, GL_RGBA8, size, samples);
    attach(GL_DEPTH_ATTACHMENT, depth_, GL_DEPTH_COMPONENT24, size, samples);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer_before_));
        throw DeviceError("the graphics driver cannot draw a picture of " + std::to_string(size.x) +
                          "x" + std::to_string(size.y) + " pixels; ask for a smaller one");
    }
}

Offscreen::~Offscreen() {
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer_before_));
    const auto& [x, y, width, height] = viewport_before_;
    glViewport(x, y, width, height);
}

void Offscreen::resolve() {
    if (samples_ == 0) return;
    glBindFramebuffer(GL_FRAMEBUFFER, merged_.get());
    attach(GL_COLOR_ATTACHMENT0, merged_colour_, GL_RGBA8, size_, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.get());
    glBlitFramebuffer(0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, merged_.get());
}

}  // namespace dibhr
