// Plain libusb, closed by destructors: what a test of the bench talks through.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <libusb.h>

#include "tests/device/falcon/usb_place.hpp"

namespace dibhr::test::falcon {

class UsbClient {
  public:
    UsbClient();
    ~UsbClient();
    UsbClient(const UsbClient&) = delete;
    UsbClient& operator=(const UsbClient&) = delete;

    /// Addresses of all Falcons on the bus, in libusb's order.
    [[nodiscard]] std::vector<int> addresses() const;
    /// LIBUSB_SUCCESS or why not.
    int open(const UsbPlace& place, bool auto_detach = false);
    int claim();
    int open_and_claim(const UsbPlace& place);
    void close();
    [[nodiscard]] std::string string(std::uint8_t index);
    int set(std::uint8_t request, std::uint16_t value);
    /// As libusb_bulk_transfer; `moved` is how many bytes went.
    int write(std::vector<std::uint8_t> bytes, int& moved, unsigned timeout_ms = 1000);
    int read(std::vector<std::uint8_t>& bytes, unsigned timeout_ms = 1000);
    /// Lets libusb work until it is true; false after a minute.
    [[nodiscard]] bool pump_until(const std::function<bool()>& is_so);

    /// Of the open node below libusb.
    [[nodiscard]] int descriptor() const;
    [[nodiscard]] libusb_context* context() const noexcept { return context_; }
    [[nodiscard]] libusb_device_handle* handle() const noexcept { return handle_; }

  private:
    libusb_context* context_{nullptr};
    libusb_device_handle* handle_{nullptr};
};

/// One bulk transfer that waits.
class PendingTransfer {
  public:
    PendingTransfer(UsbClient& client, std::uint8_t endpoint, std::vector<std::uint8_t> bytes,
                    unsigned timeout_ms = 0);
    ~PendingTransfer();
    PendingTransfer(const PendingTransfer&) = delete;
    PendingTransfer& operator=(const PendingTransfer&) = delete;

    int submit();
    int cancel();
    [[nodiscard]] bool ended() const noexcept { return ended_; }
    [[nodiscard]] libusb_transfer_status status() const noexcept { return transfer_->status; }
    [[nodiscard]] int size() const noexcept { return transfer_->actual_length; }

  private:
    UsbClient& client_;
    std::vector<std::uint8_t> bytes_;
    libusb_transfer* transfer_;
    bool ended_{true};
};

struct PendingRead : PendingTransfer {
    explicit PendingRead(UsbClient& client, unsigned timeout_ms = 0)
        : PendingTransfer(client, 0x81, std::vector<std::uint8_t>(64), timeout_ms) {}
};

}  // namespace dibhr::test::falcon
