// What the layouts and names of public data sets and programs say about their depth: a table;
// inside the room.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/video/depth/findings.hpp"
#include "core/video/depth/level_code.hpp"
#include "core/video/formats/camera_files.hpp"
#include "core/video/formats/picture_source.hpp"

namespace dibhr {

/// A row of the table that a depth picture fits.
struct DataSetFacts {
    std::string_view name{};             ///< for people: "KITTI depth completion"
    Finding finding{};                   ///< with the code, if it is one of levels
    InverseLevels law{kKinectLevels};    ///< of a code that needs one
    std::optional<CameraFile> camera{};  ///< of the depth pictures
};

/// The first row of the table that the depth pictures of a source fit: by the last parts of the
/// path of the first one, in small or capital letters, by what lies beside it, and by the bits of
/// its levels. The folder that was opened plays no part. Nothing: no row does.
[[nodiscard]] std::optional<DataSetFacts> data_set_of(const SourceFacts& facts);

/// The data set of a source, looked for once: the table lists folders.
class KnownDataSet {
  public:
    /// data_set_of(); the same answer for the same picture and bits.
    [[nodiscard]] const std::optional<DataSetFacts>& of(const SourceFacts& facts);

  private:
    std::filesystem::path picture_{};
    int bits_{0};
    std::optional<DataSetFacts> found_{};
};

}  // namespace dibhr
