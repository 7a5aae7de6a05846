// A simulated arm below a stand-in for its maker's library, which the program loads as it loads the
// maker's.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

class StandInArm {
  public:
    virtual ~StandInArm() = default;
    StandInArm(const StandInArm&) = delete;
    StandInArm& operator=(const StandInArm&) = delete;

    /// "forcedimension"
    [[nodiscard]] virtual const char* kind() const = 0;
    /// The hand is there, mm from the middle of the workspace: right, and out of the image.
    virtual void place(double right_mm, double out_mm) = 0;
    virtual void press_buttons(unsigned bits) = 0;
    /// Length of the force that the motors give now; the arm's own watchdog counts [N].
    [[nodiscard]] virtual double newton() const = 0;
    /// Of all that it gave [N].
    [[nodiscard]] virtual double strongest_newton() const = 0;
    /// When the program last set a force, on the steady clock.
    [[nodiscard]] virtual std::int64_t set_at_ns() const = 0;
    [[nodiscard]] virtual bool is_open() const = 0;
    [[nodiscard]] virtual bool force_is_on() const = 0;
    /// Calls that the maker's library would not understand.
    [[nodiscard]] virtual int wrong_calls() const = 0;
    /// The device's own watchdog, or none.
    virtual void set_watchdog(bool on) = 0;
    virtual void unplug() = 0;
    /// Another program uses it.
    virtual void occupy() = 0;
    /// It has to be initialised, or calibrated.
    virtual void lose_position() = 0;
    /// The library is of a version that dibhr does not know.
    virtual void age_library() {}

    /// In steps that the program takes up.
    void move_hand(double right_mm, double in_mm, int steps);
    /// Until the motors push back.
    void press();

  protected:
    StandInArm() = default;

  private:
    double right_mm_{0.0};
    double in_mm_{-30.0};
};

/// The stand-in of this kind, before the relief, and a section of the settings file of a program
/// that is started in `folder`, in a window or not. `library`: in place of the stand-in.
[[nodiscard]] std::unique_ptr<StandInArm> make_stand_in(const std::string& kind,
                                                        const TemporaryFolder& folder,
                                                        const std::string& library = {});

}  // namespace dibhr::test
