// Reads one numpy array as pictures: its header and its numbers; inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/video/formats/array_bytes.hpp"

namespace dibhr {

/// The content of a numpy header (numpy.lib.format).
struct NumpyHeader {
    char kind{'f'};       ///< f: real, i: whole, u: whole and not negative
    int number_bytes{4};  ///< 1, 2, 4 or 8
    bool swapped{false};  ///< not in this machine's byte order
    bool fortran{false};  ///< the first index varies fastest
    std::vector<std::int64_t> shape{};
    std::uint64_t data_at{0};  ///< where the numbers begin
};

/// [rows, columns] or [frames, rows, columns], each also with 1, 3 or 4 channels at the end;
/// [frames, 3, rows, columns] as networks have colours.
struct PictureShape {
    std::int64_t frames{1};
    std::int64_t rows{0};
    std::int64_t columns{0};
    std::int64_t channels{1};
    bool is_planar{false};  ///< the channels come before rows and columns
};

class NumpyArray {
  public:
    /// Throws InputError when it is no array of numbers, or shorter than its header says.
    NumpyArray(std::filesystem::path file, std::unique_ptr<ArrayBytes> bytes);

    [[nodiscard]] const NumpyHeader& header() const { return header_; }

    /// All numbers in the file's order; none if there are more than `most`. Throws InputError.
    [[nodiscard]] std::vector<double> numbers(std::int64_t most);

    /// The shape as pictures. Throws InputError when it is none, or the pictures are too large.
    [[nodiscard]] PictureShape pictures() const;

    /// A frame: levels of 8 or 16 bits of u1 or u2, else real numbers. Throws InputError.
    [[nodiscard]] cv::Mat picture(const PictureShape& shape, std::int64_t frame);

  private:
    [[nodiscard]] cv::Mat read(std::uint64_t first, std::int64_t count);
    [[nodiscard]] cv::Mat plain_picture(const PictureShape& shape, std::int64_t frame);
    [[nodiscard]] cv::Mat fortran_picture(const PictureShape& shape, std::int64_t frame);

    std::filesystem::path file_;
    std::unique_ptr<ArrayBytes> bytes_;
    NumpyHeader header_{};
    std::int64_t count_{1};
    cv::Mat whole_{};  ///< the whole array, in Fortran order only: pictures are not contiguous
};

}  // namespace dibhr
