// The common part of all devices with a grip: the window thread publishes the tuning to the tick,
// and the tick makes a reading from a pose and the buttons.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "core/haptics/safety.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "device/force_device.hpp"
#include "device/hand/epoch.hpp"
#include "device/hand/workspace.hpp"

namespace dibhr {

/// tuning_of(Settings, HandTuning) makes a Tuning, which the next tick takes as a whole. A Tuning
/// has `workspace`, `clutch_buttons`, `force_off_buttons` and `centre_count` (with_hand_tuning()),
/// and rendered_values(): its values that change the goal or the force of a pose.
template <typename Settings, typename Tuning>
class GripDevice : public ForceDevice {
  public:
    [[nodiscard]] const DeviceSpecification& specification() const noexcept final {
        return specification_;
    }

    /// For the haptic thread, as of the last read(): linked and ready, a Falcon also homed.
    [[nodiscard]] bool can_touch() const noexcept final { return epoch_ != kNoEpoch; }

    // For the window thread:

    [[nodiscard]] TripleBuffer<Tuning>& tuning() noexcept { return tuning_; }
    [[nodiscard]] bool has_new_tuning(const DeviceSettings& settings,
                                      const HandTuning& hand) const final {
        return !(published_ == tuning_of(static_cast<const Settings&>(settings), hand));
    }
    void publish(const DeviceSettings& settings, const HandTuning& hand) final {
        published_ = tuning_of(static_cast<const Settings&>(settings), hand);
        tuning_.publish(published_);
    }

  protected:
    explicit GripDevice(DeviceSpecification given) : specification_(std::move(given)) {}

    // For the haptic thread, called in this order in each tick:

    /// Takes the newest tuning, which is constant during the tick.
    void take_tuning() noexcept {
        rendering_changed_ = false;
        if (!tuning_.fresh()) return;
        const Tuning& newest = tuning_.front();
        if (newest.centre_count != tuned_.centre_count) workspace_.centre();
        rendering_changed_ = !(newest.rendered_values() == tuned_.rendered_values());
        tuned_ = newest;
    }

    /// Takes the epoch of the newest pose. A new epoch drops the state of the last one, because the
    /// position may have jumped; returns whether the epoch is new.
    bool take_epoch(Epoch newest) noexcept {
        if (newest == epoch_) return false;
        epoch_ = newest;
        workspace_.centre();
        was_posed_ = false;
        return true;
    }

    /// The reading of a grip at `grip_mm` (device frame; nothing: no valid pose) with these buttons
    /// pressed. Before the first pose the goal is above the middle of the image, higher than the
    /// relief; without a pose it stays. `limits`: of the device, in hand millimetres.
    [[nodiscard]] HandReading reading_at(std::optional<Vec3> grip_mm, std::uint8_t buttons,
                                         const DeviceLimits& limits,
                                         const HandContext& context) noexcept {
        const bool clutched = (buttons & tuned_.clutch_buttons) != 0;
        if (grip_mm) {
            const ImageFrame image = image_frame(context.surface, context.pixel_pitch_mm);
            goal_in_grid_ = workspace_.goal_in_grid(*grip_mm, clutched, image, tuned_.workspace);
        }
        const bool was_posed = std::exchange(was_posed_, grip_mm.has_value());
        may_push_ = was_posed_ && !clutched;
        HandReading reading;
        reading.goal_in_grid = goal_in_grid_.value_or(above_image(context.surface));
        reading.buttons = buttons;
        reading.ready = may_push_;
        reading.hand_changed = was_posed_ && (!was_posed || rendering_changed_);
        reading.force_off = (buttons & tuned_.force_off_buttons) != 0;
        reading.limits = at_scale(limits, tuned_.workspace.scale);
        return reading;
    }

    [[nodiscard]] const Tuning& tuned() const noexcept { return tuned_; }
    [[nodiscard]] Epoch epoch() const noexcept { return epoch_; }
    /// The last reading was ready.
    [[nodiscard]] bool may_push() const noexcept { return may_push_; }

  private:
    DeviceSpecification specification_;
    Tuning published_{};
    TripleBuffer<Tuning> tuning_{};

    // Used by the haptic thread only.
    Tuning tuned_{};
    bool rendering_changed_{false};  // the last take_tuning() changed rendered_values()
    Epoch epoch_{kNoEpoch};
    Workspace workspace_{};
    std::optional<Vec3> goal_in_grid_{};
    bool may_push_{false};
    bool was_posed_{false};
};

}  // namespace dibhr
