// The frames of a colour video as an estimator gets them: when each is shown, and its picture.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace dibhr {

/// What the depth of a colour video has to be like.
struct ColourFrames {
    std::filesystem::path file{};
    int columns{0}, rows{0};
    bool still{false};
    double start_s{0.0};            ///< by the clock of its file; 0 where that is nobody else's
    std::vector<double> times_s{};  ///< of all frames, from the first

    [[nodiscard]] std::size_t count() const noexcept { return times_s.size(); }
    /// Of a frame, about [s].
    [[nodiscard]] double interval_s() const noexcept;
};

/// "000001" is the first: the name of its picture without its ending.
[[nodiscard]] std::string frame_name(std::size_t number);

/// How often what takes long is told: frames done, of about so many.
using FramesTold = std::function<void(std::size_t done, std::size_t of)>;

/// Reads all of a video, a picture or a row of them. Throws InputError.
[[nodiscard]] ColourFrames read_colour_frames(const std::filesystem::path& colour,
                                              const std::atomic<bool>& stop,
                                              const FramesTold& tell);

/// The same, and writes its pictures into the folder as PNG, which is emptied first; without those
/// whose numbers are in `without`.
[[nodiscard]] ColourFrames write_colour_frames(const std::filesystem::path& colour,
                                               const std::filesystem::path& folder,
                                               const std::set<std::size_t>& without,
                                               const std::atomic<bool>& stop,
                                               const FramesTold& tell);

}  // namespace dibhr
