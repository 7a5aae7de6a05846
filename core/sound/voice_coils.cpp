// Names of pads with voice coils, and the way into their channels.
#include "core/sound/voice_coils.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace dibhr {

namespace {

// The second name is that of a DualSense with its first firmware, and that of a DualShock 4, which
// has two channels.
constexpr std::array<std::string_view, 2> kPads{"DualSense", "Wireless Controller"};

}  // namespace

bool has_voice_coils(std::string_view device, int channels) noexcept {
    if (channels != 0 && channels < kFewestCoilChannels) return false;
    return std::any_of(kPads.begin(), kPads.end(), [device](std::string_view pad) {
        return device.find(pad) != std::string_view::npos;
    });
}

void spread_to_rear(std::span<const float> mono, std::span<float> frames, int channels) noexcept {
    std::fill(frames.begin(), frames.end(), 0.0F);
    if (channels < kFewestCoilChannels) return;
    const auto step = static_cast<std::size_t>(channels);
    const std::size_t count = std::min(mono.size(), frames.size() / step);
    for (std::size_t k = 0; k < count; ++k)
        frames[(k + 1) * step - 2] = frames[(k + 1) * step - 1] = mono[k];
}

}  // namespace dibhr
