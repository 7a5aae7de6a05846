// Reads HEIC photos by libheif.
#include "core/video/formats/still_picture.hpp"

#include <libheif/heif.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

struct Freed {
    void operator()(heif_context* context) const noexcept { heif_context_free(context); }
    void operator()(heif_image_handle* handle) const noexcept { heif_image_handle_release(handle); }
    void operator()(heif_image* image) const noexcept { heif_image_release(image); }
    void operator()(const heif_depth_representation_info* info) const noexcept {
        heif_depth_representation_info_free(info);
    }
};
using Context = std::unique_ptr<heif_context, Freed>;
using Handle = std::unique_ptr<heif_image_handle, Freed>;
using Image = std::unique_ptr<heif_image, Freed>;
using Representation = std::unique_ptr<const heif_depth_representation_info, Freed>;

void require_done(const heif_error& error, const fs::path& file) {
    if (error.code == heif_error_Ok) return;
    if (error.subcode == heif_suberror_Unsupported_codec)
        throw InputError(shown(file) +
                         " needs a decoder that is not installed: apt-get install "
                         "libheif-plugin-libde265, or export it as PNG");
    throw InputError(shown(file) +
                     " cannot be decoded as a HEIC picture: it may be damaged, export it again");
}

Context opened_heif(const fs::path& file) {
    Context context(heif_context_alloc());
    if (context == nullptr) throw InputError(shown(file) + " cannot be read: memory is full");
    require_done(heif_context_read_from_file(context.get(), file.c_str(), nullptr), file);
    return context;
}

Handle primary_of(heif_context& context, const fs::path& file) {
    heif_image_handle* handle = nullptr;
    require_done(heif_context_get_primary_image_handle(&context, &handle), file);
    return Handle(handle);
}

/// The id of its depth picture; nothing when there is none.
std::optional<heif_item_id> depth_id(const heif_image_handle& primary) {
    heif_item_id id = 0;
    if (heif_image_handle_get_list_of_depth_image_IDs(&primary, &id, 1) < 1) return std::nullopt;
    return id;
}

Image decoded(const heif_image_handle& handle, heif_colorspace space, heif_chroma chroma,
              const fs::path& file) {
    require_plausible_size(file, heif_image_handle_get_width(&handle),
                           heif_image_handle_get_height(&handle), 3);
    heif_image* image = nullptr;
    require_done(heif_decode_image(&handle, &image, space, chroma, nullptr), file);
    return Image(image);
}

/// A copy of one plane of a decoded picture. Throws InputError when there is none.
cv::Mat plane_of(const heif_image& image, heif_channel channel, int type, const fs::path& file) {
    int row_bytes = 0;
    const std::uint8_t* const first = heif_image_get_plane_readonly(&image, channel, &row_bytes);
    const int columns = heif_image_get_width(&image, channel);
    const int rows = heif_image_get_height(&image, channel);
    if (first == nullptr || columns < 1 || rows < 1)
        throw InputError(shown(file) +
                         " holds a picture of an unknown kind: export it as PNG or JPEG");
    cv::Mat plane(rows, columns, type);
    const std::size_t used = plane.elemSize() * static_cast<std::size_t>(columns);
    for (int j = 0; j < rows; ++j)
        std::memcpy(plane.ptr(j), first + static_cast<std::ptrdiff_t>(j) * row_bytes, used);
    return plane;
}

/// The depth facts that "level x scale" can express. Levels begin at z_far or d_min, so the scale
/// is known only where d_min is 0.
DepthStatement statement_of(const heif_image_handle& primary, heif_item_id id, int bits) {
    DepthStatement statement;
    const heif_depth_representation_info* given = nullptr;
    const bool has_info =
        heif_image_handle_get_depth_image_representation_info(&primary, id, &given) != 0;
    const Representation info(given);
    if (!has_info || info == nullptr) {
        statement.unit = DepthUnit::disparity;  // as phones write it
        return statement;
    }
    if (info->depth_representation_type == heif_depth_representation_type_uniform_Z) {
        statement.near = NearLevels::dark;
        return statement;
    }
    statement.unit = DepthUnit::disparity;
    const bool from_nothing = info->has_d_min != 0 && info->has_d_max != 0 && info->d_min == 0.0;
    if (from_nothing && info->d_max > 0.0) statement.scale = info->d_max / highest_level(bits);
    return statement;
}

StillPicture read_colour(const heif_image_handle& primary, const fs::path& file) {
    const Image image = decoded(primary, heif_colorspace_RGB, heif_chroma_interleaved_RGB, file);
    cv::Mat picture = plane_of(*image, heif_channel_interleaved, CV_8UC3, file);
    cv::cvtColor(picture, picture, cv::COLOR_RGB2BGR);
    return {picture, 8, "HEIC"};
}

/// What a photo without depth has instead, by the types of the pictures in the file's directory,
/// which is its beginning.
const char* refusal_without_depth(const fs::path& file) {
    constexpr std::size_t kDirectory_bytes = 1 << 16;
    const std::string directory = beginning_of(file, kDirectory_bytes);
    const auto holds = [&directory](const char* type) {
        return directory.find(type) != std::string::npos;
    };
    if (holds("aux:hdrgainmap")) return kGainMapAlone;
    if (holds("aux:portraiteffectsmatte") || holds("aux:semantic"))
        return " is a photo that has only a mask of the person in it, and no depth: give a "
               "portrait photo that kept its depth, or give the depth file as the second file";
    return " is a photo without depth: give a portrait photo, or a depth file beside it";
}

StillPicture read_depth(const heif_image_handle& primary, const fs::path& file) {
    const auto id = depth_id(primary);
    if (!id) throw InputError(shown(file) + refusal_without_depth(file));
    heif_image_handle* found = nullptr;
    require_done(heif_image_handle_get_depth_image_handle(&primary, *id, &found), file);
    const Handle depth(found);
    const Image image = decoded(*depth, heif_colorspace_undefined, heif_chroma_undefined, file);
    const int bits = heif_image_get_bits_per_pixel_range(image.get(), heif_channel_Y);
    cv::Mat levels = plane_of(*image, heif_channel_Y, bits > 8 ? CV_16UC1 : CV_8UC1, file);
    return {levels,
            bits,
            "HEIC",
            {finding_of_metadata(statement_of(primary, *id, bits), "HEIC depth picture")}};
}

}  // namespace

StillPicture read_heif(const fs::path& file, PictureRole role) {
    const Context context = opened_heif(file);
    const Handle primary = primary_of(*context, file);
    return role == PictureRole::colour ? read_colour(*primary, file) : read_depth(*primary, file);
}

bool heif_has_depth(const fs::path& file) {
    try {
        const Context context = opened_heif(file);
        return depth_id(*primary_of(*context, file)).has_value();
    } catch (const InputError&) {
        return false;
    }
}

}  // namespace dibhr
