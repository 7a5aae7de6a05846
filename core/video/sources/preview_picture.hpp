// A frame's colour as a small picture, which a session keeps.
#pragma once

#include <memory>
#include <string>

#include "core/video/frames/colour_image.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

inline constexpr int kWidestPreview = 640;

/// A JPEG file's bytes, at most kWidestPreview columns; empty: the frame has no colour, or it
/// cannot be encoded.
[[nodiscard]] std::string preview_of(const Frame& frame);

/// Such a picture; null: the bytes are none.
[[nodiscard]] std::shared_ptr<const ColourImage> picture_of_preview(const std::string& jpeg);

}  // namespace dibhr
