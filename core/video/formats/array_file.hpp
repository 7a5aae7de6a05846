// numpy's .npy and .npz files as pictures: what estimators of depth write; inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/video/formats/numpy_array.hpp"
#include "core/video/formats/still_picture.hpp"

namespace dibhr {

[[nodiscard]] bool is_array_file(const std::filesystem::path& file);

/// A .npz with an array called as colours are (images, rgb) and one called as depth is (depths,
/// disp). False when it cannot be read.
[[nodiscard]] bool arrays_have_colour_and_depth(const std::filesystem::path& file);

/// The frames of one array, read one after the other. Of a .npz the array called `depths`, `depth`,
/// `disparity` or `disp` (colour: `images`, `rgb`), else its only one; the frames' times are those
/// in `times` or `timestamps` [s], else `fps` or 30 a second; `K` or `intrinsics` is the camera.
class ArrayFile : public PictureSource {
  public:
    /// Throws InputError.
    ArrayFile(const std::filesystem::path& file, PictureRole role);

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    void seek(double time_s) override;

  private:
    ArrayFile(const NamedArrays& arrays, PictureRole role);
    void read_facts(const NamedArrays& arrays);
    void read_times(const NamedArrays& arrays);

    PictureRole role_;
    NumpyArray array_;
    PictureShape shape_{};
    SourceFacts facts_{};
    std::vector<double> times_s_{};  // from the first
    std::int64_t at_{0};
};

/// The first picture of a file of arrays. Throws InputError.
[[nodiscard]] StillPicture read_array(const std::filesystem::path& file, PictureRole role);

}  // namespace dibhr
