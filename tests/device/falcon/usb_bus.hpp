// What simulated units are plugged into.
#pragma once

#include <memory>

#include "tests/device/falcon/usb_place.hpp"
#include "tests/device/falcon/usbfs_unit.hpp"

namespace dibhr::test::falcon {

/// Either of this process, with interposed system calls (usb_bus.cpp), or of a real kernel
/// (kernel_bus.cpp): a test program links one of them.
class UsbBus {
  public:
    UsbBus();
    ~UsbBus();
    UsbBus(const UsbBus&) = delete;
    UsbBus& operator=(const UsbBus&) = delete;

    /// `place.address`: the one it is to have; a kernel gives one of its own, which is put there.
    void plug(UsbPlace& place, const std::shared_ptr<UsbfsUnit>& unit);
    /// The cable is out already.
    void remove(const UsbPlace& place);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace dibhr::test::falcon
