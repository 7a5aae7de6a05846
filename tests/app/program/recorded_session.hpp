// Records a session without a window: the real tick over a real video, a scripted hand, and time
// that runs as fast as the machine can.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/haptics/parameters.hpp"
#include "core/video/frames/cleaning_options.hpp"

namespace dibhr::test {

struct RecordedSession {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
    double seconds{1.0};
    CleaningOptions cleaning{};
    TouchParameters parameters{};
    std::filesystem::path bump{};
    std::int64_t ticks_without_surface{0};  ///< at the end
    bool finds_out{false};  ///< what the depth means, as the window does; it is recorded
    bool jumps{false};  ///< from end to end of the picture, under the surface, ten times a second
};

/// The hand goes over the whole picture, in and out of the surface. Halfway the friction changes.
void record_session(const std::filesystem::path& file, const RecordedSession& wanted);

/// A session of a hand that goes to the right in contact, over a depth video of 640 x `depth_rows`
/// pixels that is nowhere.
void write_moving_hand(const std::filesystem::path& file, int ticks, int depth_rows = 480);

}  // namespace dibhr::test
