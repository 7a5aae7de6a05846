// Puts photos with depth together from segments, packets and pictures.
#include "tests/core/video/depth_photos.hpp"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "core/files/plain_text.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::test {

namespace {

const std::string kGuid = "0123456789ABCDEF0123456789ABCDEF";

std::string in_big_endian(std::size_t number, std::size_t bytes) {
    std::string text;
    append_bytes(text, static_cast<std::uint32_t>(number), false);
    return text.substr(text.size() - bytes);
}

/// A TIFF structure in big-endian order, whose directory has these entries.
std::string tiff_structure(const std::vector<std::string>& entries) {
    std::string tiff =
        std::string("MM\0*", 4) + in_big_endian(8, 4) + in_big_endian(entries.size(), 2);
    for (const std::string& entry : entries) tiff += entry;
    return tiff + in_big_endian(0, 4);
}

std::string tiff_entry(std::size_t tag, std::size_t type, std::size_t count,
                       const std::string& value) {
    return in_big_endian(tag, 2) + in_big_endian(type, 2) + in_big_endian(count, 4) + value;
}

}  // namespace

std::string encoded_as(const cv::Mat& picture, const std::string& ending) {
    std::vector<unsigned char> bytes;
    REQUIRE(cv::imencode(ending, picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 100}));
    return {bytes.begin(), bytes.end()};
}

std::string with_segments(const std::string& jpeg, const std::vector<std::string>& segments) {
    std::string all;
    for (const std::string& segment : segments) all += segment;
    return jpeg.substr(0, 2) + all + jpeg.substr(2);
}

std::string app_segment(int n, const std::string& payload) {
    return std::string("\xff") + static_cast<char>(0xe0 + n) +
           in_big_endian(payload.size() + 2, 2) + payload;
}

std::string xmp_segment(const std::string& packet) {
    return app_segment(1, std::string("http://ns.adobe.com/xap/1.0/") + '\0' + packet);
}

std::vector<std::string> extended_xmp_segments(const std::string& packet, std::size_t count) {
    const std::size_t bytes = (packet.size() + count - 1) / count;
    std::vector<std::string> segments;
    for (std::size_t at = 0; at < packet.size(); at += bytes)
        segments.push_back(app_segment(1, std::string("http://ns.adobe.com/xmp/extension/") + '\0' +
                                              kGuid + in_big_endian(packet.size(), 4) +
                                              in_big_endian(at, 4) + packet.substr(at, bytes)));
    std::reverse(segments.begin(), segments.end());
    return segments;
}

std::string orientation_segment(int orientation) {
    const auto number = static_cast<std::size_t>(orientation);
    return app_segment(1, std::string("Exif\0\0", 6) +
                              tiff_structure({tiff_entry(
                                  0x0112, 3, 1, in_big_endian(number, 2) + std::string(2, '\0'))}));
}

std::string xmp_packet(const std::string& attributes, const std::string& elements) {
    return "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
           "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description "
           "rdf:about=\"\" xmlns:xmpNote=\"http://ns.adobe.com/xmp/note/\" "
           "xmlns:GDepth=\"http://ns.google.com/photos/1.0/depthmap/\" "
           "xmlns:GImage=\"http://ns.google.com/photos/1.0/image/\" "
           "xmlns:Container=\"http://ns.google.com/photos/dd/1.0/container/\" "
           "xmlns:Item=\"http://ns.google.com/photos/dd/1.0/item/\" "
           "xmlns:DepthMap=\"http://ns.google.com/photos/dd/1.0/depthmap/\" "
           "xmlns:apdi=\"http://ns.apple.com/pixeldatainfo/1.0/\" "
           "xmlns:depthData=\"http://ns.apple.com/depthData/1.0/\" " +
           attributes + ">" + elements + "</rdf:Description></rdf:RDF></x:xmpmeta>";
}

std::string names_extended_xmp() {
    return "xmpNote:HasExtendedXMP=\"" + kGuid + "\" ";
}

std::string gdepth_photo(const std::string& jpeg, const std::string& said, const std::string& depth,
                         const std::string& original, std::size_t extended_segments) {
    std::string data = "GDepth:Data=\"" + base64_text(depth) + "\" ";
    if (!original.empty()) data += "GImage:Data=\"" + base64_text(original) + "\" ";
    if (extended_segments == 0) return with_segments(jpeg, {xmp_segment(xmp_packet(said + data))});
    std::vector<std::string> segments = extended_xmp_segments(xmp_packet(data), extended_segments);
    segments.insert(segments.begin(), xmp_segment(xmp_packet(names_extended_xmp() + said)));
    return with_segments(jpeg, segments);
}

std::string multi_picture(const std::string& jpeg, const std::vector<std::string>& further,
                          unsigned type) {
    constexpr std::size_t kListAt = 8 + 2 + 2 * 12 + 4;  // behind the directory of two entries
    constexpr std::size_t kOriginAt = 2 + 4 + 4;         // of offsets, in the file
    const std::size_t pictures = further.size() + 1;
    const std::string directory =
        tiff_structure({tiff_entry(0xb001, 4, 1, in_big_endian(pictures, 4)),
                        tiff_entry(0xb002, 7, 16 * pictures, in_big_endian(kListAt, 4))});
    const std::size_t first_bytes = jpeg.size() + 4 + 4 + directory.size() + 16 * pictures;
    std::string list = in_big_endian(0x030000, 4) + in_big_endian(first_bytes, 4) +
                       in_big_endian(0, 4) + in_big_endian(0, 4);
    std::size_t at = first_bytes - kOriginAt;
    std::string behind;
    for (const std::string& picture : further) {
        list += in_big_endian(type, 4) + in_big_endian(picture.size(), 4) + in_big_endian(at, 4) +
                in_big_endian(0, 4);
        at += picture.size();
        behind += picture;
    }
    return with_segments(jpeg, {app_segment(2, std::string("MPF\0", 4) + directory + list)}) +
           behind;
}

std::string dynamic_depth_photo(const std::string& jpeg, const std::string& elements,
                                const std::vector<PhotoItem>& items, std::size_t padding) {
    std::string listed =
        "<rdf:li rdf:parseType=\"Resource\"><Container:Item Item:Mime=\"image/jpeg\" "
        "Item:Semantic=\"Primary\" Item:Length=\"0\" Item:Padding=\"" +
        std::to_string(padding) + "\"/></rdf:li>";
    std::string behind(padding, '\0');
    for (const PhotoItem& item : items) {
        listed += "<rdf:li rdf:parseType=\"Resource\"><Container:Item " + item.said +
                  " Item:Length=\"" + std::to_string(item.bytes.size()) + "\"/></rdf:li>";
        behind += item.bytes;
    }
    const std::string directory =
        "<Container:Directory><rdf:Seq>" + listed + "</rdf:Seq></Container:Directory>";
    return with_segments(jpeg, {xmp_segment(xmp_packet("", directory + elements))}) + behind;
}

}  // namespace dibhr::test
