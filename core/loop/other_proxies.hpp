// Side by side: where the proxies of the other algorithms are, each on its own way after all goals
// of the loop.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/surface_motion.hpp"
#include "core/haptics/vec.hpp"
#include "core/realtime/spsc_ring.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// A frame that a tick touched, to be told from others: whoever follows reads its own.
struct FrameMark {
    const DepthImage* depth{nullptr};
    double time_s{0.0};
    const TouchMaps* maps{nullptr};
    const MotionField* motion{nullptr};
    const std::vector<Frame>* between{nullptr};

    bool operator==(const FrameMark&) const = default;
};

[[nodiscard]] FrameMark mark_of(const Frame& frame) noexcept;

/// What a tick asked of its proxy, over which surface, and where that proxy was after it.
struct WalkedTick {
    std::uint64_t tick{0};
    bool updates{false};  ///< there was a surface and a goal; else all proxies stay where they are
    bool begins{false};   ///< what was touched before is forgotten
    bool lets_go{false};  ///< a proxy in contact begins anew, above the goal
    TouchParameters parameters{};
    Proxy proxy{};  ///< of the algorithm that ran
    Vec3 goal{0.0};
    FrameMark from{}, to{};
    double blend{0.0};
    SurfaceMotion motion{};        ///< what was to carry it; its field is a mark
    MaterialPoint material{};      ///< under it, afterwards
    const BumpMap* bump{nullptr};  ///< a mark, too
};

/// Of each tick one, while somebody follows.
using WalkedTickRing = SpscRing<WalkedTick, 1024>;

/// Walks every tick's goal, over the surface of that tick, through the algorithms that do not run.
/// They begin where the running one's proxy is; again after ticks that were lost, or whose frames
/// are not known. One thread, which is not the haptic one: it holds frames, and allocates.
class OtherProxies {
  public:
    OtherProxies();

    /// Takes all ticks of the ring. `frames` is what their thread was given too; `bump` what the
    /// next ticks get: to be called after each change of it.
    void follow(WalkedTickRing& ring, TripleBuffer<FrameWindow>& frames,
                const std::shared_ptr<const BumpMap>& bump);
    /// Nobody wants to know any more: the ring is emptied, and no frame is held.
    void forget(WalkedTickRing& ring);

    /// After the last tick, but for the algorithm that runs; empty while nothing is known of them.
    [[nodiscard]] std::vector<AlgorithmProxy> proxies() const;

  private:
    void see(const FrameWindow& window);
    void take(const WalkedTick& tick);
    [[nodiscard]] std::optional<DepthSurface> surface_of(const WalkedTick& tick) const;

    struct Walker {
        Algorithm algorithm{Algorithm::dibhr};
        std::unique_ptr<ProxyAlgorithm> walk{};
        Proxy proxy{};  ///< after its last update
    };
    /// Null: it was never seen, or is forgotten.
    [[nodiscard]] const Frame* known(const FrameMark& mark) const;

    std::vector<Walker> walkers_{};  // of all algorithms: any may be the next one that runs
    std::vector<Frame> seen_{};      // the newest last
    std::array<std::shared_ptr<const BumpMap>, 2> bumps_{};  // the newest first
    std::vector<WalkedTick> due_{};
    std::uint64_t awaited_{0};  // the next tick
    Algorithm running_{Algorithm::dibhr};
    bool begun_{false};
};

}  // namespace dibhr
