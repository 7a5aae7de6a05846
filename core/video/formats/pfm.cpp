// Reads portable float maps: a header of four words, then rows from the lowest up.
#include "core/video/formats/still_picture.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

constexpr double kSurenessOfDisparity = 0.8;  // renderers write distances, too

struct PfmHeader {
    int channels{1};
    int columns{0};
    int rows{0};
    double scale{0.0};
};

[[noreturn]] void refuse(const std::filesystem::path& file) {
    throw InputError(shown(file) +
                     " cannot be decoded as a picture: it may be damaged, export it again");
}

std::string word(std::istream& in) {
    std::string text;
    in >> std::setw(32) >> text;
    return text;
}

int whole_number(const std::string& text) {
    int number = 0;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
    return end.ptr == text.data() + text.size() && end.ec == std::errc() ? number : 0;
}

PfmHeader read_header(std::istream& in) {
    PfmHeader header;
    header.channels = word(in) == "PF" ? 3 : 1;
    header.columns = whole_number(word(in));
    header.rows = whole_number(word(in));
    const std::string scale = word(in);
    header.scale = number_of_text(scale.substr(scale.starts_with("+") ? 1 : 0)).value_or(0.0);
    in.get();  // the one white space before the data
    return header;
}

}  // namespace

StillPicture read_pfm(const std::filesystem::path& file, PictureRole role) {
    std::ifstream in(file, std::ios::binary);
    const PfmHeader header = read_header(in);
    if (!in || header.columns < 1 || header.rows < 1 || !std::isfinite(header.scale) ||
        header.scale == 0.0)
        refuse(file);
    if (role == PictureRole::colour && header.channels == 1)
        throw InputError(shown(file) + " holds depth and no colours: give it as the depth file");
    const int pixel_bytes = 4 * header.channels;
    require_plausible_size(file, header.columns, header.rows, pixel_bytes);
    const auto row_bytes =
        static_cast<std::size_t>(header.columns) * static_cast<std::size_t>(pixel_bytes);
    const auto begin = static_cast<std::uint64_t>(in.tellg());
    if (size_of(file) - begin < row_bytes * static_cast<std::size_t>(header.rows))
        throw InputError(shown(file) + " is cut off: copy it or export it again");
    cv::Mat values(header.rows, header.columns, CV_32FC(header.channels));
    for (int j = header.rows - 1; j >= 0; --j)
        in.read(values.ptr<char>(j), static_cast<std::streamsize>(row_bytes));
    if (!in) refuse(file);
    const bool little = header.scale < 0.0;
    if (little != (std::endian::native == std::endian::little))
        swap_bytes({values.ptr<std::uint8_t>(), row_bytes * static_cast<std::size_t>(header.rows)},
                   4);
    if (header.channels == 3) cv::cvtColor(values, values, cv::COLOR_RGB2BGR);
    if (role == PictureRole::colour) return {screen_colours(values), 8, "PFM"};
    return {values,
            kRealBits,
            "PFM",
            {{{.unit = DepthUnit::disparity},
              Evidence::magic,
              kSurenessOfDisparity,
              "portable float maps mostly hold disparities"}}};
}

}  // namespace dibhr
