// Where a video ends, from its packets: nothing is decoded.
#pragma once

#include <filesystem>
#include <optional>

namespace dibhr {

/// When the last frame of the first video stream ends, as far as its packets are whole, counted
/// from the stream's beginning [s]; looked for from `from_s` on, and from the beginning where that
/// finds none. Nothing when the file cannot be opened, its packets have no times, or the end is too
/// far to look for.
[[nodiscard]] std::optional<double> packets_end_s(const std::filesystem::path& file, double from_s);

}  // namespace dibhr
