// Finds colour and depth in files that belong together, and what their layout says about the
// depth: folders of pictures or videos, lists, patterns of names; inside the room.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/video/sources/layouts/picture_folder.hpp"

namespace dibhr {

struct Sources;

/// Whether the place is a folder, a list, or a pattern of names.
[[nodiscard]] bool names_pictures(const std::filesystem::path& place);

/// The pictures there; where their layout is that of TUM, 7-Scenes, ScanNet, Open3D or a scanner
/// app, also the facts that these conventions state about depth. Throws InputError.
[[nodiscard]] PictureSet pictures_at(const std::filesystem::path& place);

/// The pictures of that role, or those whose names state no role, in order. Throws InputError when
/// there are none.
[[nodiscard]] std::unique_ptr<PictureSource> open_row(const std::filesystem::path& place,
                                                      PictureRole role);

/// Colour and depth that belong together, of one place or of two. Without depth where one place
/// does not hold both. Throws InputError.
[[nodiscard]] Sources both_rows(const std::filesystem::path& place);
[[nodiscard]] Sources rows_of_two(const std::filesystem::path& colour,
                                  const std::filesystem::path& depth);

/// Adds the camera, and what a level is, that a file beside the depth states and nothing else does
/// yet; a notice where the camera is not that of the pictures.
void add_camera_beside(Sources& sources);

/// The files or folders to open, and a sentence where they differ from those given.
struct MediaPlaces {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
    std::string notice{};
};

/// Finds the places for the given ones: exchanged where both names say so; numbers instead of a
/// picture that paints them; of a folder with videos the colour and depth video that belong
/// together, the first pair of several; of a scanner app's the video and the folder of depth.
/// Throws InputError when a folder cannot be read.
[[nodiscard]] MediaPlaces places_for(const std::filesystem::path& colour,
                                     const std::filesystem::path& depth);

/// The depth video of a folder: of the first pair, else the one named depth, else the only video.
/// Without such a video, the place itself.
[[nodiscard]] std::filesystem::path depth_place_for(const std::filesystem::path& place);

}  // namespace dibhr
