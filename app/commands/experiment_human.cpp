// Decodes the sample and reads the hand.
#include "app/commands/experiment_human.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

#include "app/settings/assets_path.hpp"
#include "core/error.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

namespace {

constexpr int kLeadIn = 500;  // ticks before a session's first contact

/// Goals over another video would touch nothing, or the wrong thing.
void check_is_of_sample(const Session& session) {
    const std::filesystem::path sample = sample_files().depth;
    const MediaDescription description = open_depth(sample)->description();
    const std::string depth = std::filesystem::path(session.fact("depth")).filename().string();
    const bool same_name = depth.empty() || depth == sample.filename().string();
    const bool same_size =
        session.fact("depth-columns") == std::to_string(description.depth_columns) &&
        session.fact("depth-rows") == std::to_string(description.depth_rows);
    if (same_name && same_size) return;
    throw InputError(session.file().string() +
                     ": was recorded over another video; record one over the built-in sample: "
                     "dibhr --record FILE");
}

PathRun session_path(const HandInput& hand, const DepthClip& sample, double mu) {
    PathRun path;
    path.name = "human";
    path.source = "a recorded session, " + hand.name;
    path.mu = mu;
    for (const RecordedGoal& tick : hand.session) {
        path.goals.push_back(tick.goal);
        path.times_s.push_back(sample.time_of(tick.frame, tick.blend));
    }
    survey_path(path, sample);
    return path;
}

HandMotion motion_of(const HandInput& hand, const ImageArea& area) {
    if (hand.trace.empty()) return modelled_hand(area);
    HandMotion motion = motion_of_trace(hand.trace, hand.name);
    try {
        fit_into(motion, area);
    } catch (const InputError& error) {
        throw InputError(hand.name + ": " + error.what());
    }
    return motion;
}

/// The first picture of the colour video.
ColourImage first_colour(const SampleFiles& files) {
    auto frame = open_media(files.colour, files.depth)->next();
    return frame ? std::move(frame->colour) : ColourImage{};
}

}  // namespace

std::vector<RecordedGoal> read_session_goals(const Session& session, int lead_in, int count) {
    std::vector<RecordedGoal> goals;
    const auto lead = static_cast<std::size_t>(std::max(lead_in, 0));
    const auto most = static_cast<std::size_t>(std::max(count, 0));
    std::deque<RecordedGoal> before;  // the first contact
    bool touched = false;
    Session::Ticks ticks(session);
    for (TickRecord tick; ticks.next(tick);) {
        if (!tick.surface || !is_finite(tick.goal)) continue;
        const RecordedGoal one{tick.goal, tick.frames.from_frame, tick.blend};
        if (!touched && !tick.contact) {
            before.push_back(one);
            if (before.size() > lead) before.pop_front();
            continue;
        }
        if (!touched) goals.assign(before.begin(), before.end());
        touched = true;
        goals.push_back(one);
        if (goals.size() >= most) break;
    }
    if (!touched)
        throw InputError(session.file().string() +
                         ": nothing is touched in it; record a session with contact");
    goals.resize(std::min(goals.size(), most));
    return goals;
}

HandInput read_hand(const HumanOptions& options) {
    HandInput hand;
    if (!options.session.empty()) {
        hand.name = options.session.filename().string();
        const Session session(options.session);
        hand.session = read_session_goals(session, kLeadIn, kExperimentUpdates);
        check_is_of_sample(session);
    } else if (!options.trace.empty()) {
        hand.name = options.trace.filename().string();
        hand.trace = read_trace(options.trace);
    }
    return hand;
}

SampleClip read_sample(const HumanOptions& options, const Progress& progress) {
    const SampleFiles files = sample_files();
    const CleaningOptions cleaning{.preset = options.raw_depth ? CleaningPreset::raw
                                                               : CleaningPreset::gentle};
    return {read_depth_clip(open_depth(files.depth), cleaning, options.shape, progress),
            first_colour(files)};
}

PathRun human_goals(const HandInput& hand, const SampleClip& sample, double mu) {
    if (!hand.session.empty()) return session_path(hand, sample.depth, mu);
    return human_path(motion_of(hand, foreground_area(sample.depth)), sample.depth, mu);
}

}  // namespace dibhr
