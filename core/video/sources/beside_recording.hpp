// Names of the files that belong to a recording and lie beside its depth: maps, regions, captions.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

/// The file with that ending beside the depth of a recording. For "_friction.png": of cup_depth.mp4
/// cup_friction.png, of depth.mp4 depth_friction.png, of the folder take/ take_friction.png. An
/// existing file with the whole name, "cup_depth_friction.png", comes first.
[[nodiscard]] std::filesystem::path beside_recording(const std::filesystem::path& depth,
                                                     const std::string& ending);

}  // namespace dibhr
