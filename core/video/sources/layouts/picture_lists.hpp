// Reads lists of pictures and their times, as in TUM's RGB-D benchmark: rgb.txt, depth.txt and the
// output of its associate.py; inside the room.
#pragma once

#include <filesystem>
#include <optional>

#include "core/video/sources/layouts/picture_folder.hpp"

namespace dibhr {

/// Whether the file is text of which a line near its beginning is `seconds PICTURE` or `seconds
/// PICTURE seconds PICTURE`.
[[nodiscard]] bool is_picture_list(const std::filesystem::path& file);

/// The pictures of a list in order of time. The words in the list's name, else in the pictures'
/// names, decide colour or depth. Times are seconds where one has a point, else frame numbers.
/// Names are relative to the list's folder. Ignores lines without time and picture, missing
/// pictures and repeated times, and says so in a notice. Depth facts are TUM's: 0.2 mm a level, 0
/// no data, and intrinsics of the camera in a folder's name, which makes them surer. Throws
/// InputError for no picture.
[[nodiscard]] PictureSet read_picture_list(const std::filesystem::path& list);

/// The pictures of the lists in a folder, preferably of an associated list; nothing without a list.
[[nodiscard]] std::optional<PictureSet> read_lists_in(const std::filesystem::path& folder);

}  // namespace dibhr
