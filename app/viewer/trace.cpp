// The trace of touch.
#include "app/viewer/trace.hpp"

#include <cmath>
#include <cstddef>

namespace dibhr {

namespace {

constexpr std::size_t kMostDots = 400;  // enough for the fastest stroke

}  // namespace

void TouchTrace::add(const Vec3& proxy, double now_s) {
    if (!is_finite(proxy)) return;
    if (!dots_.empty()) {
        Dot& last = dots_.back();
        if (std::hypot(proxy.x - last.x, proxy.y - last.y) < kApart_px) {
            last.at_s = now_s;
            return;
        }
    }
    dots_.push_back({proxy.x, proxy.y, now_s});
    if (dots_.size() > kMostDots) dots_.pop_front();
}

std::vector<TracePoint> TouchTrace::points(const DepthSurface& surface, double now_s) {
    while (!dots_.empty() && now_s - dots_.front().at_s > kLasts_s) dots_.pop_front();
    std::vector<TracePoint> points;
    points.reserve(dots_.size());
    for (const Dot& dot : dots_) {
        const double left = 1.0 - (now_s - dot.at_s) / kLasts_s;
        points.push_back({{dot.x, dot.y, surface.elevation_at(dot.x, dot.y)}, left});
    }
    return points;
}

void TouchTrace::mark(const DepthSurface& surface, double now_s, TouchMarkers& markers) {
    if (markers.visible && markers.contact) add(markers.proxy, now_s);
    markers.trace = points(surface, now_s);
}

}  // namespace dibhr
