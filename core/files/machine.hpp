// The machine that a program runs on, in words.
#pragma once

#include <string>

namespace dibhr {

/// What cannot be found out is empty.
struct Machine {
    std::string system{};  ///< "Debian GNU/Linux 12 (bookworm)"
    std::string kernel{};  ///< "Linux 6.1.0 x86_64"
    std::string cpu{};     ///< the processor's model
};

[[nodiscard]] Machine this_machine();

}  // namespace dibhr
