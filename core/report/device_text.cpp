// How a session's device is named: with how much of it was another's.
#include "core/report/device_text.hpp"

#include <algorithm>

#include "core/report/report_words.hpp"

namespace dibhr {

std::string device_text(const std::string& device, const HandTicks& hand) {
    if (hand.stand_in <= 0) return device;
    if (hand.stand_in >= hand.all) return device + "; the mouse stood in for all of it";
    constexpr double kLeast = 0.1;  // percent; not none, and not all
    const double percent =
        100.0 * static_cast<double>(hand.stand_in) / static_cast<double>(hand.all);
    return device + "; the mouse stood in for " +
           decimals(std::clamp(percent, kLeast, 100.0 - kLeast), 1) + " % of the ticks";
}

}  // namespace dibhr
