// The bus of this process: umockdev's sysfs and udev, and interposed usbfs.
#include "tests/device/falcon/usb_bus.hpp"

#include "tests/device/falcon/usb_testbed.hpp"

namespace dibhr::test::falcon {

struct UsbBus::Implementation {
    UsbTestbed testbed{};
};

UsbBus::UsbBus() : implementation_(std::make_unique<Implementation>()) {}
UsbBus::~UsbBus() = default;

void UsbBus::plug(UsbPlace& place, const std::shared_ptr<UsbfsUnit>& unit) {
    serve_node(place.node(), unit);  // before anyone hears of it
    implementation_->testbed.add(place, unit->serial());
}

void UsbBus::remove(const UsbPlace& place) {
    withdraw_node(place.node());
    implementation_->testbed.remove(place);
}

}  // namespace dibhr::test::falcon
