// The bus of this process: umockdev's sysfs and udev, and interposed usbfs.
#include "tests/device/falcon/usb_bus.hpp"

#include "tests/device/falcon/usb_testbed.hpp"
#include "tests/device/falcon/usbfs_files.hpp"

namespace dibhr::test::falcon {

struct UsbBus::Implementation {
    UsbTestbed testbed{};
};

UsbBus::UsbBus() : implementation_(std::make_unique<Implementation>()) {}
UsbBus::~UsbBus() = default;

void UsbBus::plug(UsbPlace& place, const std::shared_ptr<UsbfsUnit>& unit) {
    own_files().serve(place.node(), unit);  // before anyone hears of it
    implementation_->testbed.add(place, unit->serial());
}

void UsbBus::remove(const UsbPlace& place) {
    own_files().withdraw(place.node());
    implementation_->testbed.remove(place);
}

}  // namespace dibhr::test::falcon
