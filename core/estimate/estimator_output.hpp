// What an estimator has left in its folder: rows of pictures, arrays, videos.
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

/// Pictures whose names differ in one number only: of one form, a frame each.
using NumberedOutputs = std::map<std::size_t, std::filesystem::path>;

/// The row that tells how far it is: of the longest (one picture more or less counts for nothing)
/// the one of the finest form. Empty where there is none.
[[nodiscard]] NumberedOutputs row_so_far(const std::filesystem::path& folder);

struct WholeOutputs {
    std::set<std::size_t> numbers{};
    std::vector<std::filesystem::path> removed{};  ///< which could not be read
};

/// Those in that row whose pictures are whole: the newest, which a crash may have cut, are read,
/// and removed where they cannot be. None where they are not called by the frames' own names
/// (frame_name): they count anew in each run.
[[nodiscard]] WholeOutputs whole_outputs(const std::filesystem::path& folder);

/// All bytes in the folder: they grow while something is written.
[[nodiscard]] std::uintmax_t bytes_in(const std::filesystem::path& folder);

/// One of the forms in which the depth may be there.
class DepthOutput {
  public:
    explicit DepthOutput(NumberedOutputs row) : row_(std::move(row)) {}
    explicit DepthOutput(std::filesystem::path file) : file_(std::move(file)) {}

    /// From its first picture on, each time. Throws InputError.
    [[nodiscard]] std::unique_ptr<PictureSource> open() const;
    /// Its pictures are painted: no levels. Throws InputError.
    [[nodiscard]] bool is_painted() const;
    /// For messages.
    [[nodiscard]] const std::filesystem::path& file() const {
        return row_.empty() ? file_ : row_.begin()->second;
    }

  private:
    NumberedOutputs row_{};
    std::filesystem::path file_{};
};

/// All that may be depth in the folder and the folders in it, the likeliest first: numbers before
/// videos, of pictures the finest form, and what is called like colour or input last.
[[nodiscard]] std::vector<DepthOutput> depth_outputs(const std::filesystem::path& folder);

}  // namespace dibhr
