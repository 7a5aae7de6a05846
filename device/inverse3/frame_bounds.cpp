// Where one frame of a WebSocket ends.
#include "device/inverse3/frame_bounds.hpp"

#include <algorithm>

namespace dibhr::inverse3 {

std::size_t FrameBounds::take(std::span<const std::uint8_t> bytes) noexcept {
    if (in_http_) return take_http(bytes);
    std::size_t taken = 0;
    while (left_ == 0 && taken < bytes.size()) {
        add_to_head(bytes[taken++]);
        if (head_size_ < head_length()) continue;
        left_ = payload_length();
        head_size_ = 0;
        if (left_ == 0) return taken;  // the frame is empty
    }
    const auto here =
        static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size() - taken));
    left_ -= here;
    return taken + here;
}

std::size_t FrameBounds::take_http(std::span<const std::uint8_t> bytes) noexcept {
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        const std::uint8_t wanted = line_ends_ % 2 == 0 ? '\r' : '\n';
        line_ends_ = bytes[k] == wanted ? line_ends_ + 1 : (bytes[k] == '\r' ? 1 : 0);
        if (line_ends_ == 4) {
            in_http_ = false;
            return k + 1;
        }
    }
    return bytes.size();
}

void FrameBounds::add_to_head(std::uint8_t byte) noexcept {
    head_[head_size_++] = byte;
}

std::size_t FrameBounds::head_length() const noexcept {
    if (head_size_ < 2) return 2;
    const unsigned length = head_[1] & 0x7FU;
    const std::size_t mask =
        (head_[1] & 0x80U) != 0 ? 4 : 0;  // from a service that breaks the rule
    return 2 + (length == 126 ? 2U : length == 127 ? 8U : 0U) + mask;
}

std::uint64_t FrameBounds::payload_length() const noexcept {
    const unsigned length = head_[1] & 0x7FU;
    if (length < 126) return length;
    std::uint64_t told = 0;
    const std::size_t bytes = length == 126 ? 2 : 8;
    for (std::size_t k = 0; k < bytes; ++k) told = told << 8U | head_[2 + k];
    return told;
}

}  // namespace dibhr::inverse3
