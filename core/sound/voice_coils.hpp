// Finds game pads with voice coils, and fills the channels of their sound device.
#pragma once

#include <span>
#include <string_view>

namespace dibhr {

inline constexpr int kFewestCoilChannels = 4;  ///< two channels: only a loudspeaker

/// Whether a sound device of that name and so many channels (0: not known) moves voice coils.
/// See app/sound/README.md for the pads and where their names come from.
[[nodiscard]] bool has_voice_coils(std::string_view device, int channels) noexcept;

/// Copies one channel into the last two of each frame of `channels`, the rear pair of four and of
/// six in SDL's order, and silence into the others. `frames` holds `mono.size() * channels`
/// samples; with less than four channels, all is silence.
void spread_to_rear(std::span<const float> mono, std::span<float> frames, int channels) noexcept;

}  // namespace dibhr
