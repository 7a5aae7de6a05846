// One DIBHR update: the surface moved, free flight, and the walk over the primitives.
#include "core/haptics/dibhr.hpp"

#include "core/haptics/surface_walk.hpp"

namespace dibhr {

const Proxy& Dibhr::update(const DepthSurface& surface, Vec3 goal,
                           const Friction& friction) noexcept {
    const Vec3 goal_in_frame = begin_update(surface, goal);
    SurfaceWalk walk(surface, goal_in_frame, friction, proxy_);
    walk.run(most_moves(goal_in_frame));
    return proxy_;
}

}  // namespace dibhr
