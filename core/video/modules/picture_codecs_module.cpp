// The module of OpenCV's picture codecs, and of libtiff, which they bring.
#include <tiffio.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/video/modules/picture_codecs.hpp"

namespace {

constexpr std::uint32_t kPixelScale = 33550;
constexpr std::uint32_t kGeoKeys = 34735;
constexpr std::uint32_t kGdalMetadata = 42112;
constexpr std::uint32_t kGdalNoData = 42113;

/// The values of a tag of that type. How libtiff returns them depends on whether another library,
/// such as GDAL, has given the tag a name.
template <typename Value>
std::vector<Value> values_of(TIFF* file, std::uint32_t tag, TIFFDataType type) {
    const TIFFField* const field = TIFFFindField(file, tag, TIFF_ANY);
    if (field == nullptr || TIFFFieldDataType(field) != type || TIFFFieldPassCount(field) == 0)
        return {};
    const Value* values = nullptr;
    std::uint16_t short_count = 0;
    std::uint32_t count = 0;
    const bool is_long = TIFFFieldReadCount(field) == TIFF_VARIABLE2;
    const int found = is_long ? TIFFGetField(file, tag, &count, &values)
                              : TIFFGetField(file, tag, &short_count, &values);
    if (found != 1 || values == nullptr) return {};
    return {values, values + (is_long ? count : short_count)};
}

std::string text_of(TIFF* file, std::uint32_t tag) {
    const TIFFField* const field = TIFFFindField(file, tag, TIFF_ASCII);
    if (field != nullptr && TIFFFieldPassCount(field) == 0) {
        const char* text = nullptr;
        return TIFFGetField(file, tag, &text) == 1 && text != nullptr ? text : "";
    }
    const std::vector<char> bytes = values_of<char>(file, tag, TIFF_ASCII);
    return {bytes.begin(), std::find(bytes.begin(), bytes.end(), '\0')};
}

/// Whether one of the keys of a GeoTIFF is of heights: its system, its datum, its unit. Four
/// numbers of the directory, then four a key, of which the first is its name.
bool has_vertical_key(TIFF* file) {
    constexpr std::size_t kOfKey = 4;
    constexpr int kFirst = 4096;
    constexpr int kLast = 4099;
    const auto keys = values_of<std::uint16_t>(file, kGeoKeys, TIFF_SHORT);
    for (std::size_t at = kOfKey; at + kOfKey <= keys.size(); at += kOfKey)
        if (keys[at] >= kFirst && keys[at] <= kLast) return true;
    return false;
}

dibhr::TiffTags tiff_tags(const std::string& name) {
    TIFFSetWarningHandler(nullptr);  // it warns of each tag without a name
    TIFFSetErrorHandler(nullptr);
    const std::unique_ptr<TIFF, void (*)(TIFF*)> file(TIFFOpen(name.c_str(), "r"), TIFFClose);
    if (!file) return {};
    dibhr::TiffTags tags{.gdal_no_data = text_of(file.get(), kGdalNoData),
                         .is_vertical = has_vertical_key(file.get()),
                         .gdal_metadata = text_of(file.get(), kGdalMetadata),
                         .description = text_of(file.get(), TIFFTAG_IMAGEDESCRIPTION)};
    for (int k = 0; k < TIFFGetTagListCount(file.get()); ++k) {
        const std::uint32_t tag = TIFFGetTagListEntry(file.get(), k);
        tags.is_geographic = tags.is_geographic || tag == kPixelScale || tag == kGeoKeys;
    }
    return tags;
}

}  // namespace

extern "C" {
extern const dibhr::PictureCodecs dibhr_picture_codecs;
const dibhr::PictureCodecs dibhr_picture_codecs{
    .can_read = [](const std::string& file) { return cv::haveImageReader(file); },
    .read = [](const std::string& file, int flags) { return cv::imread(file, flags); },
    .decode = [](const cv::Mat& bytes, int flags) { return cv::imdecode(bytes, flags); },
    .encode =
        [](const std::string& extension, const cv::Mat& picture, std::vector<unsigned char>& bytes,
           const std::vector<int>& options) {
            return cv::imencode(extension, picture, bytes, options);
        },
    .write = [](const std::string& file, const cv::Mat& picture,
                const std::vector<int>& options) { return cv::imwrite(file, picture, options); },
    .tiff_tags = tiff_tags};
}
