// What the FT232R's packets hold.
#include "device/falcon/usb.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::falcon;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kModem = 0x01;
constexpr std::uint8_t kIdle = 0x60;

/// A transfer of one packet with these bytes.
Bytes packet(std::uint8_t line, const Bytes& data) {
    Bytes transfer(2 + data.size());
    transfer[0] = kModem;
    transfer[1] = line;
    std::copy(data.begin(), data.end(), transfer.begin() + 2);
    return transfer;
}

Bytes data_of(Bytes transfer) {
    const Payload payload = payload_of(transfer);
    return {payload.bytes.begin(), payload.bytes.end()};
}

}  // namespace

TEST_CASE("a packet of two status bytes holds nothing and is no error", "[ftdi]") {
    Bytes transfer = packet(kIdle, {});
    const Payload payload = payload_of(transfer);
    CHECK(payload.bytes.empty());
    CHECK(payload.line_errors == 0);
    CHECK(payload.faulty_packets == 0);
}

TEST_CASE("status bytes are taken off at every multiple of 64, whatever the data", "[ftdi]") {
    std::mt19937 dice(7);
    const std::size_t full_packets = GENERATE(0U, 1U, 2U, 7U);
    const std::size_t rest = GENERATE(0U, 1U, 14U, 61U);
    CAPTURE(full_packets, rest);
    Bytes transfer;
    Bytes sent;
    for (std::size_t k = 0; k <= full_packets; ++k) {
        Bytes data(k < full_packets ? kMostDataBytes : rest);
        for (auto& byte : data) byte = static_cast<std::uint8_t>(dice());
        const Bytes one = packet(kIdle, data);
        transfer.insert(transfer.end(), one.begin(), one.end());
        sent.insert(sent.end(), data.begin(), data.end());
    }
    CHECK(data_of(transfer) == sent);
}

TEST_CASE("a transfer that ends within the status bytes holds nothing", "[ftdi]") {
    CHECK(data_of({}).empty());
    CHECK(data_of({kModem}).empty());
    Bytes cut = packet(kIdle, Bytes(kMostDataBytes, 'x'));
    cut.push_back(kModem);
    CHECK(data_of(cut) == Bytes(kMostDataBytes, 'x'));
}

TEST_CASE("overrun, parity and framing are told, and the rest of the line's bits are not",
          "[ftdi]") {
    const std::uint8_t line = GENERATE(kOverrun, kParityError, kFramingError);
    Bytes transfer = packet(kIdle | line, Bytes(kMostDataBytes, 'x'));
    const Bytes good = packet(kIdle | 0x91, {'y'});
    transfer.insert(transfer.end(), good.begin(), good.end());
    const Payload payload = payload_of(transfer);
    CHECK(payload.line_errors == line);
    CHECK(payload.faulty_packets == 1);
    CHECK(payload.bytes.size() == kMostDataBytes + 1);
}
