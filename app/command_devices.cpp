// `dibhr devices`: the mouse, and every Falcon on the USB.
#include "app/command_devices.hpp"

#include <iostream>

#include "device/falcon_scan.hpp"

namespace dibhr {

int run_devices() {
    std::cout
        << "mouse: usable (point at the relief in the viewer, hold the left button to touch)\n";
    const FalconScan scan = scan_falcons();
    for (const AttachedFalcon& falcon : scan.falcons) {
        std::cout << "Novint Falcon "
                  << (falcon.serial.empty() ? "(serial unknown)" : falcon.serial) << " at USB bus "
                  << falcon.bus << " address " << falcon.address
                  << ": cannot be used, this version has no Falcon driver yet; use the mouse";
        if (!falcon.problem.empty()) std::cout << " (" << falcon.problem << ')';
        std::cout << '\n';
    }
    if (!scan.failure.empty()) {
        std::cout << "Novint Falcon: not known whether one is attached, " << scan.failure << '\n';
    } else if (scan.falcons.empty()) {
        std::cout << "Novint Falcon: none attached\n";
    }
    return 0;
}

}  // namespace dibhr
