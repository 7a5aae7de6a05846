// Reads the frames of a colour video for an estimator: their times, and optionally pictures.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace dibhr {

/// The colour video's facts that its depth has to match.
struct ColourFrames {
    std::filesystem::path file{};
    int columns{0}, rows{0};
    bool still{false};
    double start_s{0.0};            ///< by the clock of its file; 0 where no other file shares it
    std::vector<double> times_s{};  ///< of all frames, from the first

    [[nodiscard]] std::size_t count() const noexcept { return times_s.size(); }
    /// Mean interval [s].
    [[nodiscard]] double interval_s() const noexcept;
};

/// The name of a frame's picture without its ending; "000001" is the first.
[[nodiscard]] std::string frame_name(std::size_t number);

/// Called during long work with the frames done, and about how many there are.
using ReportFrames = std::function<void(std::size_t done, std::size_t of)>;

/// Reads all of a video, a picture or a row of them. Throws InputError.
[[nodiscard]] ColourFrames read_colour_frames(const std::filesystem::path& colour,
                                              const std::atomic<bool>& stop,
                                              const ReportFrames& report);

/// The same, and writes the pictures as PNG into the folder, which it empties first; leaves out the
/// numbers in `without`.
[[nodiscard]] ColourFrames write_colour_frames(const std::filesystem::path& colour,
                                               const std::filesystem::path& folder,
                                               const std::set<std::size_t>& without,
                                               const std::atomic<bool>& stop,
                                               const ReportFrames& report);

}  // namespace dibhr
