// Thin wrappers over libusb's own calls.
#include "tests/device/falcon/usb_client.hpp"

#include <poll.h>

#include <array>
#include <chrono>
#include <span>
#include <stdexcept>
#include <utility>

namespace dibhr::test::falcon {

namespace {

/// The Falcons on the bus, released with the list.
class DeviceList {
  public:
    explicit DeviceList(libusb_context* context) {
        const ssize_t size = libusb_get_device_list(context, &all_);
        if (size < 0) throw std::runtime_error(libusb_error_name(static_cast<int>(size)));
        for (libusb_device* device : std::span(all_, static_cast<std::size_t>(size))) {
            libusb_device_descriptor descriptor{};
            libusb_get_device_descriptor(device, &descriptor);
            const bool falcon = descriptor.idVendor == 0x0403 && descriptor.idProduct == 0xCB48;
            if (falcon) falcons.push_back(device);
        }
    }
    ~DeviceList() { libusb_free_device_list(all_, 1); }
    DeviceList(const DeviceList&) = delete;
    DeviceList& operator=(const DeviceList&) = delete;

    std::vector<libusb_device*> falcons{};

  private:
    libusb_device** all_{nullptr};
};

}  // namespace

UsbClient::UsbClient() {
    const int result = libusb_init(&context_);
    if (result != LIBUSB_SUCCESS) throw std::runtime_error(libusb_error_name(result));
}

UsbClient::~UsbClient() {
    close();
    libusb_exit(context_);
}

std::vector<int> UsbClient::addresses() const {
    std::vector<int> addresses;
    for (libusb_device* device : DeviceList(context_).falcons) {
        addresses.push_back(libusb_get_device_address(device));
    }
    return addresses;
}

int UsbClient::open(const UsbPlace& place, bool auto_detach) {
    for (libusb_device* device : DeviceList(context_).falcons) {
        if (libusb_get_device_address(device) != place.address) continue;
        const int result = libusb_open(device, &handle_);
        if (result != LIBUSB_SUCCESS) return result;
        return libusb_set_auto_detach_kernel_driver(handle_, auto_detach ? 1 : 0);
    }
    return LIBUSB_ERROR_NOT_FOUND;
}

int UsbClient::claim() {
    return libusb_claim_interface(handle_, 0);
}

int UsbClient::open_and_claim(const UsbPlace& place) {
    const int result = open(place);
    return result == LIBUSB_SUCCESS ? claim() : result;
}

void UsbClient::close() {
    if (handle_ == nullptr) return;
    libusb_release_interface(handle_, 0);
    libusb_close(handle_);
    handle_ = nullptr;
}

std::string UsbClient::string(std::uint8_t index) {
    std::array<unsigned char, 128> text{};
    const int size = libusb_get_string_descriptor_ascii(handle_, index, text.data(),
                                                        static_cast<int>(text.size()));
    if (size < 0) return libusb_error_name(size);
    return {text.begin(), text.begin() + size};
}

int UsbClient::set(std::uint8_t request, std::uint16_t value) {
    return libusb_control_transfer(handle_, 0x40, request, value, 0, nullptr, 0, 1000);
}

int UsbClient::write(std::vector<std::uint8_t> bytes, int& moved, unsigned timeout_ms) {
    return libusb_bulk_transfer(handle_, 0x02, bytes.data(), static_cast<int>(bytes.size()), &moved,
                                timeout_ms);
}

int UsbClient::read(std::vector<std::uint8_t>& bytes, unsigned timeout_ms) {
    int moved = 0;
    const int result = libusb_bulk_transfer(handle_, 0x81, bytes.data(),
                                            static_cast<int>(bytes.size()), &moved, timeout_ms);
    bytes.resize(static_cast<std::size_t>(moved));
    return result;
}

int UsbClient::descriptor() const {
    const libusb_pollfd** list = libusb_get_pollfds(context_);
    int found = -1;
    for (const auto* const* item = list; *item != nullptr; ++item) {
        if (((*item)->events & POLLOUT) != 0) found = (*item)->fd;
    }
    libusb_free_pollfds(list);
    return found;
}

bool UsbClient::pump_until(const std::function<bool()>& is_so) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!is_so()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        timeval ten_ms{0, 10'000};
        libusb_handle_events_timeout_completed(context_, &ten_ms, nullptr);
    }
    return true;
}

PendingTransfer::PendingTransfer(UsbClient& client, std::uint8_t endpoint,
                                 std::vector<std::uint8_t> bytes, unsigned timeout_ms)
    : client_(client), bytes_(std::move(bytes)), transfer_(libusb_alloc_transfer(0)) {
    libusb_fill_bulk_transfer(
        transfer_, client.handle(), endpoint, bytes_.data(), static_cast<int>(bytes_.size()),
        [](libusb_transfer* transfer) {
            static_cast<PendingTransfer*>(transfer->user_data)->ended_ = true;
        },
        this, timeout_ms);
}

PendingTransfer::~PendingTransfer() {
    if (!ended_) libusb_cancel_transfer(transfer_);
    static_cast<void>(client_.pump_until([this] { return ended_; }));
    libusb_free_transfer(transfer_);
}

int PendingTransfer::submit() {
    const int result = libusb_submit_transfer(transfer_);
    ended_ = result != LIBUSB_SUCCESS;
    return result;
}

int PendingTransfer::cancel() {
    return libusb_cancel_transfer(transfer_);
}

}  // namespace dibhr::test::falcon
