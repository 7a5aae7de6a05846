// libusb's context, devices and handles with owners, and its errors in plain sentences.
#include "device/falcon/usb.hpp"

#include <libusb.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <tuple>
#include <utility>

#include "device/falcon/permission.hpp"

namespace dibhr::falcon {

namespace {

constexpr unsigned kRequestLimit_ms = 1000;  // ample
constexpr int kMostPorts = 7;                // in a row, by the USB specification

struct FreeList {
    void operator()(libusb_device** list) const noexcept { libusb_free_device_list(list, 1); }
};

/// All devices.
struct DeviceList {
    std::unique_ptr<libusb_device*, FreeList> list{};
    std::span<libusb_device*> devices{};  ///< those of the list
};

DeviceList devices_on(const UsbContext& usb) {
    libusb_device** found = nullptr;
    const auto count = libusb_get_device_list(usb.get(), &found);
    if (count < 0) {
        throw UsbError(static_cast<int>(count), std::string("the USB devices cannot be listed (") +
                                                    libusb_error_name(static_cast<int>(count)) +
                                                    "): start dibhr again");
    }
    return {std::unique_ptr<libusb_device*, FreeList>(found),
            std::span(found, static_cast<std::size_t>(count))};
}

std::optional<libusb_device_descriptor> falcon_descriptor(libusb_device* device) {
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(device, &descriptor) != 0) return std::nullopt;
    if (descriptor.idVendor != kVendor || descriptor.idProduct != kProduct) return std::nullopt;
    return descriptor;
}

/// Linux reads the serial when the device is plugged in and tells it to everyone, also to people
/// who may not open the device.
std::string serial_from_system(libusb_device* device) {
    std::array<std::uint8_t, kMostPorts> ports{};
    const int depth = libusb_get_port_numbers(device, ports.data(), kMostPorts);
    std::string name = std::to_string(libusb_get_bus_number(device));
    for (int k = 0; k < depth; ++k) {
        name += (k == 0 ? '-' : '.') + std::to_string(ports[static_cast<std::size_t>(k)]);
    }
    std::ifstream file("/sys/bus/usb/devices/" + name + "/serial");
    std::string serial;
    std::getline(file, serial);
    return serial;
}

std::string serial_from_device(libusb_device* device, std::uint8_t string_index) {
    libusb_device_handle* opened = nullptr;
    if (libusb_open(device, &opened) != 0) return {};
    std::array<unsigned char, 256> text{};
    const int length = libusb_get_string_descriptor_ascii(opened, string_index, text.data(),
                                                          static_cast<int>(text.size()));
    libusb_close(opened);
    return length > 0 ? std::string(text.begin(), text.begin() + length) : std::string();
}

/// How libusb's timeouts are given; its zero would mean for ever.
unsigned milliseconds_of(std::chrono::milliseconds limit) {
    return static_cast<unsigned>(std::max<std::chrono::milliseconds::rep>(limit.count(), 1));
}

}  // namespace

bool UsbError::gone() const noexcept {
    return code_ == LIBUSB_ERROR_NO_DEVICE || code_ == LIBUSB_ERROR_NOT_FOUND;
}

UsbError usb_error(int code, const AttachedFalcon& falcon) {
    const std::string who = full_name_of(falcon);
    switch (code) {
        case LIBUSB_ERROR_ACCESS:
            return {code, "no permission to open " + who + ": " + how_to_get_permission()};
        case LIBUSB_ERROR_BUSY:
            return {code, who +
                              " is held by another program or driver: close the other program, "
                              "or plug the Falcon in again"};
        case LIBUSB_ERROR_NO_DEVICE:
        case LIBUSB_ERROR_NOT_FOUND:
            return {code, who +
                              " was unplugged or lost its USB power: the mouse touches "
                              "meanwhile; plug it in again"};
        case LIBUSB_ERROR_PIPE:
            return {code, who +
                              " refused a USB transfer (stall): if this comes again, unplug it "
                              "and its power adapter for ten seconds"};
        case LIBUSB_ERROR_TIMEOUT:
            return {code, who +
                              " took no data for a second: unplug it and its power adapter for "
                              "ten seconds"};
        case LIBUSB_ERROR_OVERFLOW:
            return {code, who +
                              " sent more than was asked for: plug it in again, into another "
                              "USB socket if this comes again"};
        case LIBUSB_ERROR_IO:
            return {code, who +
                              " failed on the USB (input/output error): check its cable and plug "
                              "it in again"};
        case LIBUSB_ERROR_NOT_SUPPORTED:
            return {code, who +
                              " is held by a driver that libusb cannot replace: on Windows give "
                              "it the WinUSB driver with Zadig, then plug it in again"};
        case LIBUSB_ERROR_NO_MEM:
            return {code, "no memory left to talk to " + who + ": close other programs"};
        default:
            return {code,
                    who + " cannot be used (" + libusb_error_name(code) + "): plug it in again"};
    }
}

void UsbContext::Close::operator()(libusb_context* context) const noexcept {
    libusb_exit(context);
}

UsbContext::UsbContext() {
    libusb_context* started = nullptr;
    const int code = libusb_init(&started);
    if (code != 0) {
        throw UsbError(code, std::string("the USB cannot be looked at (") +
                                 libusb_error_name(code) +
                                 "): run dibhr where /dev/bus/usb is present");
    }
    context_.reset(started);
}

std::vector<AttachedFalcon> attached_falcons(const UsbContext& usb) {
    std::vector<AttachedFalcon> falcons;
    const DeviceList all = devices_on(usb);
    for (libusb_device* device : all.devices) {
        const auto descriptor = falcon_descriptor(device);
        if (!descriptor) continue;
        AttachedFalcon falcon{libusb_get_bus_number(device), libusb_get_device_address(device),
                              serial_from_system(device)};
        if (falcon.serial.empty()) {
            falcon.serial = serial_from_device(device, descriptor->iSerialNumber);
        }
        falcons.push_back(std::move(falcon));
    }
    std::sort(falcons.begin(), falcons.end(), [](const auto& a, const auto& b) {
        return std::tie(a.serial, a.bus, a.address) < std::tie(b.serial, b.bus, b.address);
    });
    return falcons;
}

void FtdiPort::Close::operator()(libusb_device_handle* handle) const noexcept {
    libusb_close(handle);
}

FtdiPort::FtdiPort(const UsbContext& usb, const AttachedFalcon& which)
    : falcon_(which), packet_(kUsbPacketBytes) {
    const DeviceList all = devices_on(usb);
    int code = LIBUSB_ERROR_NO_DEVICE;
    for (libusb_device* device : all.devices) {
        if (!falcon_descriptor(device) || libusb_get_bus_number(device) != which.bus ||
            libusb_get_device_address(device) != which.address) {
            continue;
        }
        libusb_device_handle* opened = nullptr;
        code = libusb_open(device, &opened);
        handle_.reset(opened);
        break;
    }
    if (code != 0) throw usb_error(code, falcon_);
    // Only Linux has drivers to detach; elsewhere the claim says what is wrong.
    (void)libusb_set_auto_detach_kernel_driver(handle(), 1);
    code = libusb_claim_interface(handle(), kInterface);
    if (code != 0) throw usb_error(code, falcon_);
}

FtdiPort::~FtdiPort() {
    libusb_release_interface(handle(), kInterface);
}

void FtdiPort::request(const FtdiRequest& request) {
    const int code =
        libusb_control_transfer(handle(), kVendorRequestOut, request.request, request.value,
                                request.index, nullptr, 0, kRequestLimit_ms);
    if (code < 0) throw usb_error(code, falcon_);
}

void FtdiPort::purge() {
    request(kPurgeOne);
    request(kPurgeOther);
}

void FtdiPort::write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds limit) {
    packet_.assign(bytes.begin(), bytes.end());
    int written = 0;
    const int code =
        libusb_bulk_transfer(handle(), kOutEndpoint, packet_.data(),
                             static_cast<int>(packet_.size()), &written, milliseconds_of(limit));
    if (code != 0) throw usb_error(code, falcon_);
    if (written != static_cast<int>(bytes.size())) throw usb_error(LIBUSB_ERROR_IO, falcon_);
}

Payload FtdiPort::read(std::chrono::milliseconds limit) {
    // Exactly one packet: less could overflow, more would wait for one that is not full (README.md,
    // IN packets).
    packet_.resize(kUsbPacketBytes);
    int got = 0;
    const int code =
        libusb_bulk_transfer(handle(), kInEndpoint, packet_.data(),
                             static_cast<int>(packet_.size()), &got, milliseconds_of(limit));
    if (code != 0 && code != LIBUSB_ERROR_TIMEOUT) throw usb_error(code, falcon_);
    return payload_of(std::span(packet_).first(static_cast<std::size_t>(got)));
}

void FtdiPort::clear_stall() noexcept {
    libusb_clear_halt(handle(), kInEndpoint);
    libusb_clear_halt(handle(), kOutEndpoint);
}

}  // namespace dibhr::falcon
