// Descriptors, the way between chip and board, and the faults on it.
#include "tests/device/falcon/falcon_model.hpp"

#include <algorithm>
#include <utility>

namespace dibhr::test::falcon {

namespace {

constexpr std::uint8_t kOverrun = 0x02;            // line status bit 1
constexpr std::uint8_t kOverrunAndFraming = 0x0A;  // and 3
constexpr std::ptrdiff_t kHalf = 7;                // bytes of a reply
constexpr std::size_t kFullPacket = 62;            // data bytes
// Stray bytes that look like the beginning of a packet.
constexpr std::array<std::uint8_t, 7> kGarbage{0x00, '<', 'A', 'P', '>', '<', 0xF3};

constexpr std::size_t kDeviceDescriptorBytes = 18;
constexpr unsigned kRunTimeBaud = 1'500'000;

FalconBoard::Bytes string_descriptor(const std::string& text) {
    FalconBoard::Bytes bytes{static_cast<std::uint8_t>(2 + 2 * text.size()), 3};
    for (const char letter : text) {
        bytes.push_back(static_cast<std::uint8_t>(letter));
        bytes.push_back(0);
    }
    return bytes;
}

std::size_t copy(std::span<const std::uint8_t> from, std::span<std::uint8_t> to) {
    const std::size_t size = std::min(from.size(), to.size());
    std::copy_n(from.begin(), size, to.begin());
    return size;
}

}  // namespace

std::vector<std::uint8_t> falcon_descriptors() {
    // device/falcon/README.md, USB identity; strings 1 manufacturer, 2 product, 3 serial number.
    return {18,   1,    0x00, 0x02, 0,    0,    0,    8,    0x03,
            0x04, 0x48, 0xCB, 0x00, 0x06, 1,    2,    3,    1,   //
            9,    2,    32,   0,    1,    1,    0,    0xA0, 45,  //
            9,    4,    0,    0,    2,    0xFF, 0xFF, 0xFF, 2,   //
            7,    5,    0x81, 2,    64,   0,    0,               //
            7,    5,    0x02, 2,    64,   0,    0};
}

std::optional<std::size_t> FalconModel::control(const ControlSetup& setup,
                                                std::span<std::uint8_t> data, Moment now) {
    board_.advance(now);
    if ((setup.type & 0x60U) == 0) return standard_request(setup, data);
    const bool dtr = chip_.dtr();
    const auto answer = chip_.control(setup, data);
    if (chip_.dtr() != dtr) board_.dtr_changed(chip_.dtr());
    return answer;
}

std::optional<std::size_t> FalconModel::standard_request(const ControlSetup& setup,
                                                         std::span<std::uint8_t> data) const {
    constexpr std::uint8_t kGetDescriptor = 6;
    if (setup.type != 0x80) return 0;  // set configuration, set interface, clear feature
    if (setup.request != kGetDescriptor) {
        std::ranges::fill(data, std::uint8_t{0});  // get status
        return data.size();
    }
    const auto descriptors = falcon_descriptors();
    const std::span<const std::uint8_t> all(descriptors);
    const unsigned index = setup.value & 0xFFU;
    switch (setup.value >> 8U) {
        case 1:
            return copy(all.first(kDeviceDescriptorBytes), data);
        case 2:
            return copy(all.subspan(kDeviceDescriptorBytes), data);
        case 3:
            if (index == 0) return copy(std::array<std::uint8_t, 4>{4, 3, 9, 4}, data);
            if (index == 1) return copy(string_descriptor("Simulated"), data);
            if (index == 2) return copy(string_descriptor("FALCON HAPTIC"), data);
            if (index == 3) return copy(string_descriptor(serial_), data);
            return std::nullopt;
        default:
            return std::nullopt;
    }
}

Moment FalconModel::byte_time() const {
    constexpr std::int64_t kTenBits_ns = 10'000'000'000;
    return Moment{realtime ? kTenBits_ns / chip_.baud() : 0};
}

void FalconModel::out(std::span<const std::uint8_t> bytes, Moment now) {
    board_.advance(now);
    traffic_.bytes_out += bytes.size();
    if (chip_.baud() != kRunTimeBaud) traffic_.slow_bytes += bytes.size();
    for (const std::uint8_t byte : bytes) {
        now += byte_time();
        const bool running = board_.stage() == BoardStage::running;
        auto answer = board_.receive(byte, chip_.baud(), faults, now);
        if (answer.empty()) continue;
        if (running) spoil(answer);
        send(answer, now);
    }
}

void FalconModel::spoil(FalconBoard::Bytes& reply) {
    if (strikes(faults.lost_to_overrun)) {
        chip_.report_line_error(kOverrunAndFraming);
        reply.clear();
        return;
    }
    if (std::exchange(half_out_, false)) {
        chip_.report_line_error(kOverrun);
        reply.erase(reply.begin(), reply.begin() + kHalf);
        return;
    }
    if (strikes(faults.lost_halves)) {
        half_out_ = true;
        reply.resize(kHalf);
        return;
    }
    if (strikes(faults.garbage_before)) {
        reply.insert(reply.begin(), kGarbage.begin(), kGarbage.end());
    }
    if (strikes(faults.garbage_inside)) {
        reply.insert(reply.begin() + 7, kGarbage.begin(), kGarbage.end());
    }
    if (!waiting_reply_.empty()) {
        reply.insert(reply.begin(), waiting_reply_.begin(), waiting_reply_.end());
        waiting_reply_.clear();
    } else if (strikes(faults.merged_replies)) {
        waiting_reply_ = std::exchange(reply, {});
    }
}

void FalconModel::send(const FalconBoard::Bytes& bytes, Moment now) {
    line_free_ = std::max(line_free_, now);
    for (const std::uint8_t byte : bytes) {
        line_free_ += byte_time();
        chip_.receive(byte, line_free_);
    }
}

Moment FalconModel::next_in() const {
    return chip_.next_packet(!realtime);
}

std::size_t FalconModel::in(std::span<std::uint8_t> packet, Moment now) {
    board_.advance(now);
    if (next_in() > now) return 0;
    const std::size_t most =
        faults.split_to > 0 ? static_cast<std::size_t>(faults.split_to) : kFullPacket;
    const std::size_t size = chip_.take_packet(packet, most, now);
    traffic_.bytes_in += size - 2;
    ++traffic_.packets_in;
    if (size == 2) ++traffic_.empty_packets_in;
    return size;
}

void FalconModel::power_cycle() {
    board_.set_powered(true);
    waiting_reply_.clear();
}

}  // namespace dibhr::test::falcon
