// The other algorithms' proxies, tick by tick.
#include "core/loop/other_proxies.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/haptics/touch.hpp"

namespace dibhr {

namespace {

/// The frames of the ticks since the last call, and the present ones.
constexpr std::size_t kMostFrames = 3 * FrameWindow::kFrames;

}  // namespace

FrameMark mark_of(const Frame& frame) noexcept {
    return {frame.depth.get(), frame.time_s, frame.maps.get(), frame.motion.get(),
            frame.in_betweens.get()};
}

OtherProxies::OtherProxies() {
    for (const Algorithm algorithm : all_algorithms())
        walkers_.push_back({algorithm, make_algorithm(algorithm), {}});
    batch_.reserve(WalkedTickRing::room());
}

void OtherProxies::follow(WalkedTickRing& ring, TripleBuffer<FrameWindow>& frames,
                          const std::shared_ptr<const BumpMap>& bump) {
    batch_.clear();
    for (WalkedTick tick; batch_.size() < WalkedTickRing::room() && ring.pop(tick);)
        batch_.push_back(tick);
    remember_frames(frames.front());  // after the ticks: their frames were published before
    if (bump != bumps_.front()) bumps_ = {bump, std::move(bumps_.front())};
    for (const WalkedTick& tick : batch_) walk_tick(tick);
}

void OtherProxies::forget(WalkedTickRing& ring) {
    for (WalkedTick tick; ring.pop(tick);) continue;
    frames_.clear();
    bumps_ = {};
    begun_ = false;
}

void OtherProxies::remember_frames(const FrameWindow& window) {
    for (std::size_t k = 0; k < std::min(window.count, FrameWindow::kFrames); ++k) {
        const Frame& frame = window.frames[k];
        if (frame.depth && frame_of_mark(mark_of(frame)) == nullptr) frames_.push_back(frame);
    }
    if (frames_.size() > kMostFrames)
        frames_.erase(frames_.begin(),
                      frames_.begin() + static_cast<std::ptrdiff_t>(frames_.size() - kMostFrames));
}

const Frame* OtherProxies::frame_of_mark(const FrameMark& mark) const {
    const auto found = std::ranges::find(frames_, mark, mark_of);
    return found == frames_.end() ? nullptr : &*found;
}

std::optional<DepthSurface> OtherProxies::surface_of(const WalkedTick& tick) const {
    const Frame* const from = frame_of_mark(tick.from);
    const Frame* const to = frame_of_mark(tick.to);
    const auto is_its = [&tick](const auto& bump) { return bump.get() == tick.bump; };
    const bool knows_bump = tick.bump == nullptr || std::ranges::any_of(bumps_, is_its);
    if (from == nullptr || to == nullptr || !knows_bump) return std::nullopt;
    return DepthBlend{from, to, tick.blend}.surface(tick.parameters.shape, tick.bump);
}

void OtherProxies::walk_tick(const WalkedTick& tick) {
    if (tick.tick != next_tick_) begun_ = false;
    next_tick_ = tick.tick + 1;
    running_ = tick.parameters.algorithm;
    for (Walker& walker : walkers_)
        if (tick.begins || (tick.releases_contact && walker.proxy.contact)) walker.walk->reset();
    if (!tick.updates) return;
    const std::optional<DepthSurface> surface = surface_of(tick);
    begun_ = (begun_ || tick.begins) && surface.has_value();
    if (!surface) return;
    for (Walker& walker : walkers_) {
        if (begun_ && walker.algorithm != running_) {
            const Friction friction =
                local_friction(*surface, walker.proxy, tick.goal, tick.parameters.friction);
            walker.proxy = walker.walk->update(*surface, tick.goal, friction, tick.motion);
        } else {
            walker.walk->resume(tick.proxy, surface->columns(), surface->rows(), tick.material);
            walker.proxy = tick.proxy;
        }
    }
    begun_ = true;
}

std::vector<AlgorithmProxy> OtherProxies::proxies() const {
    std::vector<AlgorithmProxy> others;
    if (!begun_) return others;
    for (const Walker& walker : walkers_)
        if (walker.algorithm != running_) others.push_back({walker.algorithm, walker.proxy});
    return others;
}

}  // namespace dibhr
