// What the human path needs: the built-in sample in memory, and a hand's goals over it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/experiment/hand_motion.hpp"
#include "core/haptics/parameters.hpp"
#include "core/session/session.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

struct HumanOptions {
    std::filesystem::path session{};  ///< goals of a recorded session; empty: none
    std::filesystem::path trace{};    ///< a person's pen or mouse; empty: none
    bool raw_depth{false};            ///< no cleaning
    SurfaceShape shape{};
};

/// Where the hand was in one tick, and which moment of the depth video it touched.
struct RecordedGoal {
    Vec3 goal{0.0};  ///< grid space
    std::int64_t frame{0};
    double blend{0.0};  ///< 0: that frame, 1: the one after it
};

/// The ticks from `lead_in` before the first one in contact on, at most `count`, in order of time;
/// ticks without a finite goal are left out. Throws InputError for a session without a tick in
/// contact.
[[nodiscard]] std::vector<RecordedGoal> read_session_goals(const Session& session, int lead_in,
                                                           int count);

/// The input that moves the hand: a session, a trace, or neither. Checked as far as possible
/// without the sample.
struct HandInput {
    std::string name{};  ///< the file, for messages; empty: the modelled hand
    std::vector<RecordedGoal> session{};
    std::vector<TraceSample> trace{};
};

/// Throws InputError for a session or trace that cannot be used.
[[nodiscard]] HandInput read_hand(const HumanOptions& options);

/// The depth of the sample, cleaned, and its first colour picture.
struct SampleClip {
    DepthClip depth;
    ColourImage colour{};
};

/// Decodes the sample. Throws InputError when it cannot be read.
[[nodiscard]] SampleClip read_sample(const HumanOptions& options, const Progress& progress);

/// The goals over the sample: the session's, the trace's, or a modelled hand's. Throws InputError
/// for a trace that does not move.
[[nodiscard]] PathRun human_goals(const HandInput& hand, const SampleClip& sample, double mu);

}  // namespace dibhr
