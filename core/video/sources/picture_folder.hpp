// Numbered pictures, as cameras and datasets leave them: one row of pictures, or one of colour and
// one of depth that belong together; inside the room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"

namespace dibhr {

/// A picture and the last number in its name ("frame-000123.color.png": 123; "0.083333.png":
/// 0.083333).
struct NumberedPicture {
    std::filesystem::path file{};
    std::optional<double> number{};
    bool decimal{false};  ///< the number has a point: seconds, by TUM's convention
};

/// In natural order: 97 before 100.
using PictureRow = std::vector<NumberedPicture>;

/// What the layout of pictures says of their depth, where that has 16 bits: the conventions of
/// datasets are for such pictures.
struct LayoutFacts {
    DepthStatement known{};
    std::string known_from{};
    int columns{0}, rows{0};   ///< of the pictures that the intrinsics are for; 0: of any
    std::string notice{};      ///< a sentence on what was passed over
    bool other_camera{false};  ///< of colour, which stands elsewhere, nobody knows where
};

/// Pictures that are kept together, told apart by words in names (media_names.hpp).
struct PictureSet {
    PictureRow colour{};
    PictureRow depth{};
    PictureRow unnamed{};
    LayoutFacts facts{};
};

/// Whether there is such a file and its name is that of a picture; not where it begins with a
/// point.
[[nodiscard]] bool is_picture(const std::filesystem::path& file);

[[nodiscard]] NumberedPicture numbered(const std::filesystem::path& file);

/// By number, where every picture has another one.
void sort_by_number(PictureRow& row);

/// The pictures of a folder, or, where it has none, of those in folders in it whose names say what
/// they hold. Throws InputError when it cannot be read.
[[nodiscard]] PictureSet look_into(const std::filesystem::path& folder);

/// The colour row as it goes with a depth row where both have times: with each depth picture the
/// nearest of colour when it is within 0.02 s, as TUM's associate.py has it, else the newest before
/// it. Where the rows have no times, or times of two clocks, it is the colour row itself.
[[nodiscard]] PictureRow nearest_in_time(const PictureRow& colour, const PictureRow& depth);

/// When each picture of a row is shown, by the clock that it shares with the other row [s]: decimal
/// numbers are seconds; pictures of both rows of the same number go together, one after the other
/// at so many a second; where numbers lack or repeat, the first goes with the first.
[[nodiscard]] std::vector<double> times_s(const PictureRow& row, const PictureRow& other,
                                          double frames_per_s);

/// A row of pictures as a video. One that cannot be read on the way is told, and the one before it
/// stays.
class PictureSequence : public IndexedPictures {
  public:
    /// `times`: one a picture, rising. Throws InputError when the first cannot be read, or when
    /// they go over more than a million seconds.
    PictureSequence(std::filesystem::path place, PictureRow row, std::vector<double> times,
                    PictureRole role, const LayoutFacts& said = {});

  private:
    [[nodiscard]] cv::Mat picture(std::size_t at) override;
    void take_in(const LayoutFacts& said);

    PictureRow row_;
    PictureRole role_;
    cv::Mat last_{};
};

}  // namespace dibhr
