// A device that moves the goal: a force device, the mouse's virtual hand, or recorded goals.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// A device's abilities as data.
struct DeviceSpecification {
    std::string name{};  ///< "mouse", "goals:FILE", "Novint Falcon (serial)"
    DeviceLimits limits{};
    Vec3 workspace_mm{101.6};  ///< extents of the reachable volume; a Falcon's are 4 inches
};

/// The mouse's hand has no motors: its limits are the highest values that people can set
/// (touch_numbers() of core/haptics). It is stable by itself in ticks of up to 10 ms, at 2 N/mm up
/// to 20 ms, and needs no stability control.
inline constexpr DeviceLimits kVirtualHandLimits{.max_stiffness_newton_per_mm = 10.0,
                                                 .max_damping_newton_s_per_m = 100.0};

/// The tick in which a device is read.
struct HandContext {
    double dt_s{0.001};
    const DepthSurface& surface;
    double pixel_pitch_mm{kPaperPitch_mm};
    std::optional<Vec3> contact{};  ///< the proxy's place in the last tick; nothing: no contact
};

/// One reading, already in grid space: a device's own millimetres stay in `device`.
struct HandReading {
    Vec3 goal_in_grid{0.0};
    std::uint8_t buttons{0};  ///< bit 0: the main button; a Falcon's: plus, forward, centre, minus
    bool ready{true};         ///< attached, homed, and giving poses; false: no force
    bool lifted{false};       ///< taken off the surface: a contact is released
    bool hand_changed{
        false};             ///< another hand than in the last reading: the force begins from zero
    bool harmless{false};   ///< it has no motors: the mouse
    bool force_off{false};  ///< a button that takes the force off is down
    bool mouse_fallback{false};     ///< the mouse, while the requested device is not ready
    std::uint8_t device_number{0};  ///< number of the device among several, from 1; 0: the mouse
    /// What this hand can stand now, where it differs from the specification: another scale, or
    /// another hand.
    std::optional<DeviceLimits> limits{};
    /// The device's own force on the hand, such as its soft boundary [N], axes of grid space.
    Vec3 own_force_newton{0.0};
};

/// Read once and sent to once a tick, by the haptic thread alone. No call allocates, locks or
/// throws.
class Device {
  public:
    virtual ~Device() = default;
    [[nodiscard]] virtual const DeviceSpecification& specification() const noexcept = 0;
    /// The hand's reading while there is no surface.
    [[nodiscard]] virtual HandReading reading_without_surface() const noexcept {
        return {.ready = false};
    }
    virtual HandReading read(const HandContext& context) noexcept = 0;
    /// Whether the hand of the last reading stands still without touching, and needs no tick a
    /// millisecond until it moves.
    [[nodiscard]] virtual bool rests() const noexcept { return false; }
    /// Force on the hand [N], axes of grid space.
    virtual void send(Vec3 force_newton) noexcept = 0;
};

}  // namespace dibhr
