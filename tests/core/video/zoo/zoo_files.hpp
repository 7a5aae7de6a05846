// Writes the zoo's files as the programs and devices do that people have them from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace dibhr::test::zoo {

namespace fs = std::filesystem;

using Pictures = std::vector<cv::Mat>;

// Levels of a farness, CV_32FC1.

/// Farness times `per_unit`, rounded to 16 bits; `none` where there is no data.
[[nodiscard]] cv::Mat in_16_bits(const cv::Mat& farness, double per_unit, int none = 0);
/// One over it, so that the nearest has `highest`; 0 where there is no data. CV_32FC1.
[[nodiscard]] cv::Mat disparity_of(const cv::Mat& farness, double highest);
/// From 0, the farthest of all, to 1, the nearest; 0 where there is no data. CV_32FC1.
[[nodiscard]] cv::Mat nearness_of(const cv::Mat& farness);
/// Numbers from 0 to 1 as 8 bits.
[[nodiscard]] cv::Mat in_8_bits(const cv::Mat& parts);
/// The same numbers, `value` where there is no data.
[[nodiscard]] cv::Mat with_no_data_as(const cv::Mat& farness, double value);
/// Every picture of a film by the same function.
template <typename Change>
[[nodiscard]] Pictures each(const Pictures& pictures, const Change& change) {
    Pictures changed;
    for (const cv::Mat& picture : pictures) changed.push_back(change(picture));
    return changed;
}

/// `pattern` with its row of # replaced by the number, padded with zeros to as many digits.
[[nodiscard]] std::string numbered_name(const std::string& pattern, std::int64_t number);

// Files; their folders are made.

void save_text(const fs::path& file, const std::string& text);
/// By OpenCV, in the form that the ending says.
void save(const fs::path& file, const cv::Mat& picture);
/// `shape` of the array: of the picture, [rows, columns], or with axes of 1 around it.
void save_npy(const fs::path& file, const cv::Mat& numbers, const std::string& shape = {});
/// The bytes of a .npy file of pictures of one type, [frames, rows, columns, channels]; without the
/// first axis where there is one picture, without the last where there is one channel.
[[nodiscard]] std::string npy_of(const Pictures& pictures, const std::string& shape = {});
void save_npz(const fs::path& file, const std::map<std::string, std::string>& arrays);
void save_pfm(const fs::path& file, const cv::Mat& numbers);
/// OpenEXR of these channels, 32-bit floats.
void save_exr(const fs::path& file, const std::map<std::string, cv::Mat>& channels);
/// A TIFF of real numbers; a GeoTIFF if it says its `no_data` as GDAL does, else empty.
/// `description`: of what it shows; empty: none.
void save_tiff(const fs::path& file, const cv::Mat& numbers, const std::string& no_data = {},
               const std::string& description = {});
/// A JPEG photo with a depth picture in its extended XMP, as Android's cameras wrote it.
void save_gdepth(const fs::path& file, const cv::Mat& colour, const cv::Mat& depth, double near_m,
                 double far_m);
/// A JPEG photo followed by a second one, listed in its MPF, as phones write portraits.
void save_multi_picture(const fs::path& file, const cv::Mat& colour, const cv::Mat& depth);
/// A HEIC portrait of a colour and a grey picture.
void save_heic(const fs::path& file, const cv::Mat& colour, const cv::Mat& depth);

/// A track of a video: pictures of 8 bits, grey or in colours, or of 16 bits, grey.
struct Track {
    Pictures pictures{};
    double frames_per_s{30.0};
    std::string encoding{};  ///< options of ffmpeg, each with ":v"
};
inline const std::string kGoodH264 = "-c:v libx264 -crf:v 6 -g:v 10 -pix_fmt:v yuv420p";
inline const std::string kGrey16 = "-c:v ffv1 -pix_fmt:v gray16le";
/// By ffmpeg; `options` of the whole file.
void save_video(const fs::path& file, const std::vector<Track>& tracks,
                const std::string& options = {});

// Bags of ROS 2.

/// A message as a bag holds it: little-endian CDR.
struct BagMessage {
    std::string topic{};
    std::string type{};  ///< "Image"
    double time_s{0.0};
    std::string data{};
};
/// `encoding`: "16UC1", "bgr8".
[[nodiscard]] BagMessage image_message(const std::string& topic, double time_s,
                                       const std::string& encoding, const cv::Mat& picture);
/// In the form that the ending says; MCAP as recorded by default, in chunks packed with zstd.
void save_bag(const fs::path& file, const std::vector<BagMessage>& messages);

}  // namespace dibhr::test::zoo
