// Vendor requests with an answer.
#include "device/falcon/check/vendor_reads.hpp"

#include <libusb.h>

#include <span>

namespace dibhr::falcon {

namespace {

constexpr std::uint8_t kVendorRequestIn = 0xc0;
constexpr std::uint8_t kReadModemStatus = 5;
constexpr std::uint8_t kReadLatencyTimer = 10;
constexpr unsigned kLimit_ms = 1000;

void read(FtdiPort& port, std::uint8_t request, std::span<std::uint8_t> answer) {
    const int code =
        libusb_control_transfer(port.handle(), kVendorRequestIn, request, 0, 0, answer.data(),
                                static_cast<std::uint16_t>(answer.size()), kLimit_ms);
    if (code < 0) throw usb_error(code, port.falcon());
}

}  // namespace

int read_latency_timer(FtdiPort& port) {
    std::array<std::uint8_t, 1> answer{};
    read(port, kReadLatencyTimer, answer);
    return answer[0];
}

std::array<std::uint8_t, 2> read_modem_status(FtdiPort& port) {
    std::array<std::uint8_t, 2> answer{};
    read(port, kReadModemStatus, answer);
    return answer;
}

}  // namespace dibhr::falcon
