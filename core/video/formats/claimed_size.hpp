// How large a picture that OpenCV is to decode says it is, before that takes memory for it; inside
// the room.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>

namespace dibhr {

struct ClaimedSize {
    std::int64_t columns{0};
    std::int64_t rows{0};
    std::int64_t pixel_bytes{1};  ///< at most, decoded
};

/// By the header of a PNG, BMP, PNM, TIFF, WebP or JPEG picture that begins where the stream does;
/// nothing of other forms, and where the header says none.
[[nodiscard]] std::optional<ClaimedSize> claimed_size(std::istream& picture);

}  // namespace dibhr
