// Opens the recording that a command line names.
#pragma once

#include <filesystem>
#include <memory>

#include "app/settings/command_options.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Opens a colour and a depth file, or depth alone, prints warnings about them, and fits relief and
/// pitch in `parameters`. `paints`: see DepthRequest. Throws InputError; with `must_be_sure`, also
/// where the meaning of the depth is not sure.
[[nodiscard]] std::unique_ptr<Media> open_given(const std::filesystem::path& colour,
                                                const std::filesystem::path& depth,
                                                const TouchRequest& touch, bool must_be_sure,
                                                bool paints, TouchParameters& parameters);

}  // namespace dibhr
