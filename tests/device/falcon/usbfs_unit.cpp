// The usbfs ioctls that libusb uses, and whose the interface is.
#include <linux/ioctl.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "tests/device/falcon/usbfs_shim.hpp"

namespace dibhr::test::falcon {

void UsbfsUnit::set_access(UsbAccess access) {
    const std::lock_guard lock(mutex_);
    access_ = std::move(access);
}

UsbAccess UsbfsUnit::access() {
    const std::lock_guard lock(mutex_);
    return access_;
}

int UsbfsUnit::ioctl(UsbFile& file, unsigned long request, void* argument) {
    switch (request) {
        case USBDEVFS_GET_CAPABILITIES:
            *static_cast<std::uint32_t*>(argument) = USBDEVFS_CAP_ZERO_PACKET |
                                                     USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                                     USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
            return 0;
        case USBDEVFS_CLAIMINTERFACE:
            return claim(file, false);
        case USBDEVFS_DISCONNECT_CLAIM:
            return claim(file, true);
        case USBDEVFS_RELEASEINTERFACE:
            return release(file);
        case USBDEVFS_GETDRIVER:
            return name_driver(*static_cast<usbdevfs_getdriver*>(argument));
        case USBDEVFS_IOCTL:
            return driver_ioctl(*static_cast<usbdevfs_ioctl*>(argument));
        case USBDEVFS_SUBMITURB: {
            auto* urb = static_cast<usbdevfs_urb*>(argument);
            const int refused = urb->type == USBDEVFS_URB_TYPE_CONTROL ? 0 : use_interface(file);
            return refused != 0 ? refused : wire_.submit(file, urb);
        }
        case USBDEVFS_DISCARDURB:
            return wire_.discard(file, static_cast<usbdevfs_urb*>(argument));
        case USBDEVFS_REAPURBNDELAY: {
            usbdevfs_urb* urb = nullptr;
            const int result = wire_.reap(file, urb);
            if (result == 0) *static_cast<usbdevfs_urb**>(argument) = urb;
            return result;
        }
        case USBDEVFS_CLEAR_HALT:
            return wire_.clear_halt(*static_cast<unsigned*>(argument));
        case USBDEVFS_SETCONFIGURATION:
        case USBDEVFS_SETINTERFACE:
        case USBDEVFS_RESET:
            return wire_.gone() ? -ENODEV : 0;
        case USBDEVFS_GET_SPEED:
            return 2;  // full speed
        default:
            return -ENOTTY;
    }
}

int UsbfsUnit::claim(UsbFile& file, bool detach_driver) {
    if (wire_.gone()) return -ENODEV;
    const std::lock_guard lock(mutex_);
    if (access_.claimed_elsewhere || (claimed_by_ != nullptr && claimed_by_ != &file)) {
        return -EBUSY;
    }
    if (!access_.kernel_driver.empty()) {
        if (!detach_driver) return -EBUSY;
        detached_driver_ = std::exchange(access_.kernel_driver, {});
    }
    claimed_by_ = &file;
    return 0;
}

int UsbfsUnit::use_interface(UsbFile& file) {
    {
        const std::lock_guard lock(mutex_);
        if (claimed_by_ == &file) return 0;
    }
    return claim(file, false);  // as the kernel does, for programs that forgot to
}

int UsbfsUnit::release(UsbFile& file) {
    const std::lock_guard lock(mutex_);
    if (claimed_by_ != &file) return -EINVAL;
    claimed_by_ = nullptr;
    return 0;
}

int UsbfsUnit::name_driver(usbdevfs_getdriver& answer) {
    const std::lock_guard lock(mutex_);
    std::string name = access_.kernel_driver;
    if (name.empty() && (claimed_by_ != nullptr || access_.claimed_elsewhere)) name = "usbfs";
    if (name.empty()) return -ENODATA;
    const std::size_t size = name.copy(static_cast<char*>(answer.driver), sizeof answer.driver - 1);
    answer.driver[size] = '\0';
    return 0;
}

int UsbfsUnit::driver_ioctl(const usbdevfs_ioctl& request) {
    const std::lock_guard lock(mutex_);
    const auto code = static_cast<unsigned>(request.ioctl_code);
    if (code == static_cast<unsigned>(USBDEVFS_DISCONNECT)) {
        if (access_.kernel_driver.empty()) return -ENODATA;
        detached_driver_ = std::exchange(access_.kernel_driver, {});
        return 0;
    }
    if (code == static_cast<unsigned>(USBDEVFS_CONNECT)) {
        if (detached_driver_.empty()) return 0;
        access_.kernel_driver = std::exchange(detached_driver_, {});
        return 1;
    }
    return -ENOTTY;
}

void UsbfsUnit::close(UsbFile& file) {
    wire_.forget(file);
    const std::lock_guard lock(mutex_);
    if (claimed_by_ == &file) claimed_by_ = nullptr;
}

}  // namespace dibhr::test::falcon
