// OpenGL names that free themselves, and shader programs.
#include "render/gl_objects.hpp"

#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

GLuint compile(GLenum stage, std::string_view text, const std::string& defines) {
    const auto line_end = text.find('\n', text.find("#version")) + 1;
    std::string source(text.substr(0, line_end));
    source += defines;
    source += text.substr(line_end);
    const char* pointer = source.c_str();
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &pointer, nullptr);
    glCompileShader(shader);
    return shader;
}

std::string link_log(GLuint program, GLuint vertex, GLuint fragment) {
    char text[1024] = {};
    std::string log;
    glGetShaderInfoLog(vertex, sizeof text, nullptr, text);
    log += text;
    glGetShaderInfoLog(fragment, sizeof text, nullptr, text);
    log += text;
    glGetProgramInfoLog(program, sizeof text, nullptr, text);
    log += text;
    for (char& c : log) {
        if (c == '\n') c = ' ';
    }
    return log;
}

}  // namespace

ShaderProgram::ShaderProgram(std::string_view vertex, std::string_view fragment,
                             const std::string& defines)
    : name_(glCreateProgram()) {
    const GLuint vertex_shader = compile(GL_VERTEX_SHADER, vertex, defines);
    const GLuint fragment_shader = compile(GL_FRAGMENT_SHADER, fragment, defines);
    glAttachShader(name_, vertex_shader);
    glAttachShader(name_, fragment_shader);
    glLinkProgram(name_);
    GLint linked = GL_FALSE;
    glGetProgramiv(name_, GL_LINK_STATUS, &linked);
    const std::string log = linked ? "" : link_log(name_, vertex_shader, fragment_shader);
    glDeleteShader(vertex_shader);
    glDeleteShader(fragment_shader);
    if (!linked) {
        glDeleteProgram(name_);
        throw DeviceError("the graphics driver refused a shader (" + log +
                          "); update the driver, or set LIBGL_ALWAYS_SOFTWARE=1");
    }
}

ShaderProgram::~ShaderProgram() {
    glDeleteProgram(name_);
}

void ShaderProgram::use() const {
    glUseProgram(name_);
}
void ShaderProgram::set(const char* name, int value) const {
    glUniform1i(glGetUniformLocation(name_, name), value);
}
void ShaderProgram::set(const char* name, float value) const {
    glUniform1f(glGetUniformLocation(name_, name), value);
}
void ShaderProgram::set(const char* name, glm::ivec2 value) const {
    glUniform2i(glGetUniformLocation(name_, name), value.x, value.y);
}
void ShaderProgram::set(const char* name, glm::vec2 value) const {
    glUniform2f(glGetUniformLocation(name_, name), value.x, value.y);
}
void ShaderProgram::set(const char* name, glm::vec3 value) const {
    glUniform3f(glGetUniformLocation(name_, name), value.x, value.y, value.z);
}
void ShaderProgram::set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(glGetUniformLocation(name_, name), 1, GL_FALSE, glm::value_ptr(value));
}

GlLimits read_limits() {
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 33) {
        throw DeviceError(
            "the graphics driver offers no OpenGL 3.3; update it, or set LIBGL_ALWAYS_SOFTWARE=1");
    }
    GlLimits limits;
    const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view renderer = text ? text : "";
    for (const std::string_view name : {"llvmpipe", "softpipe", "swrast", "SWR", "Software"}) {
        limits.software = limits.software || renderer.find(name) != std::string_view::npos;
    }
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits.texture_side);
    glGetIntegerv(GL_MAX_SAMPLES, &limits.samples);
    return limits;
}

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
