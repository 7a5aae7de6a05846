// The pictures of the panes above the relief, as textures.
#pragma once

#include "app/panels/viewer_state.hpp"
#include "core/video/frames/frame_window.hpp"
#include "render/gl_objects.hpp"
#include "render/relief_paint.hpp"

namespace dibhr {

class ViewerPanes {
  public:
    /// Once a picture, before the panels: puts the textures to show into `state`.
    void show(const DepthBlend& shown, ViewerState& state);

  private:
    ColourTexture colour_{};
    ColourTexture depth_{};
    UploadedFrom<void> coloured_{};  ///< what colour_ was made of
    // What depth_picture_ was made of.
    UploadedFrom<DepthImage> painted_{};
    ReliefPaint paint_{};
    std::shared_ptr<const ColourImage> depth_picture_{};
};

}  // namespace dibhr
