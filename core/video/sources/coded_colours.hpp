// Finds out whether the colours of a depth hold numbers, and decodes them; inside the room.
#pragma once

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/sources/packed.hpp"
#include "core/video/sources/picture_kind.hpp"
#include "core/video/sources/readers.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

/// What the colours of a depth hold; grey where it has none.
struct ColoursOfDepth {
    PictureKind kind{PictureKind::grey_depth};
    DepthCode bytes{DepthCode::grey};  ///< for byte_depth
};

/// `halves`: the depth is a half of the place's pictures, null: it is all.
[[nodiscard]] ColoursOfDepth colours_of_depth(const KnownPlace& place, Sources& sources,
                                              const PackedForm* halves = nullptr);

/// Keeps the refusal of depth in colours; `halves` likewise.
void refuse_colours(const KnownPlace& place, const PackedForm* halves, Sources& sources);

/// Decodes depth coded as colours: as the statement says, else as the pictures look.
[[nodiscard]] Sources with_decoded_colours(const KnownPlace& place, Sources sources,
                                           const DepthStatement& statement);

}  // namespace dibhr
