// The steps of the check, in the order of ../README.md, To be measured.
#pragma once

#include <span>

#include "device/falcon/check/desk.hpp"
#include "device/falcon/check/measured.hpp"

namespace dibhr::falcon {

/// What a step needs to make sense.
enum class StepNeeds { nothing, replies, replies_and_person };

struct CheckStep {
    const char* name;     ///< in the record
    const char* title;    ///< for people
    const char* meaning;  ///< what will happen, and what the person does
    StepNeeds needs;
    /// Adds what it measures; throws StepSkipped, PersonQuits, and DeviceError when the Falcon
    /// fails.
    void (*run)(CheckDesk& desk, Measured& measured);
};

[[nodiscard]] std::span<const CheckStep> check_steps() noexcept;

// Each in a file of its own, check_NAME.cpp.
void check_identity(CheckDesk& desk, Measured& measured);
void check_upload(CheckDesk& desk, Measured& measured);
void check_rate(CheckDesk& desk, Measured& measured);
void check_homing(CheckDesk& desk, Measured& measured);
void check_stops(CheckDesk& desk, Measured& measured);
void check_silence(CheckDesk& desk, Measured& measured);
void check_force(CheckDesk& desk, Measured& measured);
void check_buttons(CheckDesk& desk, Measured& measured);
void check_plugs(CheckDesk& desk, Measured& measured);

/// Until all three axes are homed; leads the person through it when they are not.
void home_with_person(CheckDesk& desk, Measured& measured);

}  // namespace dibhr::falcon
