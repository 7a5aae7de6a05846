// Gives each file to the reader of its form; what is left is OpenCV's.
#include "core/video/formats/still_picture.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/formats/array_file.hpp"
#include "core/video/formats/claimed_size.hpp"
#include "core/video/formats/exr.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/heif.hpp"
#include "core/video/formats/pfm.hpp"
#include "core/video/libraries.hpp"
#include "core/video/media.hpp"
#include "core/video/modules/picture_codecs.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

using Reader = StillPicture (*)(const fs::path&, PictureRole);

/// As most videos begin (MP4 and QuickTime, Matroska, AVI, NUT): they need no picture codecs to be
/// loaded. Other videos are found by what the codecs say.
bool is_video_container(std::string_view head) {
    constexpr std::array<std::string_view, 9> kBrands{"isom", "iso2", "iso4", "iso5", "iso6",
                                                      "mp41", "mp42", "M4V ", "qt  "};
    if (head.size() < 12) return false;
    if (head.substr(4, 4) == "ftyp")
        return std::find(kBrands.begin(), kBrands.end(), head.substr(8, 4)) != kBrands.end();
    return head.starts_with("\x1a\x45\xdf\xa3") || head.starts_with("nut/multimedia") ||
           (head.starts_with("RIFF") && head.substr(8, 4) == "AVI ");
}

bool opencv_reads(const fs::path& file) {
    if (is_video_container(head_of(file))) return false;
    try {
        return picture_codecs().knows(file.string());
    } catch (const cv::Exception&) {
        return false;
    }
}

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

/// OpenCV takes memory for whatever a header says.
void require_plausible_claim(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const auto claimed = claimed_size(in);
    if (!claimed)
        throw InputError(shown(file) +
                         " is a picture of unknown size: it may be damaged, export it as PNG");
    require_plausible_size(file, claimed->columns, claimed->rows, claimed->pixel_bytes);
}

/// Also a damaged one, which OpenCV does not know any more: libav takes it for a video, and ends
/// the program.
bool is_webp(std::string_view head) {
    return head.starts_with("RIFF") &&
           head.substr(std::min<std::size_t>(8, head.size())).starts_with("WEBP");
}

cv::Mat decoded(const fs::path& file, int flags) {
    require_plausible_claim(file);
    cv::Mat picture;
    try {
        const QuietErrors quiet;
        picture = picture_codecs().read(file.string(), flags);
    } catch (const cv::Exception&) {
        picture.release();  // refused, for example as too large: said below
    }
    if (picture.empty())
        throw InputError(shown(file) +
                         " cannot be decoded as a picture: it may be damaged, export it again" +
                         (is_tiff(head_of(file)) ? " (with 8 or 16 bits, or 32-bit reals)" : ""));
    return picture;
}

/// What OpenCV reads right: among it levels with a sign and real ones (TIFF), which become real.
StillPicture read_by_opencv(const fs::path& file, PictureRole role) {
    const bool is_depth = role == PictureRole::depth;
    cv::Mat picture = decoded(file, is_depth ? cv::IMREAD_UNCHANGED : cv::IMREAD_COLOR);
    if (picture.depth() != CV_8U && picture.depth() != CV_16U) picture.convertTo(picture, CV_32F);
    const int bits = picture.depth() == CV_8U ? 8 : picture.depth() == CV_16U ? 16 : kRealBits;
    return {picture, bits, codec_by_name(file), {}, {}};
}

/// By content; null when none of ours takes it.
Reader own_reader_of(const fs::path& file) {
    const std::string head = head_of(file);
    if (is_exr(head)) return read_exr;
    if (is_pfm(head)) return read_pfm;
    if (is_heif(head)) return read_heif;
    if (is_array_file(file)) return read_array;
    return nullptr;
}

}  // namespace

bool is_still(const fs::path& file) {
    return own_reader_of(file) != nullptr || opencv_reads(file) || is_webp(head_of(file));
}

bool holds_colour_and_depth(const fs::path& file) {
    const std::string head = head_of(file);
    if (is_exr(head)) return exr_has_colour_and_depth(file);
    if (is_heif(head)) return heif_has_depth(file);
    return arrays_have_colour_and_depth(file);
}

StillPicture read_still(const fs::path& file, PictureRole role) {
    set_up_libraries();
    require_readable(file);
    const Reader own = own_reader_of(file);
    return own != nullptr ? own(file, role) : read_by_opencv(file, role);
}

}  // namespace dibhr
