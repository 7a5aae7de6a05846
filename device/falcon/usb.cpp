// The Falcons on the USB, owners of libusb's context and handles, its errors as plain sentences.
#include "device/falcon/usb.hpp"

#include <libusb.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <tuple>
#include <utility>

#include "device/hand/udev_rule.hpp"

namespace dibhr::falcon {

namespace {

constexpr unsigned kRequestLimit_ms = 1000;  // ample
constexpr std::uint8_t kVendorRequestOut = 0x40;
constexpr std::uint8_t kVendorRequestIn = 0xc0;
constexpr const char* kRule = "70-dibhr-falcon.rules";
constexpr int kMostPorts = 7;  // in a row, by the USB specification

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

/// Linux reads the serial when the device is plugged in. Every user may read it from there, also
/// without the permission to open the device.
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
    std::string serial = text_at(opened, string_index);
    libusb_close(opened);
    return serial;
}

/// A timeout for libusb, at least 1: zero would mean no timeout.
unsigned milliseconds_of(std::chrono::milliseconds limit) {
    return static_cast<unsigned>(std::max<std::chrono::milliseconds::rep>(limit.count(), 1));
}

constexpr const char* kUnplugged =
    " was unplugged or lost its USB power: the mouse touches meanwhile; plug it in again";

/// The sentence for an error, without the Falcon's name before it.
struct Meaning {
    int code;
    const char* sentence;
};
constexpr std::array<Meaning, 9> kMeanings{{
    {LIBUSB_ERROR_BUSY,
     " is held by another program or driver: close the other program, or plug the Falcon in again"},
    {LIBUSB_ERROR_NO_DEVICE, kUnplugged},
    {LIBUSB_ERROR_NOT_FOUND, kUnplugged},
    {LIBUSB_ERROR_PIPE,
     " refused a USB transfer (stall): if this happens again, unplug it and its power adapter for "
     "ten seconds"},
    {LIBUSB_ERROR_TIMEOUT,
     " took no data for a second: unplug it and its power adapter for ten seconds"},
    {LIBUSB_ERROR_OVERFLOW,
     " sent more than was asked for: plug it in again, into another USB socket if this happens "
     "again"},
    {LIBUSB_ERROR_IO,
     " failed on the USB (input/output error): check its cable and plug it in again"},
    {LIBUSB_ERROR_NO_MEM, " cannot be used, for no memory is left: close other programs"},
    {LIBUSB_ERROR_NOT_SUPPORTED,
     " is held by a driver that libusb cannot replace: on Windows give it the WinUSB driver with "
     "Zadig, then plug it in again"},
}};

}  // namespace

std::string full_name_of(const AttachedFalcon& falcon) {
    if (!falcon.serial.empty()) return "the Falcon " + falcon.serial;
    return "the Falcon at USB bus " + std::to_string(falcon.bus) + " address " +
           std::to_string(falcon.address);
}

std::optional<AttachedFalcon> choose(std::span<const AttachedFalcon> attached,
                                     const std::string& serial) {
    const auto found = std::find_if(
        attached.begin(), attached.end(),
        [&](const AttachedFalcon& falcon) { return serial.empty() || falcon.serial == serial; });
    if (found == attached.end()) return std::nullopt;
    return *found;
}

std::string why_none(std::span<const AttachedFalcon> attached, const std::string& serial) {
    const std::string wanted = serial.empty() ? "no Falcon" : "the Falcon " + serial;
    const std::string verb = serial.empty() ? " is attached" : " is not attached";
    if (attached.empty()) return wanted + verb + ": plug in its USB cable and its power adapter";
    return wanted + verb + ", but " + serials_of(attached) +
           ": plug it in, or choose the serial of another";
}

std::string serials_of(std::span<const AttachedFalcon> attached) {
    std::string serials;
    for (const AttachedFalcon& falcon : attached) {
        serials += (serials.empty() ? "" : ", ") +
                   (falcon.serial.empty() ? "one without a readable serial" : falcon.serial);
    }
    return serials;
}

bool UsbError::unplugged() const noexcept {
    return code_ == LIBUSB_ERROR_NO_DEVICE || code_ == LIBUSB_ERROR_NOT_FOUND;
}

UsbError usb_error(int code, const AttachedFalcon& falcon) {
    const std::string who = full_name_of(falcon);
    if (code == LIBUSB_ERROR_ACCESS) {
        return {code,
                "no permission to open " + who + ": " + how_to_get_permission(kRule, "the Falcon")};
    }
    for (const Meaning& known : kMeanings) {
        if (known.code == code) return {code, who + known.sentence};
    }
    return {code, who + " cannot be used (" + libusb_error_name(code) + "): plug it in again"};
}

void UsbContext::Close::operator()(libusb_context* context) const noexcept {
    libusb_exit(context);
}

UsbContext::UsbContext() {
    libusb_context* started = nullptr;
    const int code = libusb_init(&started);
    if (code != 0) {
        throw UsbError(code, std::string("the USB devices cannot be looked at (") +
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

std::string text_at(libusb_device_handle* handle, std::uint8_t index) {
    std::array<unsigned char, 256> text{};
    const int length = libusb_get_string_descriptor_ascii(handle, index, text.data(),
                                                          static_cast<int>(text.size()));
    return length > 0 ? std::string(text.begin(), text.begin() + length) : std::string();
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
    // Only Linux has drivers to detach; elsewhere the claim below fails with the reason.
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

void FtdiPort::ask(std::uint8_t request, std::span<std::uint8_t> answer) {
    const int code =
        libusb_control_transfer(handle(), kVendorRequestIn, request, 0, 0, answer.data(),
                                static_cast<std::uint16_t>(answer.size()), kRequestLimit_ms);
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
    // Exactly one packet: less could overflow, more would wait for further packets.
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

int FtdiPort::descriptor(const UsbContext& usb) const noexcept {
    int found = -1;
    const libusb_pollfd** list = libusb_get_pollfds(usb.get());
    // libusb's own descriptors are polled with POLLIN only.
    for (const auto* const* item = list; item != nullptr && *item != nullptr; ++item) {
        if (((*item)->events & POLLOUT) != 0) found = (*item)->fd;
    }
    libusb_free_pollfds(list);
    return found;
}

Payload payload_of(std::span<std::uint8_t> transfer) noexcept {
    Payload payload;
    std::size_t kept = 0;
    for (std::size_t at = 0; at + kStatusBytes <= transfer.size(); at += kUsbPacketBytes) {
        const auto packet = transfer.subspan(at, std::min(kUsbPacketBytes, transfer.size() - at));
        const auto errors =
            static_cast<std::uint8_t>(packet[1] & (kOverrun | kParityError | kFramingError));
        payload.line_errors |= errors;
        payload.faulty_packets += errors != 0 ? 1U : 0U;
        const auto data = packet.subspan(kStatusBytes);
        // Forwards within one array: the target never lies behind the source.
        std::copy(data.begin(), data.end(), transfer.subspan(kept).begin());
        kept += data.size();
    }
    payload.bytes = transfer.first(kept);
    return payload;
}

}  // namespace dibhr::falcon
