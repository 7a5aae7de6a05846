// Finds the parts of a JPEG file: its metadata, its end, and further pictures in the file; inside
// the room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// A segment before the data of a picture.
struct JpegSegment {
    int marker{0};        ///< second byte: 0xe1 for APP1
    std::uint64_t at{0};  ///< position of the payload in the stream
    std::string payload{};
};
using JpegSegments = std::vector<JpegSegment>;

/// The segments of the picture that begins at `at`, at most 4096 (256 MB); empty when none begins
/// there. Does not read the picture's data.
[[nodiscard]] JpegSegments jpeg_segments(std::istream& in, std::uint64_t at = 0);

/// The size and the number of channels in the start-of-frame segment; zeros when there is none.
struct JpegFrame {
    int columns{0};
    int rows{0};
    int channels{0};
};
[[nodiscard]] JpegFrame jpeg_frame(const JpegSegments& segments);

/// How a viewer turns the picture, by EXIF: 1 (not at all) to 8; nothing when it is not stated.
[[nodiscard]] std::optional<int> exif_orientation(const JpegSegments& segments);

/// The XMP packet, and the extended one that belongs to it, joined; empty when there is none. Of an
/// incomplete extended packet the part before the gap.
struct XmpPackets {
    std::string standard{};
    std::string extended{};
};
[[nodiscard]] XmpPackets xmp_packets(const JpegSegments& segments);

/// A picture behind the first one, as the Multi-Picture Format (CIPA DC-007) lists it.
struct FurtherPicture {
    std::uint64_t at{0};  ///< in the stream
    std::uint64_t bytes{0};
    std::uint32_t type{0};  ///< 0: not stated
};
/// At most 16.
[[nodiscard]] std::vector<FurtherPicture> further_pictures(const JpegSegments& segments);

/// The position behind the picture with which the bytes begin; nothing when its end is missing.
[[nodiscard]] std::optional<std::size_t> jpeg_end(std::string_view bytes);

}  // namespace dibhr
