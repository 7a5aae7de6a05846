// The usbfs ioctls that libusb and a small program use, and whose the interface is.
#include "tests/device/falcon/usbfs_unit.hpp"

#include <linux/ioctl.h>

#include <algorithm>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace dibhr::test::falcon {

namespace {

constexpr std::size_t kSetupBytes = 8;

}  // namespace

std::size_t UsbfsUrb::bytes_back() const noexcept {
    const bool control = urb.type == USBDEVFS_URB_TYPE_CONTROL;
    const unsigned direction = control && !bytes.empty() ? bytes.front() : urb.endpoint;
    if ((direction & 0x80U) == 0) return 0;
    return (control ? kSetupBytes : 0) + static_cast<std::size_t>(urb.actual_length);
}

void UsbfsUnit::set_access(UsbAccess access) {
    const std::lock_guard lock(mutex_);
    access_ = std::move(access);
}

UsbAccess UsbfsUnit::access() {
    const std::lock_guard lock(mutex_);
    return access_;
}

int UsbfsUnit::open(UsbfsFile& file) {
    if (const int refused = access().open_errno; refused != 0) return -refused;
    return wire_.open(file.on_bus);
}

int UsbfsUnit::submit(UsbfsFile& file, const usbdevfs_urb& urb, std::uintptr_t id) {
    const int refused = urb.type == USBDEVFS_URB_TYPE_CONTROL ? 0 : use_interface(file);
    if (refused != 0) return refused;
    std::list<UsbfsUrb> made(1);
    UsbfsUrb& own = made.front();
    const auto* const bytes = static_cast<const std::uint8_t*>(urb.buffer);
    own.id = id;
    own.urb = urb;
    own.bytes.assign(bytes, bytes + urb.buffer_length);
    own.urb.buffer = own.bytes.data();
    {
        const std::lock_guard lock(mutex_);
        file.urbs.splice(file.urbs.end(), made);
    }
    const int result = wire_.submit(file.on_bus, &own.urb);
    if (result == 0) return 0;
    const std::lock_guard lock(mutex_);
    std::erase_if(file.urbs, [&own](const UsbfsUrb& each) { return &each == &own; });
    return result;
}

int UsbfsUnit::discard(UsbfsFile& file, std::uintptr_t id) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(file.urbs, id, &UsbfsUrb::id);
    return found == file.urbs.end() ? -EINVAL : wire_.discard(file.on_bus, &found->urb);
}

int UsbfsUnit::reap(UsbfsFile& file, UsbfsUrb& ended) {
    const std::lock_guard lock(mutex_);
    usbdevfs_urb* urb = nullptr;
    const int result = wire_.reap(file.on_bus, urb);
    if (result != 0) return result;
    const auto found = std::ranges::find(file.urbs, urb, [](UsbfsUrb& each) { return &each.urb; });
    ended = std::move(*found);
    file.urbs.erase(found);
    return 0;
}

int UsbfsUnit::bulk(UsbfsFile& file, const usbdevfs_bulktransfer& transfer) {
    if (const int refused = use_interface(file); refused != 0) return refused;
    const std::span bytes(static_cast<std::uint8_t*>(transfer.data), transfer.len);
    return wire_.bulk(file.on_bus, transfer.ep, bytes, std::chrono::milliseconds(transfer.timeout));
}

int UsbfsUnit::ioctl(UsbfsFile& file, unsigned long request, void* argument) {
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
        case USBDEVFS_CLEAR_HALT:
            return wire_.clear_halt(file.on_bus, *static_cast<unsigned*>(argument));
        case USBDEVFS_SETCONFIGURATION:
        case USBDEVFS_SETINTERFACE:
        case USBDEVFS_RESET:
            return wire_.gone(file.on_bus) ? -ENODEV : 0;
        case USBDEVFS_GET_SPEED:
            return 2;  // full speed
        default:
            return -ENOTTY;
    }
}

int UsbfsUnit::claim(UsbfsFile& file, bool detach_driver) {
    if (wire_.gone(file.on_bus)) return -ENODEV;
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

int UsbfsUnit::use_interface(UsbfsFile& file) {
    {
        const std::lock_guard lock(mutex_);
        if (claimed_by_ == &file) return 0;
    }
    return claim(file, false);  // as the kernel does, for programs that forgot to
}

int UsbfsUnit::release(UsbfsFile& file) {
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

void UsbfsUnit::close(UsbfsFile& file) {
    wire_.forget(file.on_bus);
    const std::lock_guard lock(mutex_);
    if (claimed_by_ == &file) claimed_by_ = nullptr;
}

}  // namespace dibhr::test::falcon
