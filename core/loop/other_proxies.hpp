// The proxies of the algorithms that do not run, side by side: each follows all goals of the loop.
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

/// Identifies a frame that a tick touched. OtherProxies reads its own copy of that frame.
struct FrameMark {
    const DepthImage* depth{nullptr};
    double time_s{0.0};
    const TouchMaps* maps{nullptr};
    const MotionField* motion{nullptr};
    const std::vector<Frame>* in_betweens{nullptr};

    bool operator==(const FrameMark&) const = default;
};

[[nodiscard]] FrameMark mark_of(const Frame& frame) noexcept;

/// A tick's goal and surface, and the proxy after it.
struct WalkedTick {
    std::uint64_t tick{0};
    bool updates{false};  ///< there was a surface and a goal; else all proxies stay where they are
    bool begins{false};   ///< all proxies are reset
    bool releases_contact{false};  ///< a proxy in contact begins anew, above the goal
    TouchParameters parameters{};
    Proxy proxy{};  ///< of the algorithm that ran
    Vec3 goal{0.0};
    FrameMark from{}, to{};
    double blend{0.0};
    SurfaceMotion motion{};        ///< carries the proxy; its field only identifies one
    MaterialPoint material{};      ///< under the proxy after the tick
    const BumpMap* bump{nullptr};  ///< only identifies a map
};

/// One value a tick, while HapticSettings::compare_algorithms is set.
using WalkedTickRing = SpscRing<WalkedTick, 1024>;

/// Runs every tick's goal, over the surface of that tick, through the algorithms that do not run.
/// Their proxies begin at that of the running one, again after ticks that were lost or whose frames
/// are not known. One thread, not the haptic one: it holds frames, and allocates.
class OtherProxies {
  public:
    OtherProxies();

    /// Takes all ticks of the ring. `frames`: published to the ticks' thread as well. `bump`: that
    /// of the next ticks; to be called after each change of it.
    void follow(WalkedTickRing& ring, TripleBuffer<FrameWindow>& frames,
                const std::shared_ptr<const BumpMap>& bump);
    /// Empties the ring and releases all frames.
    void forget(WalkedTickRing& ring);

    /// After the last tick, without the algorithm that runs; empty while they are not known.
    [[nodiscard]] std::vector<AlgorithmProxy> proxies() const;

  private:
    void remember_frames(const FrameWindow& window);
    void walk_tick(const WalkedTick& tick);
    [[nodiscard]] std::optional<DepthSurface> surface_of(const WalkedTick& tick) const;

    struct Walker {
        Algorithm algorithm{Algorithm::dibhr};
        std::unique_ptr<ProxyAlgorithm> walk{};
        Proxy proxy{};  ///< after its last update
    };
    /// Null: the frame was never published, or is dropped already.
    [[nodiscard]] const Frame* frame_of_mark(const FrameMark& mark) const;

    std::vector<Walker> walkers_{};  // of all algorithms: any of them may run next
    std::vector<Frame> frames_{};    // the newest last
    std::array<std::shared_ptr<const BumpMap>, 2> bumps_{};  // the newest first
    std::vector<WalkedTick> batch_{};
    std::uint64_t next_tick_{0};  // the next tick
    Algorithm running_{Algorithm::dibhr};
    bool begun_{false};
};

}  // namespace dibhr
