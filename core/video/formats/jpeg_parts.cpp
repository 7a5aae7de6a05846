// Walks the segments of JPEG files, and the TIFF structures in some of them.
#include "core/video/formats/jpeg_parts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace dibhr {

namespace {

using namespace std::string_view_literals;

constexpr int kApp1 = 0xe1;
constexpr int kApp2 = 0xe2;
constexpr int kStartOfScan = 0xda;
constexpr int kEndOfImage = 0xd9;
constexpr std::string_view kExif = "Exif\0\0"sv;
constexpr std::string_view kMultiPicture = "MPF\0"sv;
constexpr std::string_view kStandardXmp = "http://ns.adobe.com/xap/1.0/\0"sv;
constexpr std::string_view kExtendedXmp = "http://ns.adobe.com/xmp/extension/\0"sv;

enum class ByteOrder { big, little };

/// A number of at most four bytes; 0 beyond the end.
std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t count,
                        ByteOrder order = ByteOrder::big) {
    if (at > bytes.size() || bytes.size() - at < count) return 0;
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const char byte = bytes[at + (order == ByteOrder::big ? k : count - 1 - k)];
        number = number << 8U | static_cast<unsigned char>(byte);
    }
    return number;
}

int marker_at(std::string_view bytes, std::size_t at) {
    return bytes[at] == '\xff' ? static_cast<unsigned char>(bytes[at + 1]) : 0;
}

/// The first directory of a TIFF structure.
class TiffDirectory {
  public:
    explicit TiffDirectory(std::string_view tiff)
        : tiff_(tiff), order_(tiff.starts_with("II") ? ByteOrder::little : ByteOrder::big) {}

    [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t count) const {
        return number_at(tiff_, at, count, order_);
    }

    /// The position of a tag's entry: tag, type, count, and value or its position.
    [[nodiscard]] std::optional<std::size_t> entry(std::uint32_t tag) const {
        constexpr std::size_t kEntryBytes = 12;
        const std::size_t directory = number(4, 4);
        const std::size_t entries = number(directory, 2);
        for (std::size_t k = 0; k < entries; ++k) {
            const std::size_t at = directory + 2 + kEntryBytes * k;
            if (number(at, 2) == tag) return at;
        }
        return std::nullopt;
    }

  private:
    std::string_view tiff_;
    ByteOrder order_;
};

/// The first segment of that kind whose payload begins so; null when there is none.
const JpegSegment* find_segment(const JpegSegments& segments, int marker, std::string_view begin) {
    const auto found =
        std::find_if(segments.begin(), segments.end(), [&](const JpegSegment& segment) {
            return segment.marker == marker && segment.payload.starts_with(begin);
        });
    return found == segments.end() ? nullptr : &*found;
}

}  // namespace

JpegSegments jpeg_segments(std::istream& in, std::uint64_t at) {
    constexpr std::size_t kMostOfFile = 4096;
    JpegSegments segments;
    std::array<char, 4> raw{};
    in.clear();
    in.seekg(static_cast<std::streamoff>(at));
    in.read(raw.data(), 2);
    if (!in || std::string_view(raw.data(), 2) != "\xff\xd8") return segments;
    for (at += 2; segments.size() < kMostOfFile; at += 2 + segments.back().payload.size() + 2) {
        in.read(raw.data(), raw.size());
        const std::string_view head(raw.data(), raw.size());
        const int marker = marker_at(head, 0);
        const std::uint32_t bytes = number_at(head, 2, 2);
        if (!in || marker < 0xc0 || marker == kStartOfScan || marker == kEndOfImage || bytes < 2)
            break;
        JpegSegment segment{marker, at + raw.size(), std::string(bytes - 2, '\0')};
        in.read(segment.payload.data(), static_cast<std::streamsize>(segment.payload.size()));
        if (!in) break;
        segments.push_back(std::move(segment));
    }
    return segments;
}

JpegFrame jpeg_frame(const JpegSegments& segments) {
    for (const JpegSegment& segment : segments) {
        const bool begins_frame = segment.marker >= 0xc0 && segment.marker <= 0xcf &&
                                  segment.marker != 0xc4 && segment.marker != 0xc8 &&
                                  segment.marker != 0xcc;
        if (!begins_frame) continue;
        const auto number = [&segment](std::size_t at, std::size_t count) {
            return static_cast<int>(number_at(segment.payload, at, count));
        };
        return {number(3, 2), number(1, 2), number(5, 1)};
    }
    return {};
}

std::optional<int> exif_orientation(const JpegSegments& segments) {
    constexpr std::uint32_t kOrientation = 0x0112;
    const JpegSegment* const exif = find_segment(segments, kApp1, kExif);
    if (exif == nullptr) return std::nullopt;
    const TiffDirectory tags(std::string_view(exif->payload).substr(kExif.size()));
    const auto entry = tags.entry(kOrientation);
    const auto orientation = entry ? static_cast<int>(tags.number(*entry + 8, 2)) : 0;
    return orientation >= 1 && orientation <= 8 ? std::optional(orientation) : std::nullopt;
}

XmpPackets xmp_packets(const JpegSegments& segments) {
    constexpr std::size_t kGuidBytes = 32;
    constexpr std::size_t kChunkAt = kGuidBytes + 8;  // behind the packet's size and the offset
    XmpPackets packets;
    if (const auto* const found = find_segment(segments, kApp1, kStandardXmp))
        packets.standard = found->payload.substr(kStandardXmp.size());
    std::map<std::uint32_t, std::string_view> chunks;
    for (const JpegSegment& segment : segments) {
        std::string_view payload = segment.payload;
        if (segment.marker != kApp1 || !payload.starts_with(kExtendedXmp)) continue;
        payload.remove_prefix(kExtendedXmp.size());
        if (payload.size() <= kChunkAt) continue;
        if (packets.standard.find(payload.substr(0, kGuidBytes)) == std::string::npos) continue;
        chunks[number_at(payload, kGuidBytes + 4, 4)] = payload.substr(kChunkAt);
    }
    for (const auto& [offset, chunk] : chunks) {
        if (offset != packets.extended.size()) break;
        packets.extended += chunk;
    }
    return packets;
}

std::vector<FurtherPicture> further_pictures(const JpegSegments& segments) {
    constexpr std::uint32_t kEntries = 0xb002;
    constexpr std::uint32_t kEntryBytes = 16;
    constexpr std::uint32_t kMostFurther = 16;
    constexpr std::uint32_t kTypeBits = 0xffffff;
    std::vector<FurtherPicture> pictures;
    const JpegSegment* const listing = find_segment(segments, kApp2, kMultiPicture);
    if (listing == nullptr) return pictures;
    const TiffDirectory list(std::string_view(listing->payload).substr(kMultiPicture.size()));
    const std::uint64_t origin = listing->at + kMultiPicture.size();
    const auto tag = list.entry(kEntries);
    if (!tag) return pictures;
    const std::uint32_t entries =
        std::min(list.number(*tag + 4, 4) / kEntryBytes, kMostFurther + 1);
    const std::size_t first = list.number(*tag + 8, 4);
    for (std::uint32_t k = 1; k < entries; ++k) {
        const std::size_t at = first + std::size_t{kEntryBytes} * k;
        const FurtherPicture picture{origin + list.number(at + 8, 4), list.number(at + 4, 4),
                                     list.number(at, 4) & kTypeBits};
        if (picture.bytes > 0) pictures.push_back(picture);
    }
    return pictures;
}

std::optional<std::size_t> jpeg_end(std::string_view bytes) {
    std::size_t at = 2;
    while (at + 2 <= bytes.size()) {
        const int marker = marker_at(bytes, at);
        if (marker == kEndOfImage) return at + 2;
        const std::uint32_t length = number_at(bytes, at + 2, 2);
        if (marker < 0xc0 || length < 2) return std::nullopt;
        at += 2 + length;
        if (marker != kStartOfScan) continue;
        // In the data 0xff is before 0 (a byte 0xff) or before a restart marker.
        while ((at = bytes.find('\xff', at)) != std::string_view::npos && at + 2 <= bytes.size()) {
            const int next = marker_at(bytes, at);
            if (next == 0xff)
                ++at;
            else if (next == 0 || (next >= 0xd0 && next <= 0xd7))
                at += 2;
            else
                break;
        }
        if (at == std::string_view::npos) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace dibhr
