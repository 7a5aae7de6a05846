// Numbered pictures, as cameras and datasets leave them: one row of pictures, or one of colour and
// one of depth that belong together; inside the room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/video/depth/findings.hpp"
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

/// Facts about depth that follow from the layout of the pictures. For depth of 16 bits only: the
/// datasets' conventions are for such pictures.
struct LayoutFacts {
    Finding finding{{}, Evidence::layout, kSurenessOfMetadata, {}};
    int columns{0}, rows{0};       ///< picture size of the intrinsics; 0: not stated
    std::string notice{};          ///< a sentence on ignored entries
    bool other_camera{false};      ///< colour is from another camera at an unknown place
    std::filesystem::path list{};  ///< the file that names the pictures and their times
};

/// Pictures of one place, sorted by the words in their names (media_names.hpp).
struct PictureSet {
    PictureRow colour{};
    PictureRow depth{};
    PictureRow unnamed{};
    PictureRow others{};  ///< masks, confidence, normals, previews
    LayoutFacts facts{};
};

/// Whether the file exists and is named as a picture, or holds raw levels; false for hidden files.
[[nodiscard]] bool is_picture(const std::filesystem::path& file);

/// Whether a picture file paints numbers, in the colours of a colour map or as a mask; false where
/// it cannot be read. Reads it.
[[nodiscard]] bool is_painting(const std::filesystem::path& file);

[[nodiscard]] NumberedPicture numbered(const std::filesystem::path& file);

/// The number in a picture's name as a file beside names the picture (BOP); 0: none, or too large.
[[nodiscard]] int number_in_name(const std::filesystem::path& file);

/// Whether every number occurs once, and all have a decimal point, or none.
[[nodiscard]] bool has_order(const PictureRow& row, bool decimal);

/// Sorts by number, where every picture has a different one.
void sort_by_number(PictureRow& row);

/// The pictures of a folder; where it has none, or a cover alone, those of its subfolders named
/// colour or depth, else those of its subfolder `data`. Masks, confidence, normals and previews
/// count only where nothing else is there; arrays beside pictures of the same names are their
/// depth, and beat paintings of it. Throws InputError when it cannot be read.
[[nodiscard]] PictureSet find_pictures_in(const std::filesystem::path& folder);

/// When each picture of a row is shown, by the clock shared with the other row [s]. Decimal numbers
/// are seconds. Other numbers are put in order at `frames_per_s`, and the same number in both rows
/// is the same time. Where numbers are missing or repeated, position in the row counts.
[[nodiscard]] std::vector<double> times_s(const PictureRow& row, const PictureRow& other,
                                          double frames_per_s);

/// A row of pictures as a video. Where a picture cannot be read, the facts report it, and the one
/// before it is shown.
class PictureSequence : public IndexedPictures {
  public:
    /// `times`: one for each picture, increasing. Throws InputError when the first picture cannot
    /// be read, or when the times span more than a million seconds.
    PictureSequence(std::filesystem::path place, PictureRow row, std::vector<double> times,
                    PictureRole role, const LayoutFacts& layout = {}, Timing timing = {});

  private:
    [[nodiscard]] cv::Mat picture(std::size_t at) override;
    void apply_layout(const LayoutFacts& layout);

    PictureRow row_;
    PictureRole role_;
    cv::Mat last_{};
};

}  // namespace dibhr
