// Chooses where and when a recording is touched, and reads its frames there.
#include "tests/bench/feel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/playing/clip_trial.hpp"
#include "core/video/playing/held_levels_media.hpp"
#include "tests/support/pressing_finger.hpp"

namespace dibhr::bench {

namespace {

constexpr double kTouched_s = 3.0;
constexpr double kAfter_s = 0.5;    ///< more, to know how lost data went on
constexpr double kBefore_s = 0.25;  ///< more, to clean its first frames with
constexpr std::size_t kMostMoments = 12;

constexpr double kSlide_mm_per_s = 100.0;
constexpr int kStroke_px = 60;
constexpr int kSmoothed_px = 4;  ///< to each side, before the slope is taken
constexpr double kSteepest = 0.8;
constexpr int kTries = 300;  ///< at finding such a stroke

constexpr std::size_t kBlemishesEvery = 15;  ///< frames

/// A part of a recording.
struct Stretch {
    std::vector<Frame> frames{};    ///< cleaned
    std::vector<DepthImage> raw{};  ///< NaN is no data
    std::size_t milliseconds{0};    ///< that are touched: the frames go on a little
};

/// Finds which pixels change, and when there are frames.
class Survey {
  public:
    explicit Survey(Media& media) {
        media.seek(0.0);
        DepthImage before;
        while (std::optional<RawFrame> frame = media.next()) {
            times_s_.push_back(frame->media_s);
            if (times_s_.size() == 1) begin(frame->depth);
            if (frame->depth.levels.size() != change_.size())
                throw InputError("the pictures differ in size; choose another recording");
            if (times_s_.size() > 1) add_change(before, frame->depth);
            before = std::move(frame->depth);
        }
        if (times_s_.empty()) throw InputError("holds no picture; choose another recording");
    }

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] std::int64_t frames() const { return static_cast<std::int64_t>(times_s_.size()); }
    [[nodiscard]] double seconds() const { return times_s_.back() - times_s_.front(); }

    /// Beginnings of stretches that overlap by half at most.
    [[nodiscard]] std::vector<double> moments_s(int spots) const {
        const double touched_s = std::min(kTouched_s, seconds());
        const double room_s = seconds() - touched_s;
        const auto fit = static_cast<std::size_t>(touched_s > 0.0 ? 2.0 * room_s / touched_s : 0.0);
        const std::size_t most = std::min(kMostMoments, static_cast<std::size_t>(spots));
        const std::size_t count =
            std::clamp<std::size_t>(fit + 1, 1, std::max<std::size_t>(most, 1));
        std::vector<double> moments;
        for (std::size_t k = 0; k < count; ++k) {
            const double share =
                count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 0.0;
            moments.push_back(times_s_.front() + share * room_s);
        }
        return moments;
    }

    /// Pixels whose level changes less than in half of them, of those that have data in half of
    /// the frames and the next one.
    [[nodiscard]] std::vector<std::size_t> quieter_half() const {
        std::vector<std::size_t> known;
        for (std::size_t k = 0; k < change_.size(); ++k)
            if (pairs_[k] > 0 && pairs_[k] >= times_s_.size() / 2) known.push_back(k);
        const auto mean = [this](std::size_t k) {
            return static_cast<double>(change_[k]) / pairs_[k];
        };
        std::stable_sort(known.begin(), known.end(),
                         [&](std::size_t a, std::size_t b) { return mean(a) < mean(b); });
        known.resize((known.size() + 1) / 2);
        return known;
    }

  private:
    void begin(const DepthImage& first) {
        columns_ = first.columns;
        rows_ = first.rows;
        change_.assign(first.levels.size(), 0.0F);
        pairs_.assign(first.levels.size(), 0);
    }
    void add_change(const DepthImage& before, const DepthImage& now) {
        for (std::size_t k = 0; k < change_.size(); ++k) {
            const float change = std::fabs(now.levels[k] - before.levels[k]);
            if (std::isnan(change)) continue;
            change_[k] += change;
            ++pairs_[k];
        }
    }

    int columns_{0};
    int rows_{0};
    std::vector<double> times_s_{};
    std::vector<float> change_{};         ///< from frame to frame, added up
    std::vector<std::uint32_t> pairs_{};  ///< of frames in which both had data
};

/// The cleaning of a recording, chosen by its first frames.
CleaningPlan plan_for(Media& media, const CleaningOptions& cleaning) {
    NoiseMeter meter;
    ClipTrial trial;
    media.seek(0.0);
    for (std::size_t k = 0; k < NoiseMeter::kEnoughFrames; ++k)
        if (const std::optional<RawFrame> frame = media.next()) {
            trial.add(frame->depth);
            meter.add(frame->depth);
        }
    const MediaDescription& description = media.description();
    const DepthNoise noise = meter.noise();
    const std::size_t pixels = description.depth_pixels();
    return plan_of(cleaning, noise, pixels, description.sparse_share.has_value(),
                   trial.best_of(ways_of_automatic(pixels), noise));
}

Stretch read_stretch(Media& media, double begin_s, const CleaningPlan& plan) {
    CleaningChain chain;
    std::vector<SingleFrameDepth> single_frames;
    Stretch stretch;
    media.seek(std::max(0.0, begin_s - kBefore_s));
    while (std::optional<RawFrame> read = media.next()) {
        Frame frame;
        frame.time_s = read->media_s;
        stretch.raw.push_back(read->depth);
        const ColourImage* const colour = read->colour_of_view ? &read->colour : nullptr;
        single_frames.push_back(
            chain.clean_frame(std::move(read->depth), plan, read->held, colour));
        stretch.frames.push_back(std::move(frame));
        if (stretch.frames.back().time_s > begin_s + kTouched_s + kAfter_s) break;
    }
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& one : single_frames) all.push_back(&one);
    for (std::size_t k = 0; k < all.size(); ++k) {
        Frame cleaned = chain.finish_frame(all, k, plan);
        stretch.frames[k].depth = std::move(cleaned.depth);
        stretch.frames[k].unseen = std::move(cleaned.unseen);
    }
    const auto first = std::find_if(stretch.frames.begin(), stretch.frames.end() - 1,
                                    [&](const Frame& frame) { return frame.time_s >= begin_s; });
    stretch.raw.erase(stretch.raw.begin(), stretch.raw.begin() + (first - stretch.frames.begin()));
    stretch.frames.erase(stretch.frames.begin(), first);
    const double there_s = stretch.frames.back().time_s - stretch.frames.front().time_s;
    stretch.milliseconds =
        static_cast<std::size_t>(std::lround(std::min(kTouched_s, there_s) / test::kFingerTick_s));
    return stretch;
}

/// Touches one stretch after the other.
class Toucher {
  public:
    Toucher(const Survey& survey, const TouchParameters& parameters, std::uint32_t seed)
        : survey_(survey), quiet_(survey.quieter_half()), parameters_(parameters), random_(seed) {}

    void touch(const Stretch& stretch, int spots) {
        for (int k = 0; k < spots; ++k) {
            // In a fixed number of draws, whatever the surface is like.
            const auto quiet = static_cast<std::size_t>(random_());
            const auto anywhere = static_cast<std::size_t>(random_());
            std::mt19937 of_stroke(random_());
            if (!quiet_.empty()) rest(stretch, quiet_[quiet % quiet_.size()], Way::rest_quiet);
            rest(stretch, anywhere % stretch.raw.front().levels.size(), Way::rest_anywhere);
            if (const auto stroke = flat_stroke(stretch, of_stroke)) slide(stretch, *stroke);
        }
        for (std::size_t k = 0; k + 1 < stretch.frames.size(); k += kBlemishesEvery)
            blemishes_.add(*stretch.frames[k].depth, *stretch.frames[k + 1].depth);
    }

    [[nodiscard]] Feel feel() const {
        Feel feel{.blemishes = blemishes_.blemishes(),
                  .columns = survey_.columns(),
                  .rows = survey_.rows(),
                  .frames = survey_.frames(),
                  .seconds = survey_.seconds()};
        for (std::size_t k = 0; k < kWays.size(); ++k) feel.of[k] = sums_[k].numbers();
        feel.slide_smooth = smooth_.numbers();
        feel.slide_cliffs = cliffs_.numbers();
        return feel;
    }

  private:
    [[nodiscard]] FeelSums& sums_of(Way way) { return sums_[static_cast<std::size_t>(way)]; }

    void rest(const Stretch& stretch, std::size_t pixel, Way way) {
        const Spot spot{static_cast<int>(pixel) % survey_.columns(),
                        static_cast<int>(pixel) / survey_.columns()};
        const FingerRun felt = press(
            stretch.frames, stretch.milliseconds, test::kRestTimeConstant_s,
            [spot](std::size_t) { return Vec2(spot.i, spot.j); }, parameters_);
        sums_of(way).add(felt, {},
                         explain_losses(stretch.frames, stretch.raw, spot, felt.contact,
                                        parameters_.shape.relief_px));
    }

    void slide(const Stretch& stretch, Spot left) {
        const double step_px =
            kSlide_mm_per_s * test::kFingerTick_s / parameters_.coupling.pixel_pitch_mm;
        const auto place = [&](std::size_t k) {
            const double way_px = std::fmod(static_cast<double>(k) * step_px, 2.0 * kStroke_px);
            return Vec2(left.i + std::min(way_px, 2.0 * kStroke_px - way_px), left.j);
        };
        const FingerRun felt = press(stretch.frames, stretch.milliseconds,
                                     test::kSlideTimeConstant_s, place, parameters_);
        const auto reversals =
            reversal_updates(felt.goals, felt.depths_px, parameters_.friction.dynamic_coefficient);
        sums_of(Way::slide).add(felt, reversals, {});
        smooth_.add(felt, and_where(felt.near_cliff, 1, reversals), {});
        cliffs_.add(felt, and_where(felt.near_cliff, 0, reversals), {});
    }

    /// `left_out`, and the milliseconds whose mark is `value`.
    [[nodiscard]] static std::vector<char> and_where(const std::vector<char>& marks, char value,
                                                     std::vector<char> left_out) {
        for (std::size_t k = 0; k < marks.size(); ++k)
            if (marks[k] == value) left_out[k] = 1;
        return left_out;
    }

    /// The left end of one to the right with data on half of its pixels that is nowhere too steep.
    [[nodiscard]] std::optional<Spot> flat_stroke(const Stretch& stretch,
                                                  std::mt19937& random) const {
        constexpr int kBorder_px = kSmoothed_px + 1;
        const int columns = survey_.columns() - kStroke_px - 2 * kBorder_px;
        const int rows = survey_.rows() - 2 * kBorder_px;
        if (columns <= 0 || rows <= 0) return std::nullopt;
        for (int k = 0; k < kTries; ++k) {
            const auto i = static_cast<int>(random() % static_cast<unsigned>(columns));
            const auto j = static_cast<int>(random() % static_cast<unsigned>(rows));
            const Spot left{i + kBorder_px, j + kBorder_px};
            if (has_data(stretch.raw.front(), left) && is_flat(*stretch.frames.front().depth, left))
                return left;
        }
        return std::nullopt;
    }

    [[nodiscard]] static bool has_data(const DepthImage& raw, Spot left) {
        const float* levels = raw.levels.data() + raw.index(left.i, left.j);
        const auto holes = std::count_if(levels, levels + kStroke_px + 1,
                                         [](float level) { return std::isnan(level); });
        return 2 * holes <= kStroke_px;
    }

    [[nodiscard]] bool is_flat(const DepthImage& image, Spot left) const {
        const double px = parameters_.shape.relief_px / image.highest_level;
        for (int i = left.i; i <= left.i + kStroke_px; ++i) {
            const Vec2 slope(
                (mean_around(image, i + 1, left.j) - mean_around(image, i - 1, left.j)) / 2.0,
                (mean_around(image, i, left.j + 1) - mean_around(image, i, left.j - 1)) / 2.0);
            if (!(px * glm::length(slope) < kSteepest)) return false;
        }
        return true;
    }

    [[nodiscard]] static double mean_around(const DepthImage& image, int i, int j) {
        double sum = 0.0;
        for (int y = j - kSmoothed_px; y <= j + kSmoothed_px; ++y)
            for (int x = i - kSmoothed_px; x <= i + kSmoothed_px; ++x)
                sum += static_cast<double>(image.at(x, y));
        constexpr int kSide = 2 * kSmoothed_px + 1;
        return sum / (kSide * kSide);
    }

    const Survey& survey_;
    std::vector<std::size_t> quiet_;
    TouchParameters parameters_;
    std::mt19937 random_;
    std::array<FeelSums, kWays.size()> sums_{};
    FeelSums smooth_{}, cliffs_{};
    BlemishMeter blemishes_{};
};

}  // namespace

Feel feel_of(std::unique_ptr<Media> opened, const FeelOptions& options) {
    HeldLevelsMedia media(std::move(opened));
    const Survey survey(media);
    TouchParameters parameters;
    if (options.fitted) {
        const Fit fit = fit_of(media.description());
        parameters.shape.relief_px = fit.relief_px;
        parameters.coupling.pixel_pitch_mm = fit.pixel_pitch_mm;
    }
    Toucher toucher(survey, parameters, options.seed);
    const CleaningPlan plan = plan_for(media, options.cleaning);
    const std::vector<double> moments_s = survey.moments_s(options.spots);
    const auto moments = static_cast<int>(moments_s.size());
    for (int k = 0; k < moments; ++k) {
        const Stretch stretch = read_stretch(media, moments_s[static_cast<std::size_t>(k)], plan);
        toucher.touch(stretch, (options.spots + moments - 1 - k) / moments);
    }
    Feel feel = toucher.feel();
    feel.cleaning = in_words(options.cleaning, plan);
    return feel;
}

}  // namespace dibhr::bench
