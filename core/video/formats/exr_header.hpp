// Whether an OpenEXR file's header means what it says, before the library believes it; inside the
// room.
#pragma once

#include <filesystem>

namespace dibhr {

/// Whether every attribute lies in the file and is as long as its type. The library takes memory
/// for what an attribute claims before it reads it, and goes on elsewhere when a length is wrong.
[[nodiscard]] bool has_sound_exr_header(const std::filesystem::path& file);

}  // namespace dibhr
