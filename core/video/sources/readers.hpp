// The readers of all forms of pictures, in one ordered list: the first one that accepts a place
// reads it; inside the room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string_view>
#include <vector>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/formats/still_picture.hpp"

namespace dibhr {

struct Sources;

/// Decides where colour and depth are searched.
enum class PictureForm { bag, row, video, arrays, still };

/// The functions that read one form.
struct Reader {
    std::string_view name;  ///< of the form, for messages
    PictureForm form;
    /// Whether a place is of that form: by `head`, the first bytes of a file (empty for a folder);
    /// where these are not enough, by name or content.
    bool (*is_own)(const std::filesystem::path& place, std::string_view head);
    /// Reads the first picture; null: the form has no still pictures.
    StillPicture (*read)(const std::filesystem::path& file, PictureRole role);
    /// Opens the pictures of that role; null: use read().
    std::unique_ptr<PictureSource> (*open)(const std::filesystem::path& place, PictureRole role);
    /// Opens colour and depth of one place; without depth where it does not hold both. Null: the
    /// form never holds both.
    Sources (*open_both)(const std::filesystem::path& place);
    Evidence decided_by{Evidence::magic};  ///< what is_own() goes by
};

/// The first reader that accepts the place. Throws InputError for a file that none can read.
[[nodiscard]] const Reader& reader_of(const std::filesystem::path& place);

/// That it takes the file of a source, and by what.
[[nodiscard]] Finding finding_on_form(const Reader& reader, const SourceFacts& facts);

/// Opens a still image, a video or a folder of pictures, by content. Throws InputError.
[[nodiscard]] std::unique_ptr<PictureSource> open_picture_source(const std::filesystem::path& place,
                                                                 PictureRole role);

/// A place and its reader.
struct KnownPlace {
    explicit KnownPlace(const std::filesystem::path& named)
        : path(named), reader(reader_of(named)) {}

    [[nodiscard]] bool is(PictureForm form) const { return reader.form == form; }
    /// As open_picture_source().
    [[nodiscard]] std::unique_ptr<PictureSource> open(PictureRole role) const;

    const std::filesystem::path& path;
    const Reader& reader;
};

/// Opens a place as colour pictures; of a video that track.
[[nodiscard]] std::unique_ptr<PictureSource> open_as_colour(const std::filesystem::path& place,
                                                            int track = 0);

inline constexpr int kKindSamples = 6;  ///< pictures used to guess their kind

/// Sample pictures of a place as colour; none of depth in real numbers, which has no colours.
[[nodiscard]] std::vector<cv::Mat> colour_samples(const std::filesystem::path& place, int most,
                                                  int track = 0);

/// Reads a still image, or the first picture of an array. Depth keeps its levels and channels,
/// colour becomes 8-bit BGR. Throws InputError.
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
