// Helpers of all readers: the first bytes of a file, the check before any reader opens it, bounds
// for claimed sizes, and colours of real numbers; inside the room.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dibhr {

/// The first bytes of a regular file, or the last ones, at most `most`; empty when it is no regular
/// file, or cannot be read.
[[nodiscard]] std::string beginning_of(const std::filesystem::path& file, std::size_t most);
[[nodiscard]] std::string end_of(const std::filesystem::path& file, std::size_t most);

/// The first bytes, as many as readers need to recognise their files.
[[nodiscard]] std::string head_of(const std::filesystem::path& file);

/// In bytes; 0 when unknown.
[[nodiscard]] std::uint64_t size_of(const std::filesystem::path& file);

/// Throws InputError for a file that no reader can read: missing, a directory, a pipe or device, no
/// permission, empty, or with the magic bytes of a form that has to be converted. The message says
/// what, which file, and what to do next.
void require_readable(const std::filesystem::path& file);

/// Likewise for a file whose magic bytes no reader knows: throws where its ending is that of
/// another form, for numbers without a header or as text, and for other text.
void require_no_other_form(const std::filesystem::path& file);

/// What a file is that no reader reads, and what to do, as the rest of a sentence that begins with
/// its name; empty where neither its bytes nor its ending tell a form. Of text judges .csv alone.
[[nodiscard]] std::string advice_on_form(const std::filesystem::path& file);

/// Likewise of a photo that has depth in it which no reader reads.
[[nodiscard]] std::string advice_on_depth_within(const std::filesystem::path& file);

/// Advice with the file's name, as a word of a shell's command, in place of each "{}", and with the
/// sides of numbers of 16 bits, which are the whole file, in place of "{sides}".
[[nodiscard]] std::string filled_advice(std::string_view advice, const std::filesystem::path& file);

/// Throws InputError when a picture is too small to touch or show (less than 2 x 2).
void require_size(const std::filesystem::path& file, int columns, int rows);

/// Reverses the byte order of each number of `bytes` bytes.
inline void swap_bytes(std::span<std::uint8_t> numbers, std::size_t bytes) {
    for (; numbers.size() >= bytes; numbers = numbers.subspan(bytes))
        std::reverse(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(bytes));
}

/// The bound of a decoded picture, for all forms: 8K with four 16-bit channels. To touch a surface
/// of so many pixels takes a gigabyte.
inline constexpr std::int64_t kMostPixels = std::int64_t{1} << 25;
inline constexpr std::int64_t kMostPictureBytes = 8 * kMostPixels;
/// The most pictures that one file holds: four days at 30 Hz.
inline constexpr std::int64_t kMostPictures = 10'000'000;

/// Whether a picture is within that bound.
[[nodiscard]] bool may_be_decoded(std::int64_t columns, std::int64_t rows,
                                  std::int64_t bytes_per_pixel) noexcept;

/// Whether a file of so many bytes can hold such a picture with any compression. False for a
/// picture beyond the bound.
[[nodiscard]] bool can_hold(std::uint64_t bytes, std::int64_t columns, std::int64_t rows,
                            std::int64_t bytes_per_pixel);

/// Throws InputError when the picture of a header is beyond the bound, or larger than the file can
/// hold with any compression. To be called before memory is allocated.
void require_plausible_size(const std::filesystem::path& file, std::int64_t columns,
                            std::int64_t rows, std::int64_t bytes_per_pixel);

/// The size that a picture's header claims, to be checked before OpenCV allocates memory.
struct ClaimedSize {
    std::int64_t columns{0};
    std::int64_t rows{0};
    std::int64_t pixel_bytes{1};  ///< at most, decoded
};

/// Reads the header of a PNG, BMP, PNM, TIFF, WebP or JPEG picture at the begin of the stream;
/// nothing for other forms, and for a header without a size.
[[nodiscard]] std::optional<ClaimedSize> claimed_size(std::istream& picture);

/// Converts linear light from 0 to 1 to 8-bit levels of a screen (sRGB); keeps the channels.
[[nodiscard]] cv::Mat screen_colours(const cv::Mat& linear);

}  // namespace dibhr
