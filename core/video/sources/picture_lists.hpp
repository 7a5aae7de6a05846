// Lists of pictures and their times, as TUM's RGB-D benchmark has them: rgb.txt, depth.txt and what
// its associate.py makes of them; inside the room.
#pragma once

#include <filesystem>
#include <optional>

#include "core/video/sources/picture_folder.hpp"

namespace dibhr {

/// Whether the file is text of which a line near its beginning is `seconds PICTURE` or `seconds
/// PICTURE seconds PICTURE`.
[[nodiscard]] bool is_picture_list(const std::filesystem::path& file);

/// The pictures of a list, told apart by the words in the name of the list, or else in their own,
/// by time: seconds where one has a point, else the numbers of frames. Names are relative to the
/// list's folder. Lines that name no picture at a time, missing pictures and repeated times are
/// passed over and told. What is known is TUM's: 0.2 mm a level, 0 no data, and the intrinsics of
/// its cameras where a folder's name says which. Throws InputError when no picture is left.
[[nodiscard]] PictureSet read_picture_list(const std::filesystem::path& list);

/// Those of the lists in a folder, the associated ones first; nothing when it has none.
[[nodiscard]] std::optional<PictureSet> read_lists_in(const std::filesystem::path& folder);

}  // namespace dibhr
