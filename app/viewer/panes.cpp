// Uploads what the panes above the relief show.
#include "app/viewer/panes.hpp"

#include "app/panels/panels.hpp"

namespace dibhr {

namespace {

constexpr int kMostOfPane_px = 1024;  // side of a texture: a pane is not much larger

}  // namespace

void ViewerPanes::show(const DepthBlend& shown, ViewerState& state) {
    state.ui.panes = {};
    if (!shows_panes(state) || !shown.makes_surface()) return;
    const Frame& frame = shown.colour_frame();
    if (frame.has_colour() && !coloured_.is(frame.colour_object())) {
        colour_.show(frame.rgb(), kMostOfPane_px, false);
        coloured_.set(frame.colour_object());
    }
    if (frame.has_colour()) state.ui.panes.colour = colour_.name();
    const ReliefPaint paint = depth_paint(state);
    if (!painted_.is(frame.drawn()) || paint != paint_) {
        depth_picture_ = depth_picture(*frame.drawn(), frame.unseen.get(), paint, kMostOfPane_px);
        painted_.set(frame.drawn());
        paint_ = paint;
    }
    state.ui.panes.depth = depth_.show(depth_picture_, kMostOfPane_px, false);
}

}  // namespace dibhr
