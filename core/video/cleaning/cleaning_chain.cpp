// The steps of cleaning, one after the other.
#include "core/video/cleaning/cleaning_chain.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// Noise below this part of the highest level is not felt (0.15 px of 255, 0.005 N at 0.5 N/mm).
constexpr float kPerceptibleNoise = 0.15F / 255.0F;
/// Depth with little noise may have ramps all the same.
constexpr CleaningSteps kLowNoiseSteps{.remove_spikes = true,
                                       .fill_holes = true,
                                       .sharpen_silhouettes = true,
                                       .smooth_steps = true,
                                       .smooth_outlines = true};
/// Ramps that are no outlines, as an estimator's, may become steps.
constexpr CleaningSteps kWithoutSilhouettes = [] {
    CleaningSteps steps = kSensorSteps;
    steps.sharpen_silhouettes = false;
    return steps;
}();
/// Seen ground keeps its levels.
constexpr CleaningSteps kHolesAndOutlines{.fill_holes = true, .smooth_outlines = true};
/// All that is seen keeps its level.
constexpr CleaningSteps kHolesAlone{.fill_holes = true};
constexpr double kReportedRelief_px = 255.0;

/// Scratch memory of pictures larger than 4K video is freed: it is several times as large as the
/// picture, and few such pictures follow each other.
constexpr std::size_t kLarge = 9'000'000;

template <typename... Scratch>
void free_if_large(std::size_t pixels, Scratch&... scratch) {
    if (pixels > kLarge) ((scratch = Scratch{}), ...);
}

bool is_touchable(const DepthImage& image) {
    return image.columns >= 2 && image.rows >= 2;
}

/// Pixels without data become the farthest level, and are marked as unseen.
DIBHR_VECTOR_CLONES void make_farthest(float* __restrict levels, std::uint8_t* __restrict unseen,
                                       std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        const bool hole = levels[k] != levels[k];
        levels[k] = hole ? 0.0F : levels[k];
        unseen[k] = static_cast<std::uint8_t>(hole ? 1 : unseen[k]);
    }
}

DIBHR_VECTOR_CLONES void add_marks(const std::uint8_t* more, std::uint8_t* __restrict marks,
                                   std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
        marks[k] = static_cast<std::uint8_t>(marks[k] | more[k]);
}

CleaningSteps steps_of(const CleaningOptions& options, const DepthNoise& noise, std::size_t pixels,
                       const std::optional<FeltCleaning>& felt) {
    switch (options.preset) {
        case CleaningPreset::raw:
            return kRawSteps;
        case CleaningPreset::gentle:
            return kGentleSteps;
        case CleaningPreset::sensor:
            return kSensorSteps;
        case CleaningPreset::own:
            return options.own;
        case CleaningPreset::automatic:
            break;
    }
    if (felt) return felt->steps;
    const bool small = pixels <= kMostPixelsForSensor;
    const bool shakes = noise.at(0.5F) > kPerceptibleNoise || noise.per_frame_scale;
    return shakes && small ? kSensorSteps : kLowNoiseSteps;
}

/// Whether the steps are a preset's, which sparse depth adds one to.
bool may_densify(const CleaningOptions& options) {
    return options.preset != CleaningPreset::raw && options.preset != CleaningPreset::own;
}

}  // namespace

bool needs_noise(const CleaningOptions& options) {
    return options.preset == CleaningPreset::automatic ||
           options.preset == CleaningPreset::sensor ||
           (options.preset == CleaningPreset::own && depend_on_noise(options.own));
}

CleaningPlan plan_of(const CleaningOptions& options, const DepthNoise& noise, std::size_t pixels,
                     bool is_sparse, const std::optional<FeltCleaning>& felt) {
    CleaningPlan plan{steps_of(options, noise, pixels, felt), options.finger, noise, {}};
    if (options.preset == CleaningPreset::automatic) plan.felt = felt;
    if (is_sparse && may_densify(options)) plan.steps.densify = true;
    return plan;
}

std::vector<CleaningSteps> ways_of_automatic(std::size_t pixels) {
    std::vector<CleaningSteps> ways{kLowNoiseSteps};
    if (pixels <= kMostPixelsForSensor)
        ways.insert(ways.end(), {kSensorSteps, kWithoutSilhouettes});
    ways.insert(ways.end(), {kGentleSteps, kHolesAndOutlines, kHolesAlone});
    return ways;
}

std::string in_words(const CleaningOptions& options, const CleaningPlan& plan) {
    std::string words(name_of(options.preset));
    if (options.preset == CleaningPreset::automatic) {
        words += plan.steps.smooth_noise      ? ": sensor"
                 : plan.steps.remove_spikes   ? ": gentle"
                 : plan.steps.smooth_outlines ? ": holes and outlines"
                                              : ": holes alone";
        if (plan.steps.smooth_noise != plan.steps.sharpen_silhouettes)
            words += plan.steps.smooth_noise ? " without silhouettes" : ", silhouettes";
    }
    if (plan.steps.densify && may_densify(options)) words += ", densified";
    if (!needs_noise(options)) return words;
    const auto px = [](float noise) {
        return short_text(std::round(kReportedRelief_px * 100.0 * static_cast<double>(noise)) /
                          100.0);
    };
    const std::string near = px(plan.noise.at(1.0F));
    const std::string far = px(plan.noise.at(0.0F));
    words += ", noise " + near + (far == near ? "" : " to " + far) + " px" +
             (plan.noise.per_frame_scale ? ", a scale a frame" : "");
    if (!plan.felt) return words;
    const auto parts = [](double value, double of_one) {
        return short_text(std::round(value * of_one) / of_one);
    };
    words += "; a slide buzzes by " + parts(plan.felt->buzz_N, 1000.0) + " N, " +
             parts(plan.felt->raw_N, 1000.0) + " raw";
    if (plan.felt->relief)
        words += ", " + parts(100.0 * *plan.felt->relief, 1.0) + " % of relief kept";
    return words;
}

void CleaningChain::densify(DepthImage& image, const ColourImage* colour) {
    interpolated_.resize(image.levels.size());
    (void)mark_holes(image.levels.data(), interpolated_.data(), interpolated_.size());
    sparse_.fill(image, colour);
}

std::span<const HeldLevel> CleaningChain::in_holes(std::span<const HeldLevel> held,
                                                   const DepthImage& image) {
    held_in_holes_.clear();
    for (const HeldLevel& level : held)
        if (std::isnan(image.levels[level.index])) held_in_holes_.push_back(level);
    return held_in_holes_;
}

/// Holes that stay without data become the farthest level.
void CleaningChain::close_holes(SingleFrameDepth& single_frame, bool fill,
                                std::span<const HeldLevel> held) {
    std::vector<float>& levels = single_frame.depth.levels;
    single_frame.filled.resize(levels.size());
    (void)mark_holes(levels.data(), single_frame.filled.data(), levels.size());
    single_frame.unseen.assign(levels.size(), 0);
    if (fill) {
        seen_ = single_frame.depth;
        held_.fill(single_frame.depth, held);
        small_holes_.fill(single_frame.depth);
        large_holes_.fill(single_frame.depth, seen_, spikes_.rejected(), single_frame.unseen);
    }
    if (has_holes(single_frame.depth))
        make_farthest(levels.data(), single_frame.unseen.data(), levels.size());
    if (std::memchr(single_frame.unseen.data(), 1, single_frame.unseen.size()) == nullptr)
        single_frame.unseen.clear();
}

SingleFrameDepth CleaningChain::clean_frame(DepthImage image, const CleaningPlan& plan,
                                            std::span<const HeldLevel> held,
                                            const ColourImage* colour) {
    static std::atomic<std::uint64_t> made{0};
    SingleFrameDepth single_frame{std::move(image), {}, {}, 0, plan.steps, -1, ++made};
    const bool touchable = is_touchable(single_frame.depth);
    if (touchable && plan.steps.smooth_outlines) single_frame.teeth = teeth_of(single_frame.depth);
    interpolated_.clear();
    if (touchable && plan.steps.densify && has_holes(single_frame.depth)) {
        densify(single_frame.depth, colour);
        held = in_holes(held, single_frame.depth);
    }
    spikes_.forget();
    const float noise = plan.noise.at(0.5F) * static_cast<float>(single_frame.depth.highest_level);
    const bool removes = touchable && plan.steps.remove_spikes;
    if (removes) spikes_.remove(single_frame.depth, depend_on_noise(plan.steps) ? noise : 0.0F);
    if (removes ? spikes_.left_holes() : has_holes(single_frame.depth))
        close_holes(single_frame, touchable && plan.steps.fill_holes, held);
    if (!interpolated_.empty()) {
        single_frame.filled.resize(interpolated_.size());
        add_marks(interpolated_.data(), single_frame.filled.data(), interpolated_.size());
    }
    const std::size_t pixels = single_frame.depth.levels.size();
    free_if_large(pixels, sparse_, interpolated_, spikes_, seen_, held_, small_holes_,
                  large_holes_);
    if (touchable && plan.steps.sharpen_silhouettes) {
        silhouettes_.sharpen(single_frame.depth, plan.steps.colour_edges ? colour : nullptr, noise);
        free_if_large(pixels, silhouettes_);
    }
    return single_frame;
}

Frame CleaningChain::clean_and_finish(DepthImage image, const CleaningPlan& plan,
                                      std::span<const HeldLevel> held) {
    return felt(settle(clean_frame(std::move(image), plan, held), plan));
}

DepthImage CleaningChain::filtered_in_time(std::span<const SingleFrameDepth* const> frames,
                                           std::size_t now, const DepthNoise& noise) {
    if (noise.per_frame_scale) {  // farther frames have scales of their own
        const std::size_t first = now - std::min(now, kNearInTime);
        frames =
            frames.subspan(first, std::min(frames.size() - first, now - first + kNearInTime + 1));
        now -= first;
        frames = scale_.on_one_scale(frames, now);
    }
    return temporal_.filtered(frames, now, noise);
}

SettledDepth CleaningChain::settle(std::span<const SingleFrameDepth* const> frames, std::size_t now,
                                   const CleaningPlan& plan) {
    const SingleFrameDepth& here = *frames[now];
    const bool steady = plan.steps.steady && frames.size() > 1;
    const std::shared_ptr<DepthImage> made =
        here.depth.levels.size() > kLarge ? std::make_shared<DepthImage>() : images_.take();
    if (steady)
        *made = filtered_in_time(frames, now, plan.noise);
    else
        *made = here.depth;
    return smoothed(made, here, steady, plan);
}

SettledDepth CleaningChain::settle(SingleFrameDepth&& alone, const CleaningPlan& plan) {
    const std::shared_ptr<DepthImage> made =
        alone.depth.levels.size() > kLarge ? std::make_shared<DepthImage>(std::move(alone.depth))
                                           : images_.share(std::move(alone.depth));
    return smoothed(made, alone, false, plan);
}

/// The steps after the filter in time, of the depth in `made`.
SettledDepth CleaningChain::smoothed(std::shared_ptr<DepthImage> made, const SingleFrameDepth& of,
                                     bool steady, const CleaningPlan& plan) {
    DepthImage& depth = *made;
    std::vector<std::uint8_t> unseen = of.unseen;
    if (is_touchable(depth)) {
        if (plan.steps.smooth_steps && is_eight_bit(depth))
            steps_.smooth(depth);
        else if (plan.steps.smooth_steps && depend_on_noise(plan.steps))
            steps_.smooth_measured(depth, plan.noise);
        if (plan.steps.smooth_noise && steady)
            noise_.smooth(depth, plan.noise, temporal_.evidence());
        else if (plan.steps.smooth_noise)
            noise_.smooth(depth, plan.noise);
        if (plan.steps.smooth_outlines) outlines_.smooth(depth, of.teeth, unseen);
    }
    if (unseen.empty()) return {made, nullptr, plan};
    return {made, std::make_shared<const std::vector<std::uint8_t>>(std::move(unseen)), plan};
}

Frame CleaningChain::felt(const SettledDepth& settled, Frame frame) {
    const CleaningPlan& plan = settled.plan;
    frame.depth = settled.depth;
    frame.unseen = settled.unseen;
    if (is_touchable(*frame.depth) && plan.finger.radius_px > 0.0) {
        frame.undilated = settled.depth;
        const std::shared_ptr<DepthImage> made = images_.take();
        *made = finger_.dilated(*settled.depth, plan.finger, std::move(*made));
        frame.depth = made;
    }
    frame.cleaning = {plan.steps, plan.finger};
    return frame;
}

}  // namespace dibhr
