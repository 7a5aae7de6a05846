// The continuation of what is behind under the near faces.
#pragma once

#include "render/face_colour.hpp"
#include "render/silhouette_rims.hpp"

namespace dibhr {

/// Continues the far faces of the rims under the near ones, as far as they can be seen: adds rims
/// there, with elevations and colours, and evens both out.
void fill_under(Rims& rims, const FaceColour& colours);

}  // namespace dibhr
