// Reads JPEG photos with a depth map inside: where it is in the file, and what its levels are.
#include "core/video/formats/still_picture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/jpeg_parts.hpp"
#include "core/video/formats/xmp.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

using Properties = std::vector<XmpProperty>;

/// The namespaces of one vocabulary in its versions, by how they begin and end.
struct Vocabulary {
    std::string_view begin;
    std::string_view end;
};

constexpr std::string_view kGoogle = "http://ns.google.com/photos/";
constexpr Vocabulary kDepthMap{kGoogle, "/depthmap/"};  // of GDepth and of Dynamic Depth
constexpr Vocabulary kOriginalImage{kGoogle, "/image/"};
constexpr Vocabulary kItem{kGoogle, "/item/"};
constexpr Vocabulary kPixelData{"http://ns.apple.com/pixeldatainfo/", ""};
constexpr Vocabulary kDepthData{"http://ns.apple.com/depthData/", ""};

/// What the levels of a depth map code, evenly from the level 0 to the highest.
struct LevelCoding {
    NearLevels near{NearLevels::bright};
    bool inverse{true};               ///< evenly in one over the distance
    double first{0.0};                ///< distance, or one over it, of level 0
    double last{0.0};                 ///< of the highest level; equal to the first: not stated
    std::optional<DepthUnit> unit{};  ///< of the distances; nothing: not known
};

/// What is read of a photo with depth. The pictures are files of their own, PNG or JPEG.
struct DepthPhoto {
    std::string form{};  ///< "GDepth"
    std::string depth{};
    std::string colour{};  ///< the original of an edited photo; empty: none
    LevelCoding coding{};
    int orientation{1};  ///< of the photo, by EXIF
    JpegFrame frame{};   ///< of the photo, before it is turned
};

bool is_of(const XmpProperty& property, const Vocabulary& words) {
    return property.space.starts_with(words.begin) && property.space.ends_with(words.end);
}

/// The value of the first property of that name; empty when there is none.
std::string_view value_in(const Properties& properties, const Vocabulary& words,
                          std::string_view name) {
    const auto found =
        std::find_if(properties.begin(), properties.end(), [&](const XmpProperty& property) {
            return property.name == name && is_of(property, words);
        });
    return found == properties.end() ? std::string_view() : found->value;
}

std::string small_letters(std::string_view text) {
    return lower_case(std::string(text));
}

/// The properties of both packets, in that order.
Properties all_properties(const XmpPackets& packets) {
    Properties all = xmp_properties(packets.standard);
    Properties extended = xmp_properties(packets.extended);
    std::move(extended.begin(), extended.end(), std::back_inserter(all));
    return all;
}

/// GDepth's unit is metres where it is not stated, Dynamic Depth may state "None".
std::optional<DepthUnit> google_unit(std::string_view name) {
    const std::string unit = small_letters(name);
    if (unit.empty() || unit == "m" || unit == "meters" || unit == "metres") return DepthUnit::m;
    if (unit == "mm" || unit == "millimeters" || unit == "millimetres") return DepthUnit::mm;
    return std::nullopt;
}

/// Google's formats: level 0 is at Near, the highest at Far. RangeInverse is even in one over the
/// distance: d = far near / (far - n (far - near)) is 1/d = 1/near + n (1/far - 1/near).
LevelCoding google_coding(const Properties& properties) {
    LevelCoding coding{.near = NearLevels::dark};
    coding.inverse = value_in(properties, kDepthMap, "Format") != "RangeLinear";
    const auto near = number_of_text(value_in(properties, kDepthMap, "Near"));
    const auto far = number_of_text(value_in(properties, kDepthMap, "Far"));
    if (!near || !far || *near == *far) return coding;
    const double least = std::min(*near, *far);
    if (least < 0.0 || (coding.inverse && least == 0.0)) return coding;
    coding.first = coding.inverse ? 1.0 / *near : *near;
    coding.last = coding.inverse ? 1.0 / *far : *far;
    coding.unit = google_unit(value_in(properties, kDepthMap, "Units"));
    return coding;
}

/// Apple's pixel data: disparities [1/m] or distances [m] from FloatMinValue to FloatMaxValue,
/// which are true only where Accuracy is absolute. Disparities below 0 are of an unknown offset:
/// then levels.
LevelCoding apple_coding(const Properties& properties) {
    LevelCoding coding;
    const std::string kind = small_letters(value_in(properties, kPixelData, "AuxiliaryImageType"));
    coding.inverse = !kind.ends_with("depth");
    coding.near = coding.inverse ? NearLevels::bright : NearLevels::dark;
    const auto first = number_of_text(value_in(properties, kPixelData, "FloatMinValue"));
    const auto last = number_of_text(value_in(properties, kPixelData, "FloatMaxValue"));
    if (!first || !last || *first == *last) return coding;
    if (std::min(*first, *last) < 0.0) {
        coding.inverse = false;
        return coding;
    }
    coding.first = *first;
    coding.last = *last;
    if (value_in(properties, kDepthData, "Accuracy") == "absolute") coding.unit = DepthUnit::m;
    return coding;
}

/// A file behind the photo, as a directory in the metadata lists it.
struct ContainerItem {
    int entry{0};
    std::string_view semantic{};
    std::string_view address{};
    std::uint64_t bytes{0};
    std::uint64_t padding{0};  ///< bytes behind it
};

/// 0 for another text.
std::uint64_t count_in(std::string_view text) {
    constexpr double kMost = 1e12;
    const double count = number_of_text(text).value_or(0.0);
    return count > 0.0 && count < kMost ? static_cast<std::uint64_t>(count) : 0;
}

std::vector<ContainerItem> container_items(const Properties& properties) {
    std::vector<ContainerItem> items;
    for (const XmpProperty& property : properties) {
        if (!is_of(property, kItem)) continue;
        if (items.empty() || items.back().entry != property.entry)
            items.push_back({.entry = property.entry});
        ContainerItem& item = items.back();
        if (property.name == "Semantic") item.semantic = property.value;
        if (property.name == "DataURI") item.address = property.value;
        if (property.name == "Length") item.bytes = count_in(property.value);
        if (property.name == "Padding") item.padding = count_in(property.value);
    }
    return items;
}

bool is_picture_file(std::string_view bytes) {
    return bytes.starts_with("\xff\xd8\xff") || bytes.starts_with("\x89PNG");
}

/// The pictures behind the photo, one after the other in the order of the directory, whose first
/// item is the photo itself. False without depth among them.
bool take_container(const fs::path& file, const Properties& directory,
                    std::string_view depth_address, DepthPhoto& photo) {
    const auto is_depth = [&](const ContainerItem& item) {
        return item.semantic == "Depth" || item.address == "android/depthmap" ||
               (!depth_address.empty() && item.address == depth_address);
    };
    const std::vector<ContainerItem> items = container_items(directory);
    if (std::none_of(items.begin(), items.end(), is_depth)) return false;
    const std::string whole = beginning_of(file, static_cast<std::size_t>(kMostPictureBytes));
    const auto end = jpeg_end(whole);
    if (!end) return false;
    std::uint64_t at = *end + items.front().padding;
    for (auto item = items.begin() + 1; item != items.end() && at <= whole.size(); ++item) {
        const std::string_view bytes = std::string_view(whole).substr(at, item->bytes);
        if (bytes.size() < item->bytes) break;
        if (is_depth(*item) && is_picture_file(bytes)) photo.depth = bytes;
        if (item->semantic == "Original" || item->address == "android/original_image")
            photo.colour = bytes;
        at += item->bytes + item->padding;
    }
    return !photo.depth.empty();
}

/// Whether a further picture is what Apple writes as depth: neither a gain map nor a matte.
bool is_apple_depth(const Properties& properties) {
    const std::string kind = small_letters(value_in(properties, kPixelData, "AuxiliaryImageType"));
    return (kind.ends_with("disparity") || kind.ends_with("depth")) &&
           value_in(properties, kPixelData, "AuxiliaryImageSubType").empty();
}

/// Whether a picture is a gain map, or has one: by its metadata or a segment of ISO 21496.
bool names_gain_map(const JpegSegments& segments, const std::string& metadata) {
    constexpr std::string_view kIsoGainMap = "urn:iso:std:iso:ts:21496";
    const std::string small = small_letters(metadata);
    return small.find("gainmap") != std::string::npos || small.find("hdrgm") != std::string::npos ||
           std::any_of(segments.begin(), segments.end(), [&](const JpegSegment& segment) {
               return segment.payload.starts_with(kIsoGainMap);
           });
}

/// Whether a further picture without metadata is likely depth: grey, of no stated type, beside a
/// photo in colour without a gain map, which is grey as well.
bool is_lone_grey(const FurtherPicture& picture, const JpegSegments& segments,
                  const std::string& metadata, const DepthPhoto& photo,
                  const std::string& metadata_of_photo) {
    return picture.type == 0 && metadata.empty() && jpeg_frame(segments).channels == 1 &&
           photo.frame.channels > 1 && !names_gain_map({}, metadata_of_photo) &&
           !names_gain_map(segments, {});
}

/// The first further picture that is depth; `metadata`: the photo's own. False without one.
bool take_further_picture(std::istream& in, std::uint64_t file_bytes,
                          const JpegSegments& photo_segments, const std::string& metadata,
                          DepthPhoto& photo) {
    for (const FurtherPicture& further : further_pictures(photo_segments)) {
        if (further.at > file_bytes || further.bytes > file_bytes - further.at) continue;
        const JpegSegments segments = jpeg_segments(in, further.at);
        const std::string packet = xmp_packets(segments).standard;
        const Properties properties = xmp_properties(packet);
        const bool is_apple = is_apple_depth(properties);
        if (!is_apple && !is_lone_grey(further, segments, packet, photo, metadata)) continue;
        photo.coding = apple_coding(properties);
        photo.form = is_apple ? "Apple's second picture" : "second picture, grey";
        photo.depth.resize(further.bytes);
        in.clear();
        in.seekg(static_cast<std::streamoff>(further.at));
        in.read(photo.depth.data(), static_cast<std::streamsize>(photo.depth.size()));
        return true;
    }
    return false;
}

/// The depth map of a photo, and what belongs to it; nothing when there is none.
std::optional<DepthPhoto> depth_photo(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const JpegSegments segments = jpeg_segments(in);
    const XmpPackets packets = xmp_packets(segments);
    const Properties properties = all_properties(packets);
    DepthPhoto photo;
    photo.frame = jpeg_frame(segments);
    photo.orientation = exif_orientation(segments).value_or(1);
    photo.coding = google_coding(properties);
    photo.form = "GDepth";
    photo.depth = bytes_of_base64(std::string(value_in(properties, kDepthMap, "Data")));
    photo.colour = bytes_of_base64(std::string(value_in(properties, kOriginalImage, "Data")));
    if (!photo.depth.empty()) return photo;
    photo.form = "Dynamic Depth";
    const std::string_view address = value_in(properties, kDepthMap, "DepthURI");
    for (const std::string& packet : {packets.standard, packets.extended}) {
        if (take_container(file, xmp_properties(packet), address, photo)) return photo;
    }
    if (take_further_picture(in, size_of(file), segments, packets.standard, photo)) return photo;
    return std::nullopt;
}

/// Turned as EXIF says, 1 to 8.
cv::Mat turned_by_exif(const cv::Mat& picture, int orientation) {
    constexpr int kFirstTransposed = 5;
    constexpr int kNotFlipped = 2;
    constexpr std::array kFlips{kNotFlipped, 1, -1, 0, kNotFlipped, 1, -1, 0};  // OpenCV's codes
    cv::Mat upright = picture;
    if (orientation >= kFirstTransposed) cv::transpose(picture, upright);
    const int flip = kFlips.at(static_cast<std::size_t>(orientation - 1));
    if (flip != kNotFlipped) cv::flip(upright, upright, flip);
    return upright;
}

/// A picture of the photo, turned as it states itself, else as the photo; not turned where only
/// its own sides lie as the turned photo's. Empty when it is damaged.
cv::Mat upright_picture(const std::string& bytes, const DepthPhoto& photo, int flags) {
    const cv::Mat picture =
        decoded_picture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, flags);
    if (picture.empty()) return picture;
    std::istringstream in(bytes);
    if (const auto own = exif_orientation(jpeg_segments(in))) return turned_by_exif(picture, *own);
    const bool stands = picture.rows > picture.cols;
    const bool photo_stands = photo.frame.rows > photo.frame.columns;
    const bool is_upright = picture.rows != picture.cols && stands != photo_stands;
    return is_upright ? picture : turned_by_exif(picture, photo.orientation);
}

/// The depth of a photo in its own coding: as distances where a unit is known, else as disparities,
/// or as the levels that they are.
StillPicture in_coding(const cv::Mat& levels, const DepthPhoto& photo) {
    const LevelCoding& coding = photo.coding;
    const int bits = levels.depth() == CV_16U ? 16 : 8;
    StillPicture still{levels,
                       bits,
                       "JPEG",
                       {finding_of_metadata({}, "depth map in the photo (" + photo.form + ")")}};
    DepthStatement& statement = still.findings.front().statement;
    if (coding.first == coding.last) {
        statement.unit = coding.inverse ? DepthUnit::disparity : DepthUnit::levels;
        statement.near = coding.inverse ? NearLevels::bright : coding.near;
        if (coding.inverse && coding.near == NearLevels::dark)
            cv::bitwise_not(levels, still.picture);
        if (coding.near == NearLevels::dark) statement.no_data.emplace();  // 0 is Near
        return still;
    }
    cv::Mat values;
    levels.convertTo(values, CV_32F, (coding.last - coding.first) / highest_level(bits),
                     coding.first);
    if (coding.inverse == coding.unit.has_value()) {
        const cv::Mat infinite = ~(values > 0.0);
        cv::divide(1.0, values, values);
        values.setTo(std::numeric_limits<float>::quiet_NaN(), infinite);
    }
    still.picture = values;
    still.bits = kRealBits;
    statement.unit = coding.unit.value_or(DepthUnit::disparity);
    return still;
}

}  // namespace

StillPicture read_jpeg_photo(const fs::path& file, PictureRole role) {
    const auto photo = depth_photo(file);
    if (role == PictureRole::colour) {
        if (!photo || photo->colour.empty()) return read_by_opencv(file, role);
        const cv::Mat original = upright_picture(photo->colour, *photo,
                                                 cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
        if (original.empty()) return read_by_opencv(file, role);
        return {original, 8, "JPEG"};
    }
    cv::Mat levels;
    if (photo) levels = upright_picture(photo->depth, *photo, cv::IMREAD_UNCHANGED);
    if (!levels.empty()) levels = grey_of(levels);
    if (levels.depth() != CV_8U && levels.depth() != CV_16U) levels.release();
    if (levels.empty())
        throw InputError(shown(file) +
                         " is a photo whose depth map is damaged: copy the photo again from where "
                         "it was taken, or give a depth file as the second file");
    return in_coding(levels, *photo);
}

bool jpeg_has_gain_map(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const JpegSegments segments = jpeg_segments(in);
    if (names_gain_map(segments, xmp_packets(segments).standard)) return true;
    const std::vector<FurtherPicture> further = further_pictures(segments);
    return std::any_of(further.begin(), further.end(), [&in](const FurtherPicture& picture) {
        const JpegSegments own = jpeg_segments(in, picture.at);
        return names_gain_map(own, xmp_packets(own).standard);
    });
}

bool jpeg_has_depth(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const JpegSegments segments = jpeg_segments(in);
    const XmpPackets packets = xmp_packets(segments);
    const auto either_holds = [&packets](const char* part) {
        return packets.standard.find(part) != std::string::npos ||
               packets.extended.find(part) != std::string::npos;
    };
    if (either_holds("GDepth:Data")) return true;  // damaged or not, which reading it says
    if (!either_holds("Depth") && !either_holds("depthmap") && further_pictures(segments).empty())
        return false;
    return depth_photo(file).has_value();
}

}  // namespace dibhr
