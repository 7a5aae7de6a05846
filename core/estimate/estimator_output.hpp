// Finds an estimator's output in its folder: rows of pictures, arrays, videos.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "core/video/formats/picture_source.hpp"

namespace dibhr {

/// Pictures of one form whose names differ in one number only: one for each frame.
using NumberedOutputs = std::map<std::size_t, std::filesystem::path>;

/// The row that shows the progress: of the longest rows (a difference of one picture does not
/// count) the one of the finest form. Empty where there is none.
[[nodiscard]] NumberedOutputs row_so_far(const std::filesystem::path& folder);

struct WholeOutputs {
    std::set<std::size_t> numbers{};
    std::vector<std::filesystem::path> removed{};  ///< unreadable pictures
};

/// The whole pictures of that row. Reads the newest ones, which a crash may have truncated, and
/// removes unreadable ones. None where names do not hold the frames' names (frame_name): such
/// estimators count anew in each run.
[[nodiscard]] WholeOutputs whole_outputs(const std::filesystem::path& folder);

/// One form in which the depth may be there: a row of pictures or a file.
class DepthOutput {
  public:
    explicit DepthOutput(NumberedOutputs row) : row_(std::move(row)) {}
    explicit DepthOutput(std::filesystem::path file) : file_(std::move(file)) {}

    /// Opens it at its first picture. Throws InputError.
    [[nodiscard]] std::unique_ptr<PictureSource> open() const;
    /// Whether the pictures have colours: no levels. Throws InputError.
    [[nodiscard]] bool is_painted() const;
    /// For messages.
    [[nodiscard]] const std::filesystem::path& file() const {
        return row_.empty() ? file_ : row_.begin()->second;
    }

  private:
    NumberedOutputs row_{};
    std::filesystem::path file_{};
};

/// All that may be depth in the folder and its subfolders, the likeliest first: pictures and arrays
/// before videos, the finest form first, and names for colour or input last.
[[nodiscard]] std::vector<DepthOutput> depth_outputs(const std::filesystem::path& folder);

}  // namespace dibhr
