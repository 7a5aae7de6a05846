// Reads the ends of files, bounds claimed sizes, and converts light to screen levels.
#include "core/video/formats/file_bytes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <opencv2/core.hpp>
#include <system_error>

#include "core/error.hpp"
#include "core/files/names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMostCompressed = 65536;  // flat pictures in DWAB and HEVC; deflate: 1032

std::uint8_t screen_level(float light) {
    if (!(light > 0.0F)) return 0;  // also for NaN
    if (light >= 1.0F) return 255;
    const float level =
        light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255.0F * level));
}

enum class From { beginning, end };

std::string bytes_of(const fs::path& file, std::size_t most, From from) {
    if (!is_file(file)) return {};
    const std::uint64_t bytes = size_of(file);
    std::string text(std::min<std::uint64_t>(bytes, most), '\0');
    std::ifstream in(file, std::ios::binary);
    if (from == From::end) in.seekg(static_cast<std::streamoff>(bytes - text.size()));
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

}  // namespace

std::string beginning_of(const fs::path& file, std::size_t most) {
    return bytes_of(file, most, From::beginning);
}

std::string end_of(const fs::path& file, std::size_t most) {
    return bytes_of(file, most, From::end);
}

std::string head_of(const fs::path& file) {
    constexpr std::size_t kHeadBytes = 32;
    return beginning_of(file, kHeadBytes);
}

std::uint64_t size_of(const std::filesystem::path& file) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(file, failed);
    return failed ? 0 : size;
}

bool may_be_decoded(std::int64_t columns, std::int64_t rows,
                    std::int64_t bytes_per_pixel) noexcept {
    return columns >= 1 && rows >= 1 && columns <= kMostPixels / rows &&
           columns * rows <= kMostPictureBytes / std::max<std::int64_t>(bytes_per_pixel, 1);
}

bool can_hold(std::uint64_t bytes, std::int64_t columns, std::int64_t rows,
              std::int64_t bytes_per_pixel) {
    if (!may_be_decoded(columns, rows, bytes_per_pixel)) return false;
    const auto decoded = static_cast<std::uint64_t>(columns * rows * bytes_per_pixel);
    return decoded / kMostCompressed <= bytes;
}

void require_plausible_size(const std::filesystem::path& file, std::int64_t columns,
                            std::int64_t rows, std::int64_t bytes_per_pixel) {
    const std::string claim = shown(file) + " says that it is " + std::to_string(columns) + " x " +
                              std::to_string(rows) + " pixels";
    if (!may_be_decoded(columns, rows, bytes_per_pixel))
        throw InputError(claim +
                         (bytes_per_pixel > 1 ? " of " + std::to_string(bytes_per_pixel) + " bytes"
                                              : std::string()) +
                         ": give a smaller one, of at most 33 megapixels and 256 MB");
    if (!can_hold(size_of(file), columns, rows, bytes_per_pixel))
        throw InputError(claim + " and is too short for them: it is damaged, export it again");
}

cv::Mat screen_colours(const cv::Mat& linear) {
    cv::Mat screen(linear.size(), CV_8UC(linear.channels()));
    const int values = linear.cols * linear.channels();
    for (int j = 0; j < linear.rows; ++j)
        std::transform(linear.ptr<float>(j), linear.ptr<float>(j) + values,
                       screen.ptr<std::uint8_t>(j), screen_level);
    return screen;
}

}  // namespace dibhr
