// A USB bus with simulated Falcons for the real libusb in this process: plug, pull, look, and
// break.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/device/falcon/falcon_model.hpp"
#include "tests/device/falcon/usb_bus.hpp"
#include "tests/device/falcon/usbfs_unit.hpp"
#include "tests/support/eventually.hpp"

namespace dibhr::test::falcon {

/// A simulated Falcon, plugged or not.
class Unit {
  public:
    Unit(std::string serial, int port)
        : place_{port, 0}, usbfs_(std::make_shared<UsbfsUnit>(std::move(serial))) {}

    /// Runs `use(FalconModel&)` while the bus stands still; the way to look at it and to break it.
    template <typename Use>
    decltype(auto) with(Use&& use) {
        return usbfs_->wire().with(std::forward<Use>(use));
    }
    void set_faults(const Faults& faults);
    void set_access(UsbAccess access) { usbfs_->set_access(std::move(access)); }
    [[nodiscard]] UsbAccess access() { return usbfs_->access(); }
    void set_realtime(bool realtime) { usbfs_->wire().set_realtime(realtime); }

    [[nodiscard]] const std::string& serial() const noexcept { return usbfs_->serial(); }
    [[nodiscard]] const UsbPlace& place() const noexcept { return place_; }

  private:
    friend class UsbBench;

    UsbPlace place_;
    std::shared_ptr<UsbfsUnit> usbfs_;
    bool plugged_{false};
};

/// One at a time. Every libusb context of this process belongs inside its life: the bus of a later
/// bench is another one.
class UsbBench {
  public:
    UsbBench() = default;
    ~UsbBench();
    UsbBench(const UsbBench&) = delete;
    UsbBench& operator=(const UsbBench&) = delete;

    /// A new unit that nothing is plugged to yet; lives as long as the bench.
    Unit& make(const std::string& serial);
    /// A new unit, plugged, with its power on and no firmware.
    Unit& plug(const std::string& serial = "SIM00001");
    /// Back in, at the next address (or `address`). The board has kept its own power.
    void plug(Unit& unit, int address = 0);
    /// The cable is out, and udev has reported it.
    void unplug(Unit& unit);
    /// The cable is out, and udev has not reported it yet; unplug() may follow.
    static void pull_cable(Unit& unit);

  private:
    UsbBus bus_{};
    std::vector<std::unique_ptr<Unit>> units_{};
    int last_address_{1};
};

using test::eventually;

}  // namespace dibhr::test::falcon
