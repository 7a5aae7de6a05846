// OpenGL names that free themselves, shader programs and the textures of the relief.
#include "render/gl_objects.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "core/error.hpp"
#include "core/haptics/surface.hpp"
#include "render/blended_depth.hpp"

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

void attach(GLenum point, const GlRenderbuffer& buffer, GLenum format, glm::ivec2 size,
            int samples) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.get());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size.x, size.y);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer.get());
}

constexpr std::size_t kFingerprintSamples = 4096;

/// Identifies a map by its size and evenly spaced heights (FNV-1a): its address may be reused by
/// another map.
std::uint64_t fingerprint(const BumpMap& bump) {
    std::uint64_t hash = 14695981039346656037ULL;
    const auto mix = [&hash](std::uint64_t value) { hash = (hash ^ value) * 1099511628211ULL; };
    mix(static_cast<std::uint64_t>(bump.columns));
    mix(static_cast<std::uint64_t>(bump.rows));
    const std::size_t stride = std::max<std::size_t>(bump.heights.size() / kFingerprintSamples, 1);
    for (std::size_t k = 0; k < bump.heights.size(); k += stride) {
        mix(std::bit_cast<std::uint32_t>(bump.heights[k]));
    }
    return hash;
}

}  // namespace

void filter_texture(GLenum minify, GLenum magnify) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minify));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magnify));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

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

void ShaderProgram::set(const char* name, glm::vec4 value) const {
    glUniform4f(glGetUniformLocation(name_, name), value.x, value.y, value.z, value.w);
}
void ShaderProgram::set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(glGetUniformLocation(name_, name), 1, GL_FALSE, glm::value_ptr(value));
}

void wait_for_drawing(const std::function<bool()>& go_on) {
    constexpr GLuint64 kStep_ns = 5'000'000;
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    while (glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kStep_ns) == GL_TIMEOUT_EXPIRED &&
           go_on()) {
    }
    glDeleteSync(fence);
}

void require_graphics() {
    if (epoxy_has_gl_extension("GL_ARB_robustness") &&
        glGetGraphicsResetStatusARB() != GL_NO_ERROR) {
        throw DeviceError("the graphics driver was reset: start dibhr again");
    }
    if (glGetError() == GL_OUT_OF_MEMORY) {
        throw DeviceError(
            "the graphics driver is out of memory: close other programs, or make the window "
            "smaller with --size");
    }
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

void GridTexture::upload(int columns, int rows, const float* values) {
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    if (columns == columns_ && rows == rows_) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, GL_RED, GL_FLOAT, values);
        return;
    }
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, columns, rows, 0, GL_RED, GL_FLOAT, values);
    filter_texture(GL_LINEAR, GL_LINEAR);
    columns_ = columns;
    rows_ = rows;
}

bool ElevationTexture::show(const DepthBlend& depth, double px_per_level, const ReliefGrid& grid) {
    const auto& from = depth.from->drawn();
    const auto& to = depth.to->drawn();
    const Source source{ObjectMark(from), ObjectMark(to), depth.blend, px_per_level, grid};
    if (source_ == source) return false;
    drawn_elevations({*from, *to, depth.blend, px_per_level}, grid, elevations_);
    texture_.upload(grid.columns(), grid.rows(), elevations_.data());
    source_ = source;
    return true;
}

GLuint UnseenTexture::show(const std::shared_ptr<const std::vector<std::uint8_t>>& mask,
                           const ReliefGrid& grid) {
    if (mask_.is(mask) && grid == grid_) return texture_.get();
    constexpr std::uint8_t kWhite = 255;
    staged_.clear();
    for (int j = 0; j < grid.rows(); ++j) {
        const auto row = static_cast<std::size_t>(grid.image_j(j)) *
                         static_cast<std::size_t>(grid.image_columns);
        for (int i = 0; i < grid.columns(); ++i) {
            const bool none = (*mask)[row + static_cast<std::size_t>(grid.image_i(i))] != 0;
            staged_.push_back(none ? kWhite : 0);
        }
    }
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, grid.columns(), grid.rows(), 0, GL_RED, GL_UNSIGNED_BYTE,
                 staged_.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    filter_texture(GL_LINEAR, GL_LINEAR);
    mask_.set(mask);
    grid_ = grid;
    return texture_.get();
}

GLuint BumpTexture::show(const BumpMap& bump, double size_px, const DepthImage& depth,
                         const ReliefGrid& grid) {
    const std::uint64_t print = fingerprint(bump);
    if (print == fingerprint_ && size_px == size_px_ && grid == grid_) return texture_.name();
    const DepthSurface bump_alone(depth, depth, 0.0, SurfaceShape{0.0, 1.0, size_px}, &bump);
    std::vector<float> heights;
    for (int j = 0; j < grid.rows(); ++j) {
        for (int i = 0; i < grid.columns(); ++i) {
            const double height = bump_alone.elevation(grid.image_i(i), grid.image_j(j));
            heights.push_back(static_cast<float>(height));
        }
    }
    texture_.upload(grid.columns(), grid.rows(), heights.data());
    fingerprint_ = print;
    size_px_ = size_px;
    grid_ = grid;
    return texture_.name();
}

GLuint HeightTexture::show(const std::shared_ptr<const TouchMaps>& maps, const ReliefGrid& grid) {
    if (maps_.is(maps) && grid == grid_) return texture_.name();
    const std::vector<float>& heights_px = maps->at_vertices.heights_px;
    staged_.clear();
    for (int j = 0; j < grid.rows(); ++j) {
        const auto row = static_cast<std::size_t>(grid.image_j(j)) *
                         static_cast<std::size_t>(grid.image_columns);
        for (int i = 0; i < grid.columns(); ++i)
            staged_.push_back(heights_px[row + static_cast<std::size_t>(grid.image_i(i))]);
    }
    texture_.upload(grid.columns(), grid.rows(), staged_.data());
    maps_.set(maps);
    grid_ = grid;
    return texture_.name();
}

GLuint ColourTexture::show(const std::shared_ptr<const ColourImage>& image, int most_side,
                           bool mipmaps) {
    if (!image_.is(image)) {
        upload(*image, most_side, mipmaps);
        image_.set(image);
    }
    return texture_.get();
}

void ColourTexture::upload(const ColourImage& image, int most_side, bool mipmaps) {
    const int step = (std::max(image.columns, image.rows) + most_side - 1) / most_side;
    const int columns = std::max(image.columns / step, 1);
    const int rows = std::max(image.rows / step, 1);
    const auto middle = [step](int k, int count) {
        return std::min(k * step + step / 2, count - 1);
    };
    const std::uint8_t* values = image.rgb.data();
    if (step > 1) {
        staged_.clear();
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                const auto pixel = static_cast<std::size_t>(middle(j, image.rows)) *
                                       static_cast<std::size_t>(image.columns) +
                                   static_cast<std::size_t>(middle(i, image.columns));
                const std::uint8_t* rgb = values + 3 * pixel;
                staged_.insert(staged_.end(), {rgb[0], rgb[1], rgb[2]});
            }
        }
        values = staged_.data();
    }
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (columns == columns_ && rows == rows_) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, GL_RGB, GL_UNSIGNED_BYTE, values);
    } else {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, columns, rows, 0, GL_RGB, GL_UNSIGNED_BYTE, values);
        filter_texture(mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR, GL_LINEAR);
        columns_ = columns;
        rows_ = rows;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (mipmaps) glGenerateMipmap(GL_TEXTURE_2D);
}

}  // namespace dibhr
