// Fits robust lines through the levels of consecutive frames.
#include "core/video/cleaning/frame_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dibhr {

namespace {

constexpr double kRelief_px = 255.0;     ///< elevation of the highest level for limits in pixels
constexpr double kSamples = 1500.0;      ///< of a frame, on a grid
constexpr std::size_t kBins = 16;        ///< of levels
constexpr std::size_t kMostOfBin = 100;  ///< samples, in the fit where all levels count the same
constexpr std::size_t kThinned = 3;      ///< every third sample, in the fit of all samples
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kLeastSamples = 64;
constexpr int kFits = 5;                       ///< each with weights from the one before
constexpr double kDeviationOfMedian = 1.4826;  ///< normal: standard deviation by median of sizes
constexpr double kBiweight = 4.685;            ///< Tukey's, in standard deviations
constexpr double kFlatRidge_px = 0.5;          ///< a smaller span of levels does not tell the gain

// A map is trusted if most of the picture agrees on it: a moving hand is only a part. It is flicker
// if maps explain the changes of most pairs, and differ from pair to pair, unlike even motion.
constexpr double kAgreeing = 0.6;  ///< least share of the picture
constexpr double kAgree = 3.0;     ///< samples agree within these standard deviations,
constexpr double kSmall = 0.3;     ///< or within this part of the median change
constexpr double kMostGain = 1.3;
constexpr double kExplains = 2.0;  ///< least ratio of the change before the map to that after it
constexpr double kLeast_px = 0.05;
constexpr double kPerceptible_px = 0.15;  ///< as in plan_of: less flicker is not felt
constexpr std::size_t kLeastPairs = 3;

double median(std::vector<float>& values) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
}

/// Sums of weighted samples x, y, for a line through them.
struct Line {
    double weight{0.0}, x{0.0}, y{0.0}, xx{0.0}, xy{0.0};

    void add(double w, double at, double value) {
        weight += w;
        x += w * at;
        y += w * value;
        xx += w * at * at;
        xy += w * at * value;
    }
    /// y = gain x + offset. `ridge` is a variance that is added to that of x.
    [[nodiscard]] LevelMap fitted(double ridge) const {
        const double mean_x = x / weight;
        const double mean_y = y / weight;
        const double slope =
            (xy / weight - mean_x * mean_y) / (xx / weight - mean_x * mean_x + ridge);
        return {slope, mean_y - slope * mean_x};
    }
    [[nodiscard]] double deviation() const {
        const double mean = x / weight;
        return std::sqrt(std::max(xx / weight - mean * mean, 0.0));
    }
};

LevelMap mean_of(std::span<const LevelMap> maps) {
    LevelMap mean{0.0, 0.0};
    for (const LevelMap& map : maps) {
        mean.gain += map.gain / static_cast<double>(maps.size());
        mean.offset += map.offset / static_cast<double>(maps.size());
    }
    return mean;
}

}  // namespace

/// Takes levels on a grid, NaN for no data; none of frames of another size or highest level.
void FrameScale::sample(std::span<const SingleFrameDepth* const> frames, const DepthImage& like) {
    const auto pixels = static_cast<double>(like.levels.size());
    const int step = std::max(1, static_cast<int>(std::sqrt(pixels / kSamples)));
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const SingleFrameDepth& frame = *frames[k];
        std::vector<float>& levels = levels_[k];
        levels.clear();
        if (!are_alike(frame.depth, like)) continue;
        for (int j = step / 2; j < like.rows; j += step) {
            for (int i = step / 2; i < like.columns; i += step) {
                const std::size_t at = like.index(i, j);
                const bool filled = !frame.filled.empty() && frame.filled[at] != 0;
                levels.push_back(filled ? kNone : frame.depth.levels[at]);
            }
        }
    }
}

void FrameScale::thin() {
    thinned_.clear();
    for (std::size_t k = 0; k < all_.from.size(); k += kThinned)
        thinned_.add(all_.from[k], all_.change[k]);
}

/// Takes about as many samples of each level: else a wall, which does not tell the gain, would
/// outweigh the objects before it.
void FrameScale::balance() {
    std::array<std::size_t, kBins> counts{};
    const auto per_level = static_cast<float>(kBins / highest_);
    const auto bin_of = [per_level](float level) {
        const auto bin = static_cast<int>(level * per_level);
        return static_cast<std::size_t>(std::clamp(bin, 0, static_cast<int>(kBins) - 1));
    };
    for (const float level : all_.from) ++counts[bin_of(level)];
    std::array<std::size_t, kBins> met{};
    balanced_.clear();
    for (std::size_t k = 0; k < all_.from.size(); ++k) {
        const std::size_t bin = bin_of(all_.from[k]);
        const std::size_t every = counts[bin] / kMostOfBin + 1;
        if (met[bin]++ % every == 0) balanced_.add(all_.from[k], all_.change[k]);
    }
}

/// Median of the distances of the samples' changes from those by `change`.
double FrameScale::median_residual(const Samples& samples, const LevelMap& change) {
    const std::size_t count = samples.from.size();
    residuals_.resize(count);
    const auto gain = static_cast<float>(change.gain);
    const auto offset = static_cast<float>(change.offset);
    for (std::size_t k = 0; k < count; ++k)
        residuals_[k] = std::fabs(samples.change[k] - (gain * samples.from[k] + offset));
    return median(residuals_);
}

/// Iteratively reweighted least squares, from the median change on.
FrameScale::Pair FrameScale::fitted(const Samples& samples) {
    const double least = kLeast_px * levels_per_px_;
    const double ridge = kFlatRidge_px * levels_per_px_ * kFlatRidge_px * levels_per_px_;
    residuals_ = samples.change;
    LevelMap change{0.0, median(residuals_)};
    Line line;
    for (int n = 0; n < kFits; ++n) {
        const double left = median_residual(samples, change);
        const double per_bound = 1.0 / (kBiweight * (kDeviationOfMedian * left + least));
        line = {};
        for (std::size_t k = 0; k < samples.from.size(); ++k) {
            const auto level = static_cast<double>(samples.from[k]);
            const auto higher = static_cast<double>(samples.change[k]);
            const double off = (higher - change(level)) * per_bound;
            const double near = std::max(1.0 - off * off, 0.0);
            line.add(near * near, level, higher);
        }
        change = line.fitted(ridge);
    }
    const double half = 0.5 * change.gain;
    Pair pair;
    pair.change = change;
    pair.map = {(1.0 + half) / (1.0 - half), change.offset / (1.0 - half)};
    pair.low = line.x / line.weight - line.deviation();
    pair.high = line.x / line.weight + line.deviation();
    return pair;
}

/// How much of the whole picture the map explains. `changed`: median of the changes' sizes.
void FrameScale::judge(Pair& pair, double changed) {
    const double left = median_residual(all_, pair.change);
    const double least = kLeast_px * levels_per_px_;
    const auto alike =
        static_cast<float>(std::max(kAgree * kDeviationOfMedian * left + least, kSmall * changed));
    const auto most = static_cast<float>(kSmall * changed + least);
    std::size_t agreeing = 0;
    for (const float size : residuals_) {
        agreeing += size <= alike ? 1 : 0;
        pair.off += static_cast<double>(std::min(size, most));
    }
    const bool agrees =
        static_cast<double>(agreeing) >= kAgreeing * static_cast<double>(residuals_.size());
    pair.explains = changed > kExplains * left + least;
    pair.agreed = agrees && pair.map.gain < kMostGain && pair.map.gain * kMostGain > 1.0;
}

/// Fits the map from the sampled frame of that number to the next one.
FrameScale::Pair FrameScale::compare(std::size_t one) {
    const std::vector<float>& now = levels_[one];
    const std::vector<float>& next = levels_[one + 1];
    all_.clear();
    for (std::size_t k = 0; k < std::min(now.size(), next.size()); ++k)
        if (const float change = next[k] - now[k]; !std::isnan(change))
            all_.add(0.5F * (now[k] + next[k]), change);
    if (all_.from.size() < kLeastSamples) return {};
    const double changed = median_residual(all_, {0.0, 0.0});
    thin();
    balance();
    // A wall behind a small object needs the second fit, a hand before a wall the first one.
    Pair plain = fitted(thinned_);
    Pair balanced = fitted(balanced_);
    judge(plain, changed);
    judge(balanced, changed);
    return plain.off < balanced.off ? plain : balanced;
}

/// Whether maps explain the changes of most pairs, and differ from each other more than those of
/// even motion: by the second differences in time of the levels that they give.
bool FrameScale::flickers(std::span<const Pair> pairs) const {
    if (pairs.size() < kLeastPairs) return false;
    const auto explained =
        std::count_if(pairs.begin(), pairs.end(), [](const Pair& pair) { return pair.explains; });
    if (2 * static_cast<std::size_t>(explained) < pairs.size()) return false;
    double squares = 0.0;
    for (std::size_t k = 1; k < pairs.size(); ++k) {
        for (const double level : {pairs[k].low, pairs[k].high}) {
            const double before = level - pairs[k - 1].map.inverse()(level);
            const double after = pairs[k].map(level) - level;
            squares += (after - before) * (after - before);
        }
    }
    const double count = 2.0 * static_cast<double>(pairs.size() - 1);
    return std::sqrt(squares / (6.0 * count)) > kPerceptible_px * levels_per_px_;
}

std::vector<LevelMap> FrameScale::maps(std::span<const SingleFrameDepth* const> frames,
                                       std::size_t now) {
    std::vector<LevelMap> maps(frames.size());
    const std::size_t begin = now - std::min(now, kNearInTime);
    const auto near =
        frames.subspan(begin, std::min(frames.size() - begin, now - begin + kNearInTime + 1));
    const DepthImage& here = frames[now]->depth;
    highest_ = here.highest_level;
    levels_per_px_ = highest_ / kRelief_px;
    sample(near, here);
    std::size_t first = now - begin;
    std::size_t last = first;
    std::vector<Pair> pairs;
    // No flicker once half of the pairs explain nothing: this halves the time for most clips.
    std::size_t left_to_fail = (near.size() - 1) / 2;
    const auto fails = [&](const Pair& pair) { return !pair.explains && left_to_fail-- == 0; };
    for (; first > 0; --first) {
        const Pair pair = compare(first - 1);
        if (fails(pair)) return maps;
        if (!pair.agreed) break;
        pairs.insert(pairs.begin(), pair);
    }
    for (; last + 1 < near.size(); ++last) {
        const Pair pair = compare(last);
        if (fails(pair)) return maps;
        if (!pair.agreed) break;
        pairs.push_back(pair);
    }
    if (!flickers(pairs)) return maps;
    const std::size_t at = now - begin - first;  // among the frames without a cut between them
    std::vector<LevelMap> from_now(pairs.size() + 1);
    for (std::size_t k = at; k < pairs.size(); ++k)
        from_now[k + 1] = from_now[k].then(pairs[k].map);
    for (std::size_t k = at; k > 0; --k)
        from_now[k - 1] = from_now[k].then(pairs[k - 1].map.inverse());
    const LevelMap common = mean_of(from_now);
    for (std::size_t k = 0; k < from_now.size(); ++k)
        maps[begin + first + k] = from_now[k].inverse().then(common);
    return maps;
}

std::span<const SingleFrameDepth* const> FrameScale::on_one_scale(
    std::span<const SingleFrameDepth* const> frames, std::size_t now) {
    const std::vector<LevelMap> found = maps(frames, now);
    const auto is_identity = [](const LevelMap& map) { return map == LevelMap{}; };
    if (std::all_of(found.begin(), found.end(), is_identity)) return frames;
    scaled_.resize(std::max(scaled_.size(), frames.size()));
    frames_.assign(frames.begin(), frames.end());
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (is_identity(found[k])) continue;
        scale_levels(*frames[k], found[k], scaled_[k]);
        frames_[k] = &scaled_[k];
    }
    return frames_;
}

void scale_levels(const SingleFrameDepth& frame, const LevelMap& map, SingleFrameDepth& scaled) {
    scaled = frame;
    scaled.id = 0;
    const auto gain = static_cast<float>(map.gain);
    const auto offset = static_cast<float>(map.offset);
    const auto highest = static_cast<float>(frame.depth.highest_level);
    // No data (NaN) stays NaN: it is neither lower nor higher.
    for (float& level : scaled.depth.levels) {
        level = gain * level + offset;
        level = level < 0.0F ? 0.0F : level;
        level = level > highest ? highest : level;
    }
    for (std::size_t k = 0; k < frame.unseen.size(); ++k)
        if (frame.unseen[k] != 0) scaled.depth.levels[k] = frame.depth.levels[k];
}

}  // namespace dibhr
