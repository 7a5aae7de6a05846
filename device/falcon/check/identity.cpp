// Step 1: the descriptors, as lsusb -v shows them (../README.md, USB identity).
#include <libusb.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "device/falcon/check/steps.hpp"
#include "device/falcon/check/vendor_reads.hpp"

namespace dibhr::falcon {

namespace {

constexpr unsigned kLimit_ms = 1000;
constexpr std::uint16_t kExpectedRelease = 0x0600;  // of an FT232R

std::string as_hex(unsigned value, int digits) {
    std::ostringstream text;
    text << "0x" << std::hex << std::setfill('0') << std::setw(digits) << value;
    return text.str();
}

std::string text_at(libusb_device_handle* handle, std::uint8_t index) {
    std::array<unsigned char, 256> text{};
    const int length = libusb_get_string_descriptor_ascii(handle, index, text.data(),
                                                          static_cast<int>(text.size()));
    return length > 0 ? std::string(text.begin(), text.begin() + length) : std::string();
}

/// The bytes of a descriptor as the device sends them; empty when it refuses.
std::vector<std::uint8_t> raw_descriptor(libusb_device_handle* handle, std::uint8_t type) {
    std::vector<std::uint8_t> bytes(1024);
    const int length =
        libusb_get_descriptor(handle, type, 0, bytes.data(), static_cast<int>(bytes.size()));
    bytes.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    return bytes;
}

Measured device_part(libusb_device_handle* handle, const libusb_device_descriptor& found) {
    Measured part;
    part.add("bcdUSB", as_hex(found.bcdUSB, 4))
        .add("bDeviceClass", int{found.bDeviceClass})
        .add("bDeviceSubClass", int{found.bDeviceSubClass})
        .add("bDeviceProtocol", int{found.bDeviceProtocol})
        .add("bMaxPacketSize0", int{found.bMaxPacketSize0})
        .add("idVendor", as_hex(found.idVendor, 4))
        .add("idProduct", as_hex(found.idProduct, 4))
        .add("bcdDevice", as_hex(found.bcdDevice, 4))
        .add("iManufacturer", text_at(handle, found.iManufacturer))
        .add("iProduct", text_at(handle, found.iProduct))
        .add("iSerial", text_at(handle, found.iSerialNumber))
        .add("bNumConfigurations", int{found.bNumConfigurations})
        .add("raw", hexadecimal(raw_descriptor(handle, LIBUSB_DT_DEVICE)));
    return part;
}

Measured endpoint_part(const libusb_endpoint_descriptor& found) {
    Measured part;
    part.add("bEndpointAddress", as_hex(found.bEndpointAddress, 2))
        .add("bmAttributes", int{found.bmAttributes})
        .add("wMaxPacketSize", int{found.wMaxPacketSize})
        .add("bInterval", int{found.bInterval});
    return part;
}

Measured interface_part(libusb_device_handle* handle, const libusb_interface_descriptor& found) {
    MeasuredList endpoints;
    for (const auto& endpoint : std::span(found.endpoint, found.bNumEndpoints)) {
        endpoints.add(endpoint_part(endpoint));
    }
    Measured part;
    part.add("bInterfaceNumber", int{found.bInterfaceNumber})
        .add("bAlternateSetting", int{found.bAlternateSetting})
        .add("bInterfaceClass", int{found.bInterfaceClass})
        .add("bInterfaceSubClass", int{found.bInterfaceSubClass})
        .add("bInterfaceProtocol", int{found.bInterfaceProtocol})
        .add("iInterface", text_at(handle, found.iInterface))
        .add("endpoints", endpoints);
    return part;
}

Measured configuration_part(libusb_device_handle* handle, libusb_config_descriptor& found) {
    MeasuredList interfaces;
    for (const auto& one : std::span(found.interface, found.bNumInterfaces)) {
        for (const auto& setting :
             std::span(one.altsetting, static_cast<std::size_t>(one.num_altsetting))) {
            interfaces.add(interface_part(handle, setting));
        }
    }
    Measured part;
    part.add("bConfigurationValue", int{found.bConfigurationValue})
        .add("bmAttributes", as_hex(found.bmAttributes, 2))
        .add("MaxPower_mA", int{found.MaxPower} * 2)
        .add("iConfiguration", text_at(handle, found.iConfiguration))
        .add("interfaces", interfaces)
        .add("raw", hexadecimal(raw_descriptor(handle, LIBUSB_DT_CONFIG)));
    return part;
}

const char* name_of_speed(int speed) {
    switch (speed) {
        case LIBUSB_SPEED_LOW:
            return "low, 1.5 Mbit/s";
        case LIBUSB_SPEED_FULL:
            return "full, 12 Mbit/s";
        case LIBUSB_SPEED_HIGH:
            return "high, 480 Mbit/s";
        default:
            return "not known";
    }
}

void add_status(libusb_device_handle* handle, Measured& measured) {
    std::array<unsigned char, 2> status{};
    const int got = libusb_control_transfer(handle, LIBUSB_ENDPOINT_IN, LIBUSB_REQUEST_GET_STATUS,
                                            0, 0, status.data(), status.size(), kLimit_ms);
    if (got == 2) measured.add("device_status", hexadecimal(status));
}

}  // namespace

void check_identity(CheckDesk& desk, Measured& measured) {
    FtdiPort& port = desk.falcon.port();
    libusb_device_handle* const handle = port.handle();
    libusb_device* const device = libusb_get_device(handle);
    libusb_device_descriptor found{};
    if (const int code = libusb_get_device_descriptor(device, &found); code != 0) {
        throw usb_error(code, port.falcon());
    }
    measured.add("bus", port.falcon().bus)
        .add("address", port.falcon().address)
        .add("speed", name_of_speed(libusb_get_device_speed(device)))
        .add("device", device_part(handle, found));
    libusb_config_descriptor* active = nullptr;
    if (libusb_get_active_config_descriptor(device, &active) == 0) {
        const std::unique_ptr<libusb_config_descriptor, void (*)(libusb_config_descriptor*)> owner(
            active, libusb_free_config_descriptor);
        measured.add("configuration", configuration_part(handle, *active));
    }
    add_status(handle, measured);
    // Before anything is set: as the chip was powered up, or as the last program left it.
    measured.add("latency_timer_ms_found", read_latency_timer(port));
    measured.add("modem_and_line_status", hexadecimal(read_modem_status(port)));

    const std::string release = as_hex(found.bcdDevice, 4);
    const std::string serial = text_at(handle, found.iSerialNumber);
    const std::string says = "\"" + text_at(handle, found.iProduct) + "\", serial " +
                             (serial.empty() ? "unreadable" : serial) + ", bcdDevice " + release +
                             (found.bcdDevice == kExpectedRelease ? ", as an FT232R has it"
                                                                  : ", where an FT232R has 0x0600");
    desk.findings.settle(OpenQuestion::identity, says);
    desk.guide.say(says);
}

}  // namespace dibhr::falcon
