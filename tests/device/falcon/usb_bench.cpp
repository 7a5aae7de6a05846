// Units, and the bus they are plugged into.
#include "tests/device/falcon/usb_bench.hpp"

namespace dibhr::test::falcon {

void Unit::set_faults(const Faults& faults) {
    with([&](FalconModel& model) { model.faults = faults; });
}

UsbBench::~UsbBench() {
    for (const auto& unit : units_) {
        if (unit->plugged_) unplug(*unit);
    }
}

Unit& UsbBench::make(const std::string& serial) {
    const int port = static_cast<int>(units_.size()) + 1;
    return *units_.emplace_back(std::make_unique<Unit>(serial, port));
}

Unit& UsbBench::plug(const std::string& serial) {
    Unit& unit = make(serial);
    plug(unit);
    return unit;
}

void UsbBench::plug(Unit& unit, int address) {
    unit.place_.address = address > 0 ? address : last_address_ + 1;
    unit.usbfs_->wire().plug();
    bus_.plug(unit.place_, unit.usbfs_);
    last_address_ = unit.place_.address;
    unit.plugged_ = true;
}

void UsbBench::pull_cable(Unit& unit) {
    unit.usbfs_->wire().unplug();
}

void UsbBench::unplug(Unit& unit) {
    pull_cable(unit);
    bus_.remove(unit.place_);
    unit.plugged_ = false;
}

}  // namespace dibhr::test::falcon
