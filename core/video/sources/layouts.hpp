// Which of the files that people keep together are colour and depth, and what their layout says of
// the depth: folders of pictures or videos, lists, patterns of names; inside the room.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/video/sources/picture_folder.hpp"

namespace dibhr {

struct Sources;

/// Whether pictures are found there: by a folder, a list, or a pattern of names.
[[nodiscard]] bool names_pictures(const std::filesystem::path& place);

/// The pictures there, and what the conventions of TUM, 7-Scenes, ScanNet and Open3D say of their
/// depth where the files are laid out as these do it. Throws InputError.
[[nodiscard]] PictureSet pictures_at(const std::filesystem::path& place);

/// The pictures of that role there, or those whose names say nothing, one after the other. Throws
/// InputError when there are none.
[[nodiscard]] std::unique_ptr<PictureSource> open_row(const std::filesystem::path& place,
                                                      PictureRole role);

/// Colour and depth that belong together: of one place, without depth where it does not hold both,
/// or of two. Throws InputError.
[[nodiscard]] Sources both_rows(const std::filesystem::path& place);
[[nodiscard]] Sources rows_of_two(const std::filesystem::path& colour,
                                  const std::filesystem::path& depth);

/// The files or folders to open, and a sentence where they are not simply what was given.
struct MediaPlaces {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
    std::string notice{};
};

/// For a colour and a depth place as they were given: the other way round where both names say so;
/// and of a folder that holds videos, those of colour and depth that belong together, the first
/// where there are several. Throws InputError when a folder cannot be read.
[[nodiscard]] MediaPlaces places_for(const std::filesystem::path& colour,
                                     const std::filesystem::path& depth);

/// The depth video that a folder holds, by the same rule, or by its name alone, or as its only
/// video; else the place itself.
[[nodiscard]] std::filesystem::path depth_place_for(const std::filesystem::path& place);

}  // namespace dibhr
