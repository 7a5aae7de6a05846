// Single pictures in files and as a file's bytes.
#include "core/video/sources/picture_files.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/modules/picture_codecs.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace fs = std::filesystem;

ColourImage read_colour_picture(const fs::path& file) {
    return colour_of(read_still(file, PictureRole::colour).picture);
}

BumpMap read_bump_map(const fs::path& file) {
    const StillPicture still = read_still(file, PictureRole::depth);
    const cv::Mat& picture = still.picture;
    require_size(file, picture.cols, picture.rows);
    BumpMap bump{picture.cols, picture.rows, std::vector<float>(picture.total())};
    cv::Mat heights(bump.rows, bump.columns, CV_32FC1, bump.heights.data());
    grey_of(picture).convertTo(heights, CV_32F);
    double lowest = 0.0;
    double highest = 0.0;
    const cv::Mat finite = cv::abs(heights) <= std::numeric_limits<float>::max();
    cv::minMaxLoc(heights, &lowest, &highest, nullptr, nullptr, finite);
    heights.setTo(lowest, ~finite);
    const auto low = static_cast<float>(lowest);
    const auto range = static_cast<float>(highest - lowest);
    for (float& height : bump.heights) height = range > 0.0F ? (height - low) / range : 0.0F;
    return bump;
}

std::string png_of(const ColourImage& picture) {
    set_up_libraries();
    const auto bytes =
        static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows) * 3;
    if (bytes == 0 || picture.rgb.size() != bytes) {
        throw InputError("A picture cannot be written: it is empty");
    }
    const cv::Mat rgb(picture.rows, picture.columns, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));  // only read
    cv::Mat bgr;
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    return encoded_png(bgr);
}

std::string png_of(std::span<const std::uint8_t> levels, int columns, int rows) {
    set_up_libraries();
    return encoded_png(cv::Mat(rows, columns, CV_8UC1,
                               const_cast<std::uint8_t*>(levels.data())));  // only read
}

namespace {

void write_png_into(OutputFile& out, const ColourImage& picture, const fs::path& file) {
    if (picture.rgb.empty())
        throw InputError(shown(file) + " cannot be written: the picture is empty");
    out.write(png_of(picture));
}

}  // namespace

void write_png(const ColourImage& picture, const fs::path& file) {
    OutputFile out(file);
    write_png_into(out, picture, file);
    out.commit();
}

fs::path write_new_png(const ColourImage& picture, const fs::path& file) {
    OutputFile out(file);
    write_png_into(out, picture, file);
    return out.commit_beside();
}

}  // namespace dibhr
