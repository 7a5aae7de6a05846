// Which Novint Falcons are on the USB, asked through libusb.
#include "device/falcon_scan.hpp"

#include <libusb.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace dibhr {
namespace {

// The Falcon's own product number behind FTDI's vendor number; not the 6001 of a plain FTDI
// adapter.
constexpr std::uint16_t kFalconVendor = 0x0403;
constexpr std::uint16_t kFalconProduct = 0xcb48;

struct CloseContext {
    void operator()(libusb_context* context) const noexcept { libusb_exit(context); }
};
struct FreeList {
    void operator()(libusb_device** list) const noexcept { libusb_free_device_list(list, 1); }
};
struct CloseDevice {
    void operator()(libusb_device_handle* handle) const noexcept { libusb_close(handle); }
};

std::string problem_of(int error) {
    if (error == LIBUSB_ERROR_ACCESS) {
        return "no permission to open it: copy assets/70-dibhr-falcon.rules to /etc/udev/rules.d, "
               "then plug "
               "it in again";
    }
    return std::string("cannot be opened: ") + libusb_strerror(static_cast<libusb_error>(error));
}

AttachedFalcon look_at(libusb_device* device, const libusb_device_descriptor& descriptor) {
    AttachedFalcon falcon;
    falcon.bus = libusb_get_bus_number(device);
    falcon.address = libusb_get_device_address(device);
    libusb_device_handle* opened = nullptr;
    const int error = libusb_open(device, &opened);
    if (error != 0) {
        falcon.problem = problem_of(error);
        return falcon;
    }
    const std::unique_ptr<libusb_device_handle, CloseDevice> handle(opened);
    std::array<unsigned char, 256> text{};
    const int length = libusb_get_string_descriptor_ascii(
        handle.get(), descriptor.iSerialNumber, text.data(), static_cast<int>(text.size()));
    if (length > 0) falcon.serial.assign(text.begin(), text.begin() + length);
    return falcon;
}

}  // namespace

FalconScan scan_falcons() {
    FalconScan scan;
    libusb_context* started = nullptr;
    const int error = libusb_init(&started);
    if (error != 0) {
        scan.failure = std::string("the USB cannot be looked at: ") +
                       libusb_strerror(static_cast<libusb_error>(error));
        return scan;
    }
    const std::unique_ptr<libusb_context, CloseContext> context(started);
    libusb_device** found = nullptr;
    const auto count = libusb_get_device_list(context.get(), &found);
    if (count < 0) {
        scan.failure = std::string("the USB devices cannot be listed: ") +
                       libusb_strerror(static_cast<libusb_error>(count));
        return scan;
    }
    const std::unique_ptr<libusb_device*, FreeList> list(found);
    for (libusb_device* device : std::span(list.get(), static_cast<std::size_t>(count))) {
        libusb_device_descriptor descriptor{};
        if (libusb_get_device_descriptor(device, &descriptor) != 0) continue;
        if (descriptor.idVendor != kFalconVendor || descriptor.idProduct != kFalconProduct)
            continue;
        scan.falcons.push_back(look_at(device, descriptor));
    }
    return scan;
}

}  // namespace dibhr
