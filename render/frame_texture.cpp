// Uploads decoded planes, or what the processor makes of them.
#include "render/frame_texture.hpp"

#include <algorithm>
#include <cstddef>

namespace dibhr {

namespace {

GLint form_of(int channels, int sample_bytes) {
    if (sample_bytes == 1) return channels == 1 ? GL_R8 : GL_RG8;
    return channels == 1 ? GL_R16 : GL_RG16;
}

glm::vec3 vector_of(const std::array<float, 3>& numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

/// Of chroma beside luma: less than 1 where an odd side is rounded up.
float scale_of(int luma, int chroma) {
    const int each = (luma + chroma - 1) / chroma;
    return chroma == 1 ? 1.0F : static_cast<float>(luma) / static_cast<float>(each * chroma);
}

}  // namespace

int textures_of(const Frame& frame, const GlLimits& limits) noexcept {
    if (!frame.video || limits.software) return 1;
    const SamplePlane& luma = frame.video->planes[0];
    const bool fits = std::max(luma.columns, luma.rows) <= limits.texture_side;
    return fits ? frame.video->plane_count : 1;
}

void FrameTexture::show(const Frame& frame, int most_side, const GlLimits& limits) {
    if (colour_.is(frame.colour_object())) return;
    count_ = textures_of(frame, limits);
    turn_ = turn_of(frame.video ? frame.video->quarter_turns : 0);
    if (!frame.video)
        names_ = {image_.show(frame.colour, most_side, !limits.software)};
    else if (count_ == 1)
        upload_converted(*frame.video, most_side);
    else
        upload_planes(*frame.video);
    colour_.set(frame.colour_object());
}

void FrameTexture::upload_converted(const VideoPicture& picture, int most_side) {
    const int side = std::max(picture.planes[0].columns, picture.planes[0].rows);
    const auto [columns, rows] = write_rgbx(picture, (side + most_side - 1) / most_side, staged_);
    Plane& plane = planes_[0];
    glBindTexture(GL_TEXTURE_2D, plane.texture.get());
    if (columns == plane.columns && rows == plane.rows && plane.form == GL_RGBA8) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, GL_RGBA, GL_UNSIGNED_BYTE,
                        staged_.data());
    } else {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, columns, rows, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     staged_.data());
        filter_texture(GL_LINEAR, GL_LINEAR);
        plane.columns = columns;
        plane.rows = rows;
        plane.form = GL_RGBA8;
    }
    names_ = {plane.texture.get()};
}

void FrameTexture::upload_planes(const VideoPicture& picture) {
    const SamplePlane& luma = picture.planes[0];
    const SamplePlane& chroma = picture.planes[1];
    names_ = {};
    for (std::size_t k = 0; k < static_cast<std::size_t>(picture.plane_count); ++k)
        upload(k, picture.planes[k], k > 0 && picture.plane_count == 2 ? 2 : 1,
               picture.sample_bytes);
    chroma_scale_ = {scale_of(luma.columns, chroma.columns), scale_of(luma.rows, chroma.rows)};
    rgb_of_samples_ = picture.rgb_of_samples;
}

void FrameTexture::upload(std::size_t at, const SamplePlane& plane, int channels,
                          int sample_bytes) {
    Plane& into = planes_[at];
    const GLint form = form_of(channels, sample_bytes);
    const GLenum channel = channels == 1 ? GL_RED : GL_RG;
    const GLenum type = sample_bytes == 1 ? GL_UNSIGNED_BYTE : GL_UNSIGNED_SHORT;
    glBindTexture(GL_TEXTURE_2D, into.texture.get());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH,
                  static_cast<GLint>(plane.row_bytes) / (channels * sample_bytes));
    if (plane.columns == into.columns && plane.rows == into.rows && form == into.form) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, plane.columns, plane.rows, channel, type,
                        plane.samples);
    } else {
        glTexImage2D(GL_TEXTURE_2D, 0, form, plane.columns, plane.rows, 0, channel, type,
                     plane.samples);
        filter_texture(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
        into.columns = plane.columns;
        into.rows = plane.rows;
        into.form = form;
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glGenerateMipmap(GL_TEXTURE_2D);
    names_[at] = into.texture.get();
}

void FrameTexture::bind(GLint first_unit) const {
    for (GLint k = 0; k < count_; ++k) {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(first_unit + k));
        glBindTexture(GL_TEXTURE_2D, names_[static_cast<std::size_t>(k)]);
    }
}

void FrameTexture::set(const ShaderProgram& program, GLint first_unit) const {
    program.set("colour", first_unit);
    program.set("chroma", first_unit + 1);
    program.set("red_chroma", first_unit + 2);
    program.set("colour_across", vector_of(turn_.across));
    program.set("colour_down", vector_of(turn_.down));
    program.set("chroma_scale", chroma_scale_);
    constexpr std::array kRows{"red_of", "green_of", "blue_of"};
    for (std::size_t k = 0; k < kRows.size(); ++k) {
        const auto& row = rgb_of_samples_[k];
        program.set(kRows[k], glm::vec4(row[0], row[1], row[2], row[3]));
    }
}

}  // namespace dibhr
