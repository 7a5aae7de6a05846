// Makes a tick's input of its row.
#include "core/loop/recorded_run.hpp"

#include <cmath>
#include <utility>

namespace dibhr {

const Touch& RecordedRun::run(const TickRecord& tick, const DepthBlend& frames, const BumpMap* bump,
                              const TouchParameters& touch,
                              const SessionParameters& recorded) noexcept {
    const TickInput input{.pair = frames,
                          .bump = bump,
                          .goal = tick.goal_refused ? Vec3(NAN) : tick.goal,
                          .safety = {.dt_s = tick.dt_s,
                                     .force_enabled = recorded.force_enabled,
                                     .device_ready = tick.device_ready,
                                     .device_force_newton = tick.own_newton,
                                     .from_zero = tick.from_zero,
                                     .standstill = tick.standstill},
                          .releases_contact = tick.releases_contact,
                          .at_once = !tick.gliding,
                          .motion_unknown = tick.motion_unknown};
    const Vec3 before = touch_.proxy.position;
    touch_ = runner_.run(input, {touch, recorded.limits});
    const Proxy& now = touch_.proxy;
    const Vec3& begin = std::exchange(started_, true) ? before : now.position;
    PlaceBox levels = read_box(begin, now.position, touch_.goal, now.moves);
    if (!now.flown.empty()) levels = levels.with(now.flown).wider(now.moves / 2.0);
    read_ = {levels.wider(kNeighbours_px), now.motion_read.wider(kNeighbours_px)};
    return touch_;
}

const Touch& RecordedRun::pause() noexcept {
    touch_ = runner_.pause();
    touch_.proxy.contact = false;
    return touch_;
}

}  // namespace dibhr
