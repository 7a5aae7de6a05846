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

#include "device/falcon/check/context.hpp"

namespace dibhr::falcon {

namespace {

constexpr unsigned kLimit_ms = 1000;
constexpr std::uint16_t kExpectedRelease = 0x0600;  // of an FT232R

std::string as_hex(unsigned value, int digits) {
    std::ostringstream text;
    text << "0x" << std::hex << std::setfill('0') << std::setw(digits) << value;
    return text.str();
}

/// The bytes of a descriptor as the device sends them; empty when it refuses.
std::string raw_descriptor(libusb_device_handle* handle, std::uint8_t type) {
    std::vector<std::uint8_t> bytes(1024);
    const int length =
        libusb_get_descriptor(handle, type, 0, bytes.data(), static_cast<int>(bytes.size()));
    bytes.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    return hexadecimal(bytes);
}

Json device_part(libusb_device_handle* handle, const libusb_device_descriptor& found) {
    return {{"bcdUSB", as_hex(found.bcdUSB, 4)},
            {"bDeviceClass", found.bDeviceClass},
            {"bDeviceSubClass", found.bDeviceSubClass},
            {"bDeviceProtocol", found.bDeviceProtocol},
            {"bMaxPacketSize0", found.bMaxPacketSize0},
            {"idVendor", as_hex(found.idVendor, 4)},
            {"idProduct", as_hex(found.idProduct, 4)},
            {"bcdDevice", as_hex(found.bcdDevice, 4)},
            {"iManufacturer", text_at(handle, found.iManufacturer)},
            {"iProduct", text_at(handle, found.iProduct)},
            {"iSerial", text_at(handle, found.iSerialNumber)},
            {"bNumConfigurations", found.bNumConfigurations},
            {"raw", raw_descriptor(handle, LIBUSB_DT_DEVICE)}};
}

Json interface_part(libusb_device_handle* handle, const libusb_interface_descriptor& found) {
    Json endpoints = Json::array();
    for (const auto& endpoint : std::span(found.endpoint, found.bNumEndpoints)) {
        endpoints.push_back({{"bEndpointAddress", as_hex(endpoint.bEndpointAddress, 2)},
                             {"bmAttributes", endpoint.bmAttributes},
                             {"wMaxPacketSize", endpoint.wMaxPacketSize},
                             {"bInterval", endpoint.bInterval}});
    }
    return {{"bInterfaceNumber", found.bInterfaceNumber},
            {"bAlternateSetting", found.bAlternateSetting},
            {"bInterfaceClass", found.bInterfaceClass},
            {"bInterfaceSubClass", found.bInterfaceSubClass},
            {"bInterfaceProtocol", found.bInterfaceProtocol},
            {"iInterface", text_at(handle, found.iInterface)},
            {"endpoints", endpoints}};
}

Json configuration_part(libusb_device_handle* handle, const libusb_config_descriptor& found) {
    Json interfaces = Json::array();
    for (const auto& one : std::span(found.interface, found.bNumInterfaces)) {
        for (const auto& setting :
             std::span(one.altsetting, static_cast<std::size_t>(one.num_altsetting))) {
            interfaces.push_back(interface_part(handle, setting));
        }
    }
    return {{"bConfigurationValue", found.bConfigurationValue},
            {"bmAttributes", as_hex(found.bmAttributes, 2)},
            {"MaxPower_mA", found.MaxPower * 2},
            {"iConfiguration", text_at(handle, found.iConfiguration)},
            {"interfaces", interfaces},
            {"raw", raw_descriptor(handle, LIBUSB_DT_CONFIG)}};
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

void add_status(libusb_device_handle* handle, Json& measured) {
    std::array<unsigned char, 2> status{};
    const int got = libusb_control_transfer(handle, LIBUSB_ENDPOINT_IN, LIBUSB_REQUEST_GET_STATUS,
                                            0, 0, status.data(), status.size(), kLimit_ms);
    if (got == 2) measured["device_status"] = hexadecimal(status);
}

}  // namespace

void check_identity(CheckContext& context, Json& measured) {
    FtdiPort& port = context.falcon.port();
    libusb_device_handle* const handle = port.handle();
    libusb_device* const device = libusb_get_device(handle);
    libusb_device_descriptor found{};
    if (const int code = libusb_get_device_descriptor(device, &found); code != 0) {
        throw usb_error(code, port.falcon());
    }
    measured["bus"] = port.falcon().bus;
    measured["address"] = port.falcon().address;
    measured["speed"] = name_of_speed(libusb_get_device_speed(device));
    measured["device"] = device_part(handle, found);
    libusb_config_descriptor* active = nullptr;
    if (libusb_get_active_config_descriptor(device, &active) == 0) {
        const std::unique_ptr<libusb_config_descriptor, void (*)(libusb_config_descriptor*)> owner(
            active, libusb_free_config_descriptor);
        measured["configuration"] = configuration_part(handle, *active);
    }
    add_status(handle, measured);
    // Read before the first setting: the state after power-up, or as the last program left it.
    std::array<std::uint8_t, 1> latency_ms{};
    port.ask(kReadLatencyTimer, latency_ms);
    measured["latency_timer_ms_found"] = latency_ms[0];
    std::array<std::uint8_t, 2> status{};
    port.ask(kReadModemStatus, status);
    measured["modem_and_line_status"] = hexadecimal(status);

    const std::string release = as_hex(found.bcdDevice, 4);
    const std::string serial = text_at(handle, found.iSerialNumber);
    const std::string says = "\"" + text_at(handle, found.iProduct) + "\", serial " +
                             (serial.empty() ? "unreadable" : serial) + ", bcdDevice " + release +
                             (found.bcdDevice == kExpectedRelease ? ", as an FT232R has it"
                                                                  : ", where an FT232R has 0x0600");
    context.findings.record_answer(OpenQuestion::identity, says);
    context.console.print(says);
}

}  // namespace dibhr::falcon
