// What the system says of devices on the USB.
#include "device/forcedimension/usb_bus.hpp"

namespace dibhr::forcedimension {

UsbBus read_usb_bus(const std::filesystem::path& devices) {
    UsbBus bus;
    for (const UsbDevice& device : listed_usb_devices(devices)) {
        if (device.maker == "0403" && device.product == "cb48") bus.has_falcon = true;
        if (device.maker != "1451") continue;
        bus.has_arm = true;
        if (!device.may_open()) bus.refused_node = device.node;
    }
    return bus;
}

}  // namespace dibhr::forcedimension
