// numpy's .npy and .npz files as pictures: what estimators of depth write; inside the room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "core/video/formats/numpy_array.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/formats/still_picture.hpp"

namespace dibhr {

/// Whether it is one; `head`: how it begins.
[[nodiscard]] bool is_array_file(const std::filesystem::path& file, std::string_view head);

/// A .npz with an array called as colours are (images, rgb) and one called as depth is (depths,
/// disp). False when it cannot be read.
[[nodiscard]] bool arrays_have_colour_and_depth(const std::filesystem::path& file);

/// The frames of one array, read one after the other. Of a .npz the array called `depths`, `depth`,
/// `disparity` or `disp` (colour: `images`, `rgb`), else its only one; the frames' times are those
/// in `times` or `timestamps` [s], else `fps` or 30 a second; `K` or `intrinsics` is the camera.
class ArrayFile : public IndexedPictures {
  public:
    /// Throws InputError.
    ArrayFile(const std::filesystem::path& file, PictureRole role);

  private:
    ArrayFile(const NamedArrays& arrays, PictureRole role);
    [[nodiscard]] cv::Mat picture(std::size_t at) override;
    void read_facts(const NamedArrays& arrays);
    void read_times(const NamedArrays& arrays);

    PictureRole role_;
    NumpyArray array_;
    PictureShape shape_{};
};

/// The first picture of a file of arrays. Throws InputError.
[[nodiscard]] StillPicture read_array(const std::filesystem::path& file, PictureRole role);

}  // namespace dibhr
