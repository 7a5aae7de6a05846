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
/// [frames, 3, rows, columns] as networks have colours; [rows, columns, frames] where the last side
/// is too short for a picture.
struct PictureShape {
    std::int64_t frames{1};
    std::int64_t rows{0};
    std::int64_t columns{0};
    std::int64_t channels{1};
    bool is_planar{false};    ///< the channels come before rows and columns
    bool frames_last{false};  ///< the frames come behind rows and columns
};

/// How Python reads the array of that name of a .npz, or with an empty one the .npy.
[[nodiscard]] std::string loading_of(const std::filesystem::path& file, const std::string& name);

class NumpyArray {
  public:
    /// `name`: of an array in a .npz, else empty. Throws InputError when it is no array of numbers,
    /// or shorter than its header says.
    NumpyArray(std::filesystem::path file, const std::string& name,
               std::unique_ptr<ArrayBytes> bytes);

    [[nodiscard]] const NumpyHeader& header() const { return header_; }

    /// All numbers in the file's order; none if there are more than `most`. Throws InputError.
    [[nodiscard]] std::vector<double> numbers(std::int64_t most);

    /// Whether two sides or more are as long as those of the smallest pictures.
    [[nodiscard]] bool has_sides_of_pictures() const;

    /// The shape as pictures. Where the last side is too short for a picture, the numbers decide
    /// whether it counts frames. Throws InputError when the shape is none of pictures, when it
    /// counts different quantities, when a matrix of a camera or pose is in it, or when the
    /// pictures are too large.
    [[nodiscard]] PictureShape pictures();

    /// A frame: levels of 8 or 16 bits of u1 or u2, else real numbers. Throws InputError.
    [[nodiscard]] cv::Mat picture(const PictureShape& shape, std::int64_t frame);

  private:
    [[nodiscard]] cv::Mat read(std::uint64_t first, std::int64_t count);
    [[nodiscard]] cv::Mat plain_picture(const PictureShape& shape, std::int64_t frame);
    [[nodiscard]] cv::Mat fortran_picture(const PictureShape& shape, std::int64_t frame);
    [[nodiscard]] cv::Mat last_axis_picture(const PictureShape& shape, std::int64_t frame);
    [[nodiscard]] bool is_matrix();
    void require_bounded_size(const PictureShape& shape) const;
    void require_frames(const PictureShape& shape);

    std::filesystem::path file_;
    std::string loaded_;  ///< how Python reads it
    std::unique_ptr<ArrayBytes> bytes_;
    NumpyHeader header_{};
    std::int64_t count_{1};
    cv::Mat whole_{};  ///< the whole array, where pictures are not contiguous
};

}  // namespace dibhr
