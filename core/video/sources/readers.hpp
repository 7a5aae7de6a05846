// The forms of pictures that are read: one list, in the order in which a place is asked whether it
// is theirs; inside the room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/formats/still_picture.hpp"

namespace dibhr {

struct Sources;

/// What makes a difference to where colour and depth are looked for.
enum class PictureForm { bag, row, video, arrays, still };

/// Who reads one form.
struct Reader {
    std::string_view name;  ///< of the form, for people
    PictureForm form;
    /// Whether a place is of that form: by `head`, how a file begins, which is empty for a folder;
    /// where that says too little, by its name or what it holds.
    bool (*is_own)(const std::filesystem::path& place, std::string_view head);
    /// Its first picture; null: it has no single ones.
    StillPicture (*read)(const std::filesystem::path& file, PictureRole role);
    /// Its pictures of that role; null: the one of read().
    std::unique_ptr<PictureSource> (*open)(const std::filesystem::path& place, PictureRole role);
    /// Colour and depth of one place; without depth where it does not hold both. Null: it never
    /// does.
    Sources (*open_both)(const std::filesystem::path& place);
};

/// The first one that says that the place is its own. Throws InputError for what none could read.
[[nodiscard]] const Reader& reader_of(const std::filesystem::path& place);

/// A still image or a video, told apart by content, or a folder of pictures. Throws InputError.
[[nodiscard]] std::unique_ptr<PictureSource> open_picture_source(const std::filesystem::path& place,
                                                                 PictureRole role);

/// Depth keeps its levels and channels, colour becomes 8-bit BGR; of an array the first picture.
/// Throws InputError.
[[nodiscard]] StillPicture read_still(const std::filesystem::path& file, PictureRole role);

/// A still image as a source of one picture.
class StillFile : public IndexedPictures {
  public:
    /// Throws InputError.
    StillFile(const std::filesystem::path& file, PictureRole role)
        : StillFile(file, read_still(file, role)) {}
    StillFile(const std::filesystem::path& file, StillPicture still);

  private:
    [[nodiscard]] cv::Mat picture(std::size_t /*at*/) override { return picture_; }

    cv::Mat picture_;
};

}  // namespace dibhr
