// What playback measures of its frames, and what it leaves out for want of time.
#include <algorithm>
#include <string>

#include "core/video/playing/playback.hpp"

namespace dibhr {
namespace {

constexpr double kLeastLoad = 0.4, kMostLoad = 2.0;
constexpr unsigned kFewProcessors = 2;  ///< none is free beside drawing in software

}  // namespace

double Playback::interval_s() const {
    const double rate = description().frames_per_s;
    return rate > 0.0 ? 1.0 / rate : 0.0;
}

/// The filter in time needs every frame decoded and cleaned.
FrameCosts Playback::measured_costs() const {
    if (filters_in_time()) return {.decoding_s = each_frame_s_, .cleaning_s = cleaning_s_};
    const double conversion_s = reader_->conversion_s();
    return {.decoding_s = reader_->decoding_s(),
            .conversion_s = conversion_s,
            .cleaning_s = cleaning_s_,
            .side_by_side = conversion_s > 0.0 && processors_ > kFewProcessors};
}

/// The measured times, each as much longer as they do not explain how long a frame takes in all.
FrameCosts Playback::costs() const {
    FrameCosts costs = measured_costs();
    const double load = costs.side_by_side ? std::max(load_, 1.0) : load_;
    costs.decoding_s *= load;
    costs.conversion_s *= load;
    costs.cleaning_s *= load;
    return costs;
}

void Playback::forget_costs() {
    cleaning_s_ = each_frame_s_ = 0.0;
    load_ = 1.0;
}

/// Adds the times of the newest frame: `took_s` in all, `waited_s` of it for the decoder. The first
/// one after a jump takes longer.
void Playback::add_cost(double took_s, double waited_s) {
    if (starts_) return;
    if (filters_in_time()) {
        const double finish_s = std::min(1e-3 * cost().finish_ms, took_s);
        cleaning_s_ = steady_mean(cleaning_s_, finish_s);
        each_frame_s_ = steady_mean(each_frame_s_, (took_s - finish_s) / read_frames_);
        return;
    }
    cleaning_s_ = steady_mean(cleaning_s_, std::max(took_s - waited_s, 0.0));
    const double explained_s = frame_time_s(measured_costs(), read_frames_);
    if (!(explained_s > 0.0)) return;
    load_ = std::clamp(steady_mean(load_, took_s / explained_s), kLeastLoad, kMostLoad);
}

/// Sets the speed of the clock, too, which goes on from where it is.
void Playback::update_plan(Time now) {
    plan_ =
        plan_of(is_open() ? costs() : FrameCosts{}, is_open() ? interval_s() : 0.0, speed_, plan_);
    const double moment_s = moment(now);
    if (clock_.speed != (playing_ ? plan_.speed : 0.0)) anchor(moment_s, now);
}

/// Leaves out steps of the cleaning first, then pictures of the window; the other way round back.
void Playback::degrade() {
    const bool cleans = cleaning_.preset == CleaningPreset::automatic && !prepared().found();
    const bool draws_less = drawing_rate_.most_per_s() > 0.0;
    if (cleans && !draws_less && degradation_.update(steps(), costs(), interval_s(), speed_))
        return apply_degradation();
    if (draws_less || !cleans || degradation_.leaves_out_all(steps()))
        drawing_rate_.update(drawing_cost_, costs(), interval_s(), speed_);
}

std::string Playback::dropped_in_words() const {
    std::string words = in_words(plan_, costs(), description().frames_per_s, speed_);
    const auto add = [&words](const char* sentence) {
        words += words.empty() ? sentence : std::string(" ") + sentence;
    };
    if (falls_behind_ && words.empty()) add("The clock waited for frames.");
    const std::string left_out = left_out_in_words(steps(), reader_->degradation());
    if (!left_out.empty()) add(left_out.c_str());
    if (const std::string drawn = drawing_rate_.in_words(); !drawn.empty()) add(drawn.c_str());
    const MotionRequest done = reader_->affordable_motion();
    if (motion_request_.motion && !done.motion)
        add("Motion is off.");
    else if (motion_request_.in_betweens && !done.in_betweens)
        add("In-betweens are off.");
    return words;
}

double Playback::shown_per_s() const {
    return description().frames_per_s / (1.0 + skipped_frames_);
}

}  // namespace dibhr
