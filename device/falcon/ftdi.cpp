// What the FT232R's IN packets hold (README.md, IN packets).
#include "device/falcon/ftdi.hpp"

#include <algorithm>

namespace dibhr::falcon {

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
