// Sources whose colours are a code for depth, as sources of depth; inside the room.
#pragma once

#include <memory>
#include <string>

#include "core/video/depth/hue_code.hpp"
#include "core/video/formats/picture_source.hpp"

namespace dibhr {

/// The pictures of a source of colours as depth of real numbers: metres where the code says the
/// range, else hue, of which red is near. Not finite: no data. `known_from`: who says so.
[[nodiscard]] std::unique_ptr<PictureSource> hue_decoded(std::unique_ptr<PictureSource> colours,
                                                         HueCode code, std::string known_from);

/// The pictures of such a source as ramp_levels().
[[nodiscard]] std::unique_ptr<PictureSource> ramp_decoded(std::unique_ptr<PictureSource> colours,
                                                          std::string known_from);

}  // namespace dibhr
