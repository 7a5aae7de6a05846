// What is known of each type of arm. No call of the library tells what force an arm can give.
#pragma once

#include <string>

#include "core/haptics/safety.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr::forcedimension {

struct ArmModel {
    int type;             ///< the library's number
    const char* name;     ///< "omega.3"
    double force_newton;  ///< nominal: README.md, Numbers
    double radius_mm;     ///< of the workspace
    Vec3 centre_m{0.0};   ///< of the workspace, the arm's axes
};

/// The model of this type, or one with low limits for a type that is not known.
[[nodiscard]] const ArmModel& model_of(int type) noexcept;

/// The type is in the table.
[[nodiscard]] bool is_known(int type) noexcept;

/// The n-th type of the table, for opening by type; 0: there are no more.
[[nodiscard]] int known_type(std::size_t n) noexcept;

/// "omega.3", "Force Dimension type 210".
[[nodiscard]] std::string name_of_type(int type);

/// Limits and assumed dynamics of a model, hand millimetres. **Mass, friction and delay are
/// nominal, not measured.**
[[nodiscard]] DeviceLimits limits_of(const ArmModel& model) noexcept;

/// Limits of the strongest model.
[[nodiscard]] DeviceLimits strongest_limits() noexcept;

}  // namespace dibhr::forcedimension
