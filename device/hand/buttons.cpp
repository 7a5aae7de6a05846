// The grip's buttons without their bounce.
#include "device/hand/buttons.hpp"

#include <utility>

namespace dibhr {

std::uint8_t ButtonDebounce::add(std::uint8_t buttons, Time at) noexcept {
    held_ = std::exchange(begins_, false) ? buttons : static_cast<std::uint8_t>(held_ & buttons);
    for (std::size_t k = 0; k < kDeviceButtonCount; ++k) {
        const auto bit = static_cast<std::uint8_t>(1U << k);
        if (((buttons ^ steady_) & bit) == 0) {
            changing_ = static_cast<std::uint8_t>(changing_ & ~bit);
        } else if ((changing_ & bit) == 0 || at < since_[k]) {
            changing_ = static_cast<std::uint8_t>(changing_ | bit);
            since_[k] = at;
        } else if (at - since_[k] >= kSteady) {
            changing_ = static_cast<std::uint8_t>(changing_ & ~bit);
            steady_ = static_cast<std::uint8_t>(steady_ ^ bit);
            if ((steady_ & ~held_ & bit) == 0) continue;
            ++presses_[k];
            pressed_at_[k] = since_[k];
        }
    }
    return steady_;
}

void ButtonDebounce::release() noexcept {
    steady_ = 0;
    changing_ = 0;
    begins_ = true;
}

}  // namespace dibhr
