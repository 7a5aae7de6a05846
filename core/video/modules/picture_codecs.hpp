// Reads and writes pictures in files and memory, by OpenCV's codecs, and tags of TIFF files.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace dibhr {

/// Tags of the first page of a TIFF file.
struct TiffTags {
    std::string gdal_no_data{};   ///< GDAL_NODATA as written: "-9999"; empty: none
    bool is_geographic{false};    ///< GeoTIFF: it has a place on the earth
    bool is_vertical{false};      ///< GeoTIFF: it names a datum or a unit of heights
    std::string gdal_metadata{};  ///< GDAL_METADATA, XML
    std::string description{};    ///< ImageDescription
};

/// Functions of OpenCV's imgcodecs, with its arguments, results and errors.
struct PictureCodecs {
    bool (*can_read)(const std::string& file);
    cv::Mat (*read)(const std::string& file, int flags);
    cv::Mat (*decode)(const cv::Mat& bytes, int flags);
    bool (*encode)(const std::string& extension, const cv::Mat& picture,
                   std::vector<unsigned char>& bytes, const std::vector<int>& options);
    bool (*write)(const std::string& file, const cv::Mat& picture, const std::vector<int>& options);
    TiffTags (*tiff_tags)(const std::string& file);  ///< by libtiff; no tags where it cannot read
};

/// Loads the codecs at the first call. Throws InputError if their module is missing.
[[nodiscard]] const PictureCodecs& picture_codecs();

/// 1, 3 or 4 channels (in OpenCV's order) of 8 or 16 bits, as a PNG file's bytes.
[[nodiscard]] std::string encoded_png(const cv::Mat& picture);

}  // namespace dibhr
