// The simulated bus as sysfs, udev and its events show it (umockdev).
#pragma once

#include <umockdev.h>

#include <string>

#include "tests/device/falcon/usb_place.hpp"

namespace dibhr::test::falcon {

/// One bus with its root hub, which all have that are of this class. From the first one on the
/// whole of /sys is this testbed's for the program, and for the programs it starts with
/// libumockdev-preload.so.0 and UMOCKDEV_DIR.
class UsbTestbed {
  public:
    UsbTestbed();

    void add(const UsbPlace& place, const std::string& serial);
    void remove(const UsbPlace& place);

    /// $UMOCKDEV_DIR: holds its sys/ and dev/.
    [[nodiscard]] std::string folder() const;

  private:
    void add_from(const std::string& description);

    UMockdevTestbed* testbed_{nullptr};
};

}  // namespace dibhr::test::falcon
