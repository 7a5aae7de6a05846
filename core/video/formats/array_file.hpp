// Reads numpy's .npy and .npz files as pictures, as depth estimators write them; inside the room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

#include "core/video/formats/numpy_array.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/formats/still_picture.hpp"

namespace dibhr {

/// Whether the file is a .npy or .npz; `head`: its first bytes.
[[nodiscard]] bool is_array_file(const std::filesystem::path& file, std::string_view head);

/// Whether a .npz has an array that is surely its colour and one that is its depth, by their names
/// or as the only ones that can be. False when it cannot be read.
[[nodiscard]] bool arrays_have_colour_and_depth(const std::filesystem::path& file);

/// Whether a .npy can be a picture by its shape; else it is a camera, poses, a list of numbers.
/// True for other files.
[[nodiscard]] bool may_be_picture(const std::filesystem::path& file);

/// Reads the frames of one array in order; colours of bytes, or of real numbers in three channels.
/// Of a .npz the array called `depths`, `depth`, `disparity` or `disp` (colour: `images`, `rgb`),
/// else the only one whose name says depth, else the only one that can be a picture of it. Times
/// come from `times` or `timestamps` [s], else from `fps`, else 30 a second; `K` or `intrinsics` is
/// the camera, `depth_scale` what a level is, and words of the depth's name are its unit.
class ArrayFile : public IndexedPictures {
  public:
    /// Throws InputError.
    ArrayFile(const std::filesystem::path& file, PictureRole role);

  private:
    ArrayFile(const NamedArrays& arrays, PictureRole role);
    [[nodiscard]] cv::Mat picture(std::size_t at) override;
    void read_facts(const NamedArrays& arrays);
    void read_times(const NamedArrays& arrays);
    void find_white();
    void require_no_mask() const;

    PictureRole role_;
    std::string name_;
    NumpyArray array_;
    PictureShape shape_{};
    cv::Mat first_{};                   ///< the first frame, until it is taken
    double black_{0.0}, white_{255.0};  ///< of colours
};

/// The first picture of a file of arrays. Throws InputError.
[[nodiscard]] StillPicture read_array(const std::filesystem::path& file, PictureRole role);

}  // namespace dibhr
