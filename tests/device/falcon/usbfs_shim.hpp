// /dev/bus/usb/BBB/DDD of simulated units: open(), ioctl() and close() of the whole program are
// interposed, so that the distribution's own libusb talks to them.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "tests/device/falcon/usb_wire.hpp"

namespace dibhr::test::falcon {

/// Who else may have the unit.
struct UsbAccess {
    int open_errno{0};              ///< EACCES and the like: open() fails with it
    std::string kernel_driver{};    ///< bound to interface 0, until a program detaches it
    bool claimed_elsewhere{false};  ///< another program has claimed interface 0
};

/// A unit as usbfs serves it.
class UsbfsUnit {
  public:
    explicit UsbfsUnit(std::string serial) : serial_(serial), wire_(std::move(serial)) {}

    [[nodiscard]] const std::string& serial() const noexcept { return serial_; }
    [[nodiscard]] UsbWire& wire() noexcept { return wire_; }
    void set_access(UsbAccess access);
    [[nodiscard]] UsbAccess access();

    /// As the system calls: a value of 0 or more, or a negative errno.
    int ioctl(UsbFile& file, unsigned long request, void* argument);
    void close(UsbFile& file);

  private:
    int claim(UsbFile& file, bool detach_driver);
    int use_interface(UsbFile& file);
    int release(UsbFile& file);
    int name_driver(usbdevfs_getdriver& answer);
    int driver_ioctl(const usbdevfs_ioctl& request);

    const std::string serial_;
    UsbWire wire_;
    std::mutex mutex_{};
    UsbAccess access_{};
    UsbFile* claimed_by_{nullptr};
    std::string detached_driver_{};
};

/// From now on `node` ("/dev/bus/usb/001/002") is this unit.
void serve_node(const std::string& node, std::shared_ptr<UsbfsUnit> unit);
/// Whether this thread is inside a system call that is answered here: what it does now would be the
/// kernel's work.
[[nodiscard]] bool in_simulated_kernel() noexcept;
/// The node is gone; files that are open on it stay so.
void withdraw_node(const std::string& node);

}  // namespace dibhr::test::falcon
