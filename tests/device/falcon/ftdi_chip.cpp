// Vendor requests and IN packets of the FT232R.
#include "tests/device/falcon/ftdi_chip.hpp"

#include <algorithm>
#include <array>

namespace dibhr::test::falcon {

namespace {

constexpr std::size_t kStatusBytes = 2;
constexpr std::size_t kMostData = 62;
constexpr std::uint8_t kModemStatus = 0x01;  // idle is 01 60
constexpr std::uint8_t kLineStatus = 0x60;
constexpr std::uint8_t kVendorOut = 0x40;
constexpr std::uint8_t kVendorIn = 0xC0;

enum Request : std::uint8_t {
    reset = 0,
    modem_control = 1,
    flow_control = 2,
    baud_rate = 3,
    data_format = 4,
    modem_status = 5,
    event_character = 6,
    latency_timer = 9,
    read_latency_timer = 10,
};

}  // namespace

unsigned baud_of(std::uint16_t value, std::uint16_t index) noexcept {
    constexpr std::array kEighths{0U, 4U, 2U, 1U, 3U, 5U, 6U, 7U};
    constexpr unsigned kEightTimesClock = 24'000'000;
    const unsigned code = (value >> 14U) | ((index & 1U) << 2U);
    const unsigned divisor = (value & 0x3FFFU) * 8 + kEighths.at(code);
    if (divisor < 16) return 0;  // the two special codes of 3 and 2 Mbaud: nobody sends them
    return (kEightTimesClock + divisor / 2) / divisor;
}

std::optional<std::size_t> FtdiChip::control(const ControlSetup& setup,
                                             std::span<std::uint8_t> data) {
    if (setup.type == kVendorOut) {
        if (!set(setup)) return std::nullopt;
        return 0;
    }
    if (setup.type != kVendorIn) return std::nullopt;
    if (setup.request == modem_status && data.size() >= 2) {
        data[0] = kModemStatus;
        data[1] = kLineStatus;
        return 2;
    }
    if (setup.request == read_latency_timer && !data.empty()) {
        data[0] = static_cast<std::uint8_t>(latency_ms_);
        return 1;
    }
    return std::nullopt;
}

bool FtdiChip::set(const ControlSetup& setup) {
    const unsigned low = setup.value & 0xFFU;
    const unsigned high = setup.value >> 8U;
    switch (setup.request) {
        case reset:
            // 1 empties what goes to the device, where nothing ever waits; 2 what goes to the host.
            if (setup.value != 1) to_host_.clear();
            return setup.value <= 2;
        case modem_control:
            if ((high & 1U) != 0) dtr_ = (low & 1U) != 0;
            if ((high & 2U) != 0) rts_ = (low & 2U) != 0;
            return true;
        case flow_control:
            return true;
        case baud_rate: {
            const unsigned baud = baud_of(setup.value, setup.index);
            if (baud != 0) baud_ = baud;
            return baud != 0;
        }
        case data_format:
            return low == 8;
        case event_character:
            event_character_.reset();
            if (high == 1) event_character_ = static_cast<std::uint8_t>(low);
            return true;
        case latency_timer:
            if (low != 0) latency_ms_ = low;
            return low != 0;
        default:
            return false;
    }
}

void FtdiChip::receive(std::uint8_t byte, Moment arrives) {
    to_host_.push_back({arrives, byte});
}

Moment FtdiChip::next_packet(bool immediate) const {
    Moment next = last_packet_ + std::chrono::milliseconds(latency_ms_);
    if (!to_host_.empty()) {
        if (immediate) next = std::min(next, to_host_.back().arrives);
        if (to_host_.size() >= kMostData) next = std::min(next, to_host_[kMostData - 1].arrives);
        const auto flushing = std::ranges::find_if(
            to_host_, [this](const TimedByte& each) { return each.byte == event_character_; });
        if (flushing != to_host_.end()) next = std::min(next, flushing->arrives);
    }
    return std::max(next, held_back_until_);
}

std::size_t FtdiChip::take_packet(std::span<std::uint8_t> packet, std::size_t most_data,
                                  Moment now) {
    const std::size_t room = std::min({packet.size() - kStatusBytes, most_data, kMostData});
    packet[0] = kModemStatus;
    packet[1] = static_cast<std::uint8_t>(kLineStatus | line_errors_);
    line_errors_ = 0;
    std::size_t size = 0;
    while (size < room && !to_host_.empty() && to_host_.front().arrives <= now) {
        packet[kStatusBytes + size++] = to_host_.front().byte;
        to_host_.pop_front();
    }
    last_packet_ = now;
    const bool cut = size == most_data && !to_host_.empty() && size < kMostData;
    held_back_until_ = cut ? now + std::chrono::milliseconds(latency_ms_) : Moment{0};
    return kStatusBytes + size;
}

}  // namespace dibhr::test::falcon
