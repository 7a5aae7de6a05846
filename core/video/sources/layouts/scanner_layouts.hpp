// The folders that scanner apps of phones export, and what they say about depth: which names are
// colour and depth, and where the camera is; inside the room.
#pragma once

#include <filesystem>
#include <optional>

#include "core/video/sources/layouts/picture_folder.hpp"

namespace dibhr {

/// A folder that an app exported. Its masks and confidence are in neither row.
struct ScannerFolder {
    std::filesystem::path film{};         ///< of colour, beside a folder of depth; empty: pictures
    std::filesystem::path depth_place{};  ///< the folder of depth pictures
    PictureSet pictures{};                ///< with the facts of the layout
};

/// Nothing where the folder has no such layout. Throws InputError when it cannot be read.
[[nodiscard]] std::optional<ScannerFolder> scanner_folder(const std::filesystem::path& folder);

/// The facts about a folder of depth that is part of such a layout; else none.
[[nodiscard]] LayoutFacts scanner_facts(const std::filesystem::path& depth_folder);

}  // namespace dibhr
