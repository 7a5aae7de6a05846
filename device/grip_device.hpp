// What every device with a grip does alike, whatever its wire: its tuning goes from the window to
// the tick, and a pose becomes a reading.
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

/// tuning_of(Settings, HandTuning) gives a Tuning, handed whole to the next tick. It has a
/// `workspace`, `clutch_buttons`, `force_off_buttons` and `centred` (with_hand_tuning()); with
/// another felt() the same pose feels otherwise.
template <typename Settings, typename Tuning>
class GripDevice : public ForceDevice {
  public:
    [[nodiscard]] const DeviceSpecification& specification() const noexcept final {
        return specification_;
    }

    /// The haptic thread's, of the last read(): linked, and in an epoch.
    [[nodiscard]] bool in_hand() const noexcept final { return epoch_ != kNoEpoch; }

    // The window thread's end:

    [[nodiscard]] TripleBuffer<Tuning>& tuning() noexcept { return tuning_; }
    [[nodiscard]] bool is_retuned(const DeviceSettings& settings,
                                  const HandTuning& hand) const final {
        return !(published_ == tuning_of(static_cast<const Settings&>(settings), hand));
    }
    void publish(const DeviceSettings& settings, const HandTuning& hand) final {
        published_ = tuning_of(static_cast<const Settings&>(settings), hand);
        tuning_.publish(published_);
    }

  protected:
    explicit GripDevice(DeviceSpecification given) : specification_(std::move(given)) {}

    // The haptic thread's, in this order in each tick:

    /// The newest tuning, for the whole tick.
    void take_tuning() noexcept {
        feels_other_ = false;
        if (!tuning_.fresh()) return;
        const Tuning& newest = tuning_.front();
        if (newest.centred != tuned_.centred) workspace_.centre();
        feels_other_ = !(newest.felt() == tuned_.felt());
        tuned_ = newest;
    }

    /// Of the tick's pose. True: a new one, which starts afresh: the position may have jumped.
    bool take_epoch(Epoch newest) noexcept {
        if (newest == epoch_) return false;
        epoch_ = newest;
        workspace_.centre();
        was_posed_ = false;
        return true;
    }

    /// With `buttons` down and the grip at `grip_mm` (device frame); nothing: no pose that counts.
    /// Before the first pose the goal waits above the middle, higher than everything; later it
    /// stays where it was. `limits`: of the hand, whatever the scale.
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
        reading.taken_over = was_posed_ && (!was_posed || feels_other_);
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

    // The haptic thread's.
    Tuning tuned_{};
    bool feels_other_{false};  // with it than with the one of the tick before
    Epoch epoch_{kNoEpoch};
    Workspace workspace_{};
    std::optional<Vec3> goal_in_grid_{};
    bool may_push_{false};
    bool was_posed_{false};
};

}  // namespace dibhr
