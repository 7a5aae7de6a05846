// Which Novint Falcons are on the USB; looks, and touches nothing.
#pragma once

#include <string>
#include <vector>

namespace dibhr {

struct AttachedFalcon {
    int bus{0};
    int address{0};
    std::string serial{};   ///< empty: could not be read
    std::string problem{};  ///< why it could not be opened, and what to do; empty: it could
};

struct FalconScan {
    std::vector<AttachedFalcon> falcons{};
    std::string failure{};  ///< why the USB could not be looked at; empty: it could
};

/// Every USB device 0403:cb48. Opens each for a moment to read its serial number; waits for its
/// answer at most a second. Never throws for what the USB does.
[[nodiscard]] FalconScan scan_falcons();

}  // namespace dibhr
