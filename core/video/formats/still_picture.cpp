// Reads pictures by OpenCV, within bounds.
#include "core/video/formats/still_picture.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/modules/picture_codecs.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

std::string codec_by_name(const fs::path& file) {
    std::string codec = file.extension().string();
    if (!codec.empty()) codec.erase(0, 1);
    std::transform(codec.begin(), codec.end(), codec.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return codec;
}

bool is_tiff(const std::string& head) {
    return head.starts_with("II") || head.starts_with("MM");
}

bool is_png(std::string_view head) {
    return head.starts_with("\x89PNG\r\n\x1a\n");
}

/// Checks the header first, because OpenCV allocates memory for any size that a header claims.
void require_plausible_claim(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const auto claimed = claimed_size(in);
    if (!claimed)
        throw InputError(shown(file) +
                         " is a picture of unknown size: it may be damaged, export it as PNG");
    require_plausible_size(file, claimed->columns, claimed->rows, claimed->pixel_bytes);
}

bool is_plausible_picture(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kHeaderBytes = 1U << 20U;  // metadata come before the size
    const auto begin = bytes.first(std::min(bytes.size(), kHeaderBytes));
    std::istringstream in(std::string(begin.begin(), begin.end()));
    const auto claimed = claimed_size(in);
    return claimed && can_hold(bytes.size(), claimed->columns, claimed->rows, claimed->pixel_bytes);
}

/// P1, P2 and P3 have their levels as text. OpenCV needs a blank after the last one, which writers
/// leave out.
cv::Mat decoded_text_picture(const fs::path& file, int flags) {
    const std::string head = head_of(file);
    const bool is_text = head.size() > 2 && head[0] == 'P' && head[1] >= '1' && head[1] <= '3';
    const std::string text =
        is_text ? beginning_of(file, std::size_t{kMostPictureBytes}) + '\n' : std::string();
    return decoded_picture({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                           flags);
}

cv::Mat decoded(const fs::path& file, PictureRole role) {
    require_plausible_claim(file);
    const int flags = role == PictureRole::depth ? cv::IMREAD_UNCHANGED : cv::IMREAD_COLOR;
    cv::Mat picture;
    if (is_png(head_of(file))) picture = read_plain_png(file, role);
    if (!picture.empty()) return picture;
    try {
        const QuietErrors quiet;
        picture = picture_codecs().read(file.string(), flags);
    } catch (const cv::Exception&) {
        picture.release();  // refused, for example as too large: reported below
    }
    if (picture.empty()) picture = decoded_text_picture(file, flags);
    if (picture.empty())
        throw InputError(shown(file) +
                         " cannot be decoded as a picture: it may be damaged, export it again" +
                         (is_tiff(head_of(file)) ? " (with 8 or 16 bits, or 32-bit reals)" : ""));
    return picture;
}

/// The text between `begin` and the first of the letters `ends`; empty: it is not there.
std::string_view text_behind(std::string_view text, std::string_view begin, std::string_view ends) {
    const auto at = text.find(begin);
    if (at == std::string_view::npos) return {};
    const std::string_view rest = text.substr(at + begin.size());
    return rest.substr(0, rest.find_first_of(ends));
}

/// Whether GDAL says that the levels have a unit of length, as heights have.
bool has_unit_of_heights(const TiffTags& tags) {
    constexpr std::array<std::string_view, 8> kUnits{"m",      "metre", "meter", "metres",
                                                     "meters", "ft",    "foot",  "feet"};
    const std::string unit =
        lower_case(std::string(text_behind(tags.gdal_metadata, "role=\"unittype\">", "<")));
    return std::find(kUnits.begin(), kUnits.end(), unit) != kUnits.end();
}

/// Whether its sides are measured in micrometres or less, as ImageJ and OME state it: whatever the
/// levels are, no metres from a camera.
bool is_of_microscope(const TiffTags& tags) {
    constexpr std::array<std::string_view, 8> kUnits{"micron", "microns",  "um",        "\xc2\xb5m",
                                                     "\xb5m",  "\\u00B5m", "\xce\xbcm", "nm"};
    if (tags.description.find("<OME ") != std::string::npos) return true;
    const std::string_view unit = text_behind(tags.description, "\nunit=", "\r\n");
    return tags.description.starts_with("ImageJ=") &&
           std::find(kUnits.begin(), kUnits.end(), unit) != kUnits.end();
}

/// Adds what the tags of a TIFF file of one channel tell. What is seen from above is near where it
/// is high; but maps, and pictures of microscopes, hold other quantities than heights, too.
void add_tags(const fs::path& file, StillPicture& still) {
    constexpr double kSurenessOfHeights = 0.92;  // of what a microscope measures and is felt
    const DepthStatement heights{.near = NearLevels::bright, .unit = DepthUnit::levels};
    const TiffTags tags = picture_codecs().tiff_tags(file.string());
    const auto add_kind = [&still](std::string_view about, const char* reason) {
        still.findings.push_back(
            {{}, Evidence::metadata, kSurenessOfMetadata, reason, std::string(about)});
    };
    if (tags.is_geographic)
        still.findings.push_back(finding_of_metadata(heights, "GeoTIFF tags: heights"));
    if (tags.is_geographic && !tags.is_vertical && !has_unit_of_heights(tags))
        add_kind(kMap, "it is a map that need not be of heights");
    if (is_of_microscope(tags)) {
        still.findings.push_back(
            {heights, Evidence::metadata, kSurenessOfHeights, "TIFF tags: micrometres"});
        add_kind(kMicrograph, "it may show the light in a microscope");
    }
    const auto mark = number_of_text(tags.gdal_no_data);
    if (!mark || std::abs(*mark) > std::numeric_limits<float>::max()) return;
    const bool is_real = still.bits == kRealBits;
    const double level = is_real ? static_cast<double>(static_cast<float>(*mark)) : *mark;
    still.findings.push_back(
        finding_of_metadata({.no_data = std::vector{level}}, "tag GDAL_NODATA"));
}

}  // namespace

bool is_opencv_picture(const fs::path& file, std::string_view head) {
    const bool is_webp =
        head.size() >= 12 && head.starts_with("RIFF") && head.substr(8, 4) == "WEBP";
    try {
        return is_webp || is_png(head) || head.starts_with("\xff\xd8\xff") ||
               picture_codecs().can_read(file.string());
    } catch (const cv::Exception&) {
        return false;
    }
}

cv::Mat decoded_picture(std::span<const std::uint8_t> bytes, int flags) {
    const bool is_too_large = bytes.size() > std::size_t{std::numeric_limits<int>::max()};
    if (bytes.empty() || is_too_large || !is_plausible_picture(bytes)) return {};
    const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8UC1,
                       const_cast<std::uint8_t*>(bytes.data()));  // only read
    try {
        const QuietErrors quiet;
        return picture_codecs().decode(view, flags);
    } catch (const cv::Exception&) {
        return {};
    }
}

StillPicture read_by_opencv(const fs::path& file, PictureRole role) {
    const bool is_depth = role == PictureRole::depth;
    cv::Mat picture = decoded(file, role);
    if (picture.depth() != CV_8U && picture.depth() != CV_16U) picture.convertTo(picture, CV_32F);
    const int bits = picture.depth() == CV_8U ? 8 : picture.depth() == CV_16U ? 16 : kRealBits;
    StillPicture still{picture, bits, codec_by_name(file)};
    if (is_depth && picture.channels() == 1 && is_tiff(head_of(file))) add_tags(file, still);
    return still;
}

}  // namespace dibhr
