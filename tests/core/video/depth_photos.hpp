// JPEG photos with a depth map inside, put together byte by byte as phones write them.
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace dibhr::test {

/// A picture as a file's bytes; `ending`: ".jpg" or ".png".
[[nodiscard]] std::string encoded_as(const cv::Mat& picture, const std::string& ending);

/// A JPEG file with these segments behind its first two bytes.
[[nodiscard]] std::string with_segments(const std::string& jpeg,
                                        const std::vector<std::string>& segments);

/// The segment APPn.
[[nodiscard]] std::string app_segment(int n, const std::string& payload);
[[nodiscard]] std::string xmp_segment(const std::string& packet);
/// The extended packet in so many segments, the last one first.
[[nodiscard]] std::vector<std::string> extended_xmp_segments(const std::string& packet,
                                                             std::size_t count);
[[nodiscard]] std::string orientation_segment(int orientation);

/// A packet with one rdf:Description of these attributes and elements, with all namespaces of the
/// phones' depth maps.
[[nodiscard]] std::string xmp_packet(const std::string& attributes,
                                     const std::string& elements = "");
/// The attribute by which a packet names its extended one.
[[nodiscard]] std::string names_extended_xmp();

/// A photo with GDepth: `said` are its attributes; depth and the original (which may be empty) are
/// the bytes of files, in one packet, or in an extended one of so many segments.
[[nodiscard]] std::string gdepth_photo(const std::string& jpeg, const std::string& said,
                                       const std::string& depth, const std::string& original = "",
                                       std::size_t extended_segments = 0);

/// A photo, and further pictures behind it that the Multi-Picture Format lists.
[[nodiscard]] std::string multi_picture(const std::string& jpeg,
                                        const std::vector<std::string>& further, unsigned type = 0);

/// A photo, and the items of a directory behind it.
struct PhotoItem {
    std::string said{};  ///< attributes: Item:Semantic="Depth"
    std::string bytes{};
};
[[nodiscard]] std::string dynamic_depth_photo(const std::string& jpeg, const std::string& elements,
                                              const std::vector<PhotoItem>& items,
                                              std::size_t padding = 0);

}  // namespace dibhr::test
