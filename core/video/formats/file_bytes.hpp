// What the readers of forms share: how a file begins, what is refused before any reader sees it,
// how large it may claim to be, and pictures of real numbers; inside the room.
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

namespace dibhr {

/// The first bytes of an ordinary file, or the last ones, at most so many; none when it is none, or
/// cannot be read.
[[nodiscard]] std::string beginning_of(const std::filesystem::path& file, std::size_t most);
[[nodiscard]] std::string end_of(const std::filesystem::path& file, std::size_t most);

/// So much of it as readers tell their files by.
[[nodiscard]] std::string head_of(const std::filesystem::path& file);

/// In bytes; 0 when it cannot be told.
[[nodiscard]] std::uint64_t size_of(const std::filesystem::path& file);

/// Refuses what no decoder could read: missing, a directory, a pipe or device, no permission,
/// empty, text, recordings that only their maker's programs read. Throws InputError: what,
/// which file, what to do next.
void require_readable(const std::filesystem::path& file);

/// Throws InputError when a picture is too small to touch or show (less than 2 x 2).
void require_size(const std::filesystem::path& file, int columns, int rows);

/// Turns the byte order of each number of so many bytes.
inline void swap_bytes(std::span<std::uint8_t> numbers, std::size_t bytes) {
    for (; numbers.size() >= bytes; numbers = numbers.subspan(bytes))
        std::reverse(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(bytes));
}

/// The one bound of what is decoded, whatever the form: a picture of 8K, with four 16-bit channels.
/// To touch a surface of so many pixels takes a gigabyte.
inline constexpr std::int64_t kMostPixels = std::int64_t{1} << 25;
inline constexpr std::int64_t kMostPictureBytes = 8 * kMostPixels;
/// The most pictures that one file holds: four days at 30 Hz.
inline constexpr std::int64_t kMostPictures = 10'000'000;

/// Whether a picture is within that bound.
[[nodiscard]] bool may_be_decoded(std::int64_t columns, std::int64_t rows,
                                  std::int64_t bytes_per_pixel) noexcept;

/// Whether so many bytes can hold such a picture, however well it is compressed; never one beyond
/// the bound.
[[nodiscard]] bool can_hold(std::uint64_t bytes, std::int64_t columns, std::int64_t rows,
                            std::int64_t bytes_per_pixel);

/// Throws InputError when a header's picture is beyond the bound, or larger than what a file of
/// that size can hold however well it is compressed: before memory is taken for it.
void require_plausible_size(const std::filesystem::path& file, std::int64_t columns,
                            std::int64_t rows, std::int64_t bytes_per_pixel);

/// How large a picture that OpenCV is to decode says it is, before that takes memory for it.
struct ClaimedSize {
    std::int64_t columns{0};
    std::int64_t rows{0};
    std::int64_t pixel_bytes{1};  ///< at most, decoded
};

/// By the header of a PNG, BMP, PNM, TIFF, WebP or JPEG picture that begins where the stream does;
/// nothing of other forms, and where the header says none.
[[nodiscard]] std::optional<ClaimedSize> claimed_size(std::istream& picture);

/// 8-bit BGR as a screen shows it (the sRGB transfer), of linear light from 0 to 1 in the same
/// order.
[[nodiscard]] cv::Mat screen_colours(const cv::Mat& linear);

}  // namespace dibhr
