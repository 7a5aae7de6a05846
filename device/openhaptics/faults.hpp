// The errors that the library reports: their classes and their sentences.
#pragma once

#include <string>

#include "device/openhaptics/hd.hpp"

namespace dibhr::openhaptics {

enum class FaultClass {
    none,
    force,  ///< the device cut the force, the link goes on
    call,   ///< a call was refused
    link    ///< the link has ended
};

struct Fault {
    FaultClass kind{FaultClass::none};
    unsigned int code{kHdSuccess};
    int internal_code{0};
};

/// Unknown codes end the link.
[[nodiscard]] FaultClass class_of(unsigned int code) noexcept;
/// The errors on the library's stack, newest first: the gravest one, the newest of these. Leaves
/// the stack empty. Does not allocate.
[[nodiscard]] Fault take_faults(const HdLibrary& library) noexcept;
/// "communication error 0x302 (-28)".
[[nodiscard]] std::string name_of(const Fault& fault);

/// Why no device could be opened, and the next step. `name`: as requested; empty: the default one.
[[nodiscard]] std::string why_not_opened(const Fault& fault, const std::string& name);
/// Why an open device was lost, and the next step.
[[nodiscard]] std::string why_lost(const Fault& fault);

}  // namespace dibhr::openhaptics
