// A simulated unit as usbfs serves it: claims, transfers in memory of its own, errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "tests/device/falcon/usb_wire.hpp"

namespace dibhr::test::falcon {

/// Who else may have the unit.
struct UsbAccess {
    int open_errno{0};              ///< EACCES and the like: open() fails with it
    std::string kernel_driver{};    ///< bound to interface 0, until a program detaches it
    bool claimed_elsewhere{false};  ///< another program has claimed interface 0
};

/// A program's transfer in memory of its own, as a kernel keeps it: the program may die, or free
/// what it gave.
struct UsbfsUrb {
    std::uintptr_t id{0};  ///< the program's own usbdevfs_urb
    std::vector<std::uint8_t> bytes{};
    usbdevfs_urb urb{};

    /// How many of the bytes the program gets back: those that came to the host.
    [[nodiscard]] std::size_t bytes_back() const noexcept;
};

/// What one open file of a program has.
struct UsbfsFile {
    UsbFile on_bus{};
    std::list<UsbfsUrb> urbs{};
};

/// Thread-safe.
class UsbfsUnit {
  public:
    explicit UsbfsUnit(std::string serial) : serial_(serial), wire_(std::move(serial)) {}

    [[nodiscard]] const std::string& serial() const noexcept { return serial_; }
    [[nodiscard]] UsbWire& wire() noexcept { return wire_; }
    void set_access(UsbAccess access);
    [[nodiscard]] UsbAccess access();

    // As the system calls: a value of 0 or more, or a negative errno.

    int open(UsbfsFile& file);
    int submit(UsbfsFile& file, const usbdevfs_urb& urb, std::uintptr_t id);
    int discard(UsbfsFile& file, std::uintptr_t id);
    int reap(UsbfsFile& file, UsbfsUrb& ended);
    int bulk(UsbfsFile& file, const usbdevfs_bulktransfer& transfer);
    /// Every other request.
    int ioctl(UsbfsFile& file, unsigned long request, void* argument);
    void close(UsbfsFile& file);

  private:
    int claim(UsbfsFile& file, bool detach_driver);
    int use_interface(UsbfsFile& file);
    int release(UsbfsFile& file);
    int name_driver(usbdevfs_getdriver& answer);
    int driver_ioctl(const usbdevfs_ioctl& request);

    const std::string serial_;
    UsbWire wire_;
    std::mutex mutex_{};  // of the files' lists, too
    UsbAccess access_{};
    UsbfsFile* claimed_by_{nullptr};
    std::string detached_driver_{};
};

}  // namespace dibhr::test::falcon
