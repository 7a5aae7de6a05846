// The other algorithms' proxies, tick by tick.
#include "core/loop/other_proxies.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/haptics/touch.hpp"

namespace dibhr {

namespace {

/// The frames of the ticks since the last call, and the present ones.
constexpr std::size_t kMostSeen = 3 * FrameWindow::kFrames;

}  // namespace

FrameMark mark_of(const Frame& frame) noexcept {
    return {frame.depth.get(), frame.time_s, frame.maps.get(), frame.motion.get(),
            frame.between.get()};
}

OtherProxies::OtherProxies() {
    for (const Algorithm algorithm : all_algorithms())
        walkers_.push_back({algorithm, make_algorithm(algorithm), {}});
    due_.reserve(WalkedTickRing::room());
}

void OtherProxies::follow(WalkedTickRing& ring, TripleBuffer<FrameWindow>& frames,
                          const std::shared_ptr<const BumpMap>& bump) {
    due_.clear();
    for (WalkedTick tick; due_.size() < WalkedTickRing::room() && ring.pop(tick);)
        due_.push_back(tick);
    see(frames.front());  // after the ticks: their frames were published before
    if (bump != bumps_.front()) bumps_ = {bump, std::move(bumps_.front())};
    for (const WalkedTick& tick : due_) take(tick);
}

void OtherProxies::forget(WalkedTickRing& ring) {
    for (WalkedTick tick; ring.pop(tick);) continue;
    seen_.clear();
    bumps_ = {};
    begun_ = false;
}

void OtherProxies::see(const FrameWindow& window) {
    for (std::size_t k = 0; k < std::min(window.count, FrameWindow::kFrames); ++k) {
        const Frame& frame = window.frames[k];
        if (frame.depth && known(mark_of(frame)) == nullptr) seen_.push_back(frame);
    }
    if (seen_.size() > kMostSeen)
        seen_.erase(seen_.begin(),
                    seen_.begin() + static_cast<std::ptrdiff_t>(seen_.size() - kMostSeen));
}

const Frame* OtherProxies::known(const FrameMark& mark) const {
    const auto found = std::ranges::find(seen_, mark, mark_of);
    return found == seen_.end() ? nullptr : &*found;
}

std::optional<DepthSurface> OtherProxies::surface_of(const WalkedTick& tick) const {
    const Frame* const from = known(tick.from);
    const Frame* const to = known(tick.to);
    const auto is_its = [&tick](const auto& bump) { return bump.get() == tick.bump; };
    const bool knows_bump = tick.bump == nullptr || std::ranges::any_of(bumps_, is_its);
    if (from == nullptr || to == nullptr || !knows_bump) return std::nullopt;
    return DepthBlend{from, to, tick.blend}.surface(tick.parameters.shape, tick.bump);
}

void OtherProxies::take(const WalkedTick& tick) {
    if (tick.tick != awaited_) begun_ = false;
    awaited_ = tick.tick + 1;
    running_ = tick.parameters.algorithm;
    for (Walker& walker : walkers_)
        if (tick.begins || (tick.lets_go && walker.proxy.contact)) walker.walk->reset();
    if (!tick.updates) return;
    const std::optional<DepthSurface> surface = surface_of(tick);
    begun_ = (begun_ || tick.begins) && surface.has_value();
    if (!surface) return;
    for (Walker& walker : walkers_) {
        if (begun_ && walker.algorithm != running_) {
            const Friction friction =
                felt_friction(*surface, walker.proxy, tick.goal, tick.parameters.friction);
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
