// OpenGL names that free themselves, and shader programs; all need a current context.
#pragma once

#include <epoxy/gl.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace dibhr {

/// Owns one OpenGL name; `Kind` makes and frees it.
template <class Kind>
class GlName {
  public:
    GlName() : name_(Kind::make()) {}
    ~GlName() { Kind::free(name_); }
    GlName(const GlName&) = delete;
    GlName& operator=(const GlName&) = delete;
    [[nodiscard]] GLuint get() const noexcept { return name_; }

  private:
    GLuint name_{0};
};

struct TextureKind {
    static GLuint make();
    static void free(GLuint name);
};
struct BufferKind {
    static GLuint make();
    static void free(GLuint name);
};
struct VertexArrayKind {
    static GLuint make();
    static void free(GLuint name);
};
struct FramebufferKind {
    static GLuint make();
    static void free(GLuint name);
};
struct RenderbufferKind {
    static GLuint make();
    static void free(GLuint name);
};

using GlTexture = GlName<TextureKind>;
using GlBuffer = GlName<BufferKind>;
using GlVertexArray = GlName<VertexArrayKind>;
using GlFramebuffer = GlName<FramebufferKind>;
using GlRenderbuffer = GlName<RenderbufferKind>;

/// A linked program. Throws DeviceError with the driver's words when it refuses the source.
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
    void set(const char* name, const glm::mat4& value) const;

  private:
    GLuint name_{0};
};

/// What the driver offers, read once.
struct GlLimits {
    bool software{false};  ///< drawn by the processor: llvmpipe, softpipe and the like
    int texture_side{0};   ///< largest width and height of a texture
    int samples{0};        ///< most samples a pixel
};

/// Throws DeviceError when the current context is older than OpenGL 3.3.
[[nodiscard]] GlLimits read_limits();

}  // namespace dibhr
