// Faults by name, for the control socket.
#include "tests/device/falcon/faults.hpp"

#include <array>
#include <utility>

namespace dibhr::test::falcon {

namespace {

constexpr std::array kNames{
    std::pair{"leading_zero", &Faults::leading_zero},
    std::pair{"leading_13", &Faults::leading_13},
    std::pair{"ignored_hellos", &Faults::ignored_hellos},
    std::pair{"ignored_autobaud", &Faults::ignored_autobaud},
    std::pair{"corrupt_echo", &Faults::corrupt_echo},
    std::pair{"stop_echo", &Faults::stop_echo},
    std::pair{"echo_fault_at", &Faults::echo_fault_at},
    std::pair{"dropped_replies", &Faults::dropped_replies},
    std::pair{"lost_to_overrun", &Faults::lost_to_overrun},
    std::pair{"lost_halves", &Faults::lost_halves},
    std::pair{"garbage_before", &Faults::garbage_before},
    std::pair{"garbage_inside", &Faults::garbage_inside},
    std::pair{"merged_replies", &Faults::merged_replies},
    std::pair{"split_to", &Faults::split_to},
    std::pair{"stalled_reads", &Faults::stalled_reads},
    std::pair{"frozen_in", &Faults::frozen_in},
    std::pair{"frozen_out", &Faults::frozen_out},
    std::pair{"frozen_control", &Faults::frozen_control},
};

}  // namespace

bool strikes(int& left) noexcept {
    if (left <= 0) return false;
    if (left != kForEver) --left;
    return true;
}

bool set_fault(Faults& faults, std::string_view name, int value) noexcept {
    for (const auto& [known, member] : kNames) {
        if (name == known) {
            faults.*member = value;
            return true;
        }
    }
    return false;
}

}  // namespace dibhr::test::falcon
