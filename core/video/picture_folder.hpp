// Folders of numbered pictures, as cameras and datasets leave them: one row of pictures, or one of
// colour and one of depth that belong together; inside the room.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/video/pictures.hpp"

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

/// What a folder holds, told apart by words in names: depth; color, colour or rgb.
struct PictureFolder {
    PictureRow colour{};
    PictureRow depth{};
    PictureRow unnamed{};
};

/// Of its own pictures, or, where it has none, of those in folders in it whose names say what they
/// hold. Files that begin with a point are passed over. Throws InputError when it cannot be read.
[[nodiscard]] PictureFolder look_into(const std::filesystem::path& folder);

/// When each picture of a row is shown, by the clock that it shares with the other row [s]: decimal
/// numbers are seconds; pictures of both rows of the same number go together, one after the other
/// at so many a second; where numbers lack or repeat, the first goes with the first.
[[nodiscard]] std::vector<double> times_s(const PictureRow& row, const PictureRow& other,
                                          double frames_per_s);

/// Pictures a second of those whose names tell no time.
inline constexpr double kPicturesPerSecond = 30.0;

/// A row of pictures as a video. One that cannot be read on the way is told, and the one before it
/// stays.
class PictureSequence : public PictureSource {
  public:
    /// `times`: one a picture, rising. Throws InputError when the first cannot be read.
    PictureSequence(std::filesystem::path place, PictureRow row, std::vector<double> times,
                    PictureRole role);

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    void seek(double time_s) override;

  private:
    SourceFacts facts_{};
    PictureRow row_;
    std::vector<double> times_s_;  // from the first
    PictureRole role_;
    std::size_t at_{0};
    cv::Mat last_{};
};

}  // namespace dibhr
