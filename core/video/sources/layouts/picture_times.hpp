// When pictures are shown that have no presentation times: by stamps in their names, or in a file
// beside them; inside the room.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/layouts/picture_folder.hpp"

namespace dibhr {

/// The unit [s] of numbers that rise from the first to the last of `count` pictures, where they are
/// stamps: since 1970 in s, ms, us or ns, or steps of 4 ms to 1 s in us or ns. Nothing for numbers
/// of frames. `are_times`: known to be times, so that any step has a unit.
[[nodiscard]] std::optional<double> stamp_unit_s(double first, double last, std::size_t count,
                                                 bool are_times);

/// Stamps of pictures in a file.
struct ListedTimes {
    std::vector<double> times_s{};  ///< one a picture, rising
    std::filesystem::path file{};
    bool is_of_frame{false};  ///< the file is that of the first frame: each has one
};

/// Reads one file of stamps: a table of text (one time a line; columns of times and of names or
/// frame numbers, with or without a header; dates; mkvextract's time stamps) or JSON (a list of
/// frames, or an object with one). Nothing where it has no stamp for some picture, or where they do
/// not rise.
[[nodiscard]] std::optional<std::vector<double>> read_stamps(const std::filesystem::path& file,
                                                             const PictureRow& row);

/// The stamps that recorders and data sets leave beside pictures, in their folder or the one above:
/// timestamps.txt, times.txt, data.csv, odometry.csv, frames.json, depth_timestamps.csv and the
/// like; else in JSON files, one a frame, of the pictures' names or numbers.
[[nodiscard]] std::optional<ListedTimes> times_beside(const PictureRow& row);

/// How the times of a row are known, as times_s() gives them, with the stamps that are found for
/// it. `list`: the file that names the pictures; empty: none.
[[nodiscard]] Timing timing_of(const PictureRow& row, const PictureRow& other,
                               const std::filesystem::path& list);

}  // namespace dibhr
