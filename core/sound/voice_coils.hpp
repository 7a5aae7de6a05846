// Where the voice coils of a game pad are among the channels of its sound device.
#pragma once

#include <span>
#include <string_view>

namespace dibhr {

inline constexpr int kFewestCoilChannels = 4;  ///< a pad with two has a loudspeaker only

/// Whether a sound device of that name and so many channels (0: not known) moves voice coils.
/// See app/sound/README.md for the pads and where their names come from.
[[nodiscard]] bool has_voice_coils(std::string_view device, int channels) noexcept;

/// Lays one channel into the last two of frames of so many, which are the rear pair of four and of
/// six as SDL orders them, and silence into all others. `frames` holds `mono.size() * channels`
/// samples; with less than four channels, all is silence.
void spread_to_rear(std::span<const float> mono, std::span<float> frames, int channels) noexcept;

}  // namespace dibhr
