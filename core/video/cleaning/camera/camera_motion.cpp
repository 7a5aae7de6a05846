// Small pictures in parts of their noise; where sums of their products are highest is the motion.
#include "core/video/cleaning/camera/camera_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr int kMostColumns = 200;  ///< of a small picture
constexpr std::array<std::int64_t, 2> kFramesApart{2, 4};
constexpr std::int64_t kBetween = 4;  ///< frames to each side whose pairs count
constexpr std::size_t kBandsUsed = 3;
constexpr float kLeastShare = 3e-4F;  ///< of the noise in a band
constexpr float kMost = 6.0F;         ///< deviations; outlines are more
constexpr float kLeastNoise = 0.1F / 255.0F;
/// Ways are tried up to so many px to each side.
constexpr std::array<int, 2> kReach{7, 10};
constexpr int kBorder = 6;            ///< px: bands are not known there
constexpr int kShort = 2;             ///< px: ways that are tried first
constexpr int kTaps = 3;              ///< of the interpolation, to each side
constexpr int kFastest_quarters = 7;  ///< a frame
/// By so many deviations of what noise makes of sums of products the best way must be better than
/// none: it is the best of many, and neighbouring pixels have the same noise.
constexpr float kSurely = 14.0F;
constexpr float kOwnEnergy = 3.0F;  ///< of noise alone, in all bands
/// Of that, by which a way across must be better than none: else ways along which nothing is seen
/// would drift.
constexpr float kAcross = 0.07F;
constexpr float kFinest = 1.0F / 128.0F;
constexpr std::size_t kLanesOfProducts = 16;

constexpr int width_of(std::size_t lag) {
    return 2 * kReach[lag] + 1;
}

/// What is compared is so far inside that the other picture's border is not reached.
constexpr int margin_of(std::size_t lag) {
    return kReach[lag] + kBorder;
}

/// How many columns of a small picture are compared with another one's.
constexpr std::size_t compared(int columns, std::size_t lag) {
    return static_cast<std::size_t>(columns - 2 * margin_of(lag)) / kLanesOfProducts *
           kLanesOfProducts;
}

DIBHR_VECTOR_CLONES void add_row(const float* row, float* __restrict sums, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) sums[i] += row[i];
}

/// Values as parts of the noise at their levels, at most kMost.
DIBHR_VECTOR_CLONES void divide_by_noise(const float* levels, const NoiseBound& deviation,
                                         float* __restrict values, std::ptrdiff_t columns) {
    const NoiseBound of = deviation;
    for (std::ptrdiff_t i = 0; i < columns; ++i)
        values[i] = std::min(std::max(values[i] / of(levels[i]), -kMost), kMost);
}

/// Adds products of a row and another one at each of `shifts` places, kLanesOfProducts sums each.
DIBHR_VECTOR_CLONES void add_products(const float* one, const float* other, std::size_t count,
                                      std::size_t shifts, float* __restrict sums) {
    for (std::size_t shift = 0; shift < shifts; ++shift) {
        const float* const moved = other + shift;
        std::array<float, kLanesOfProducts> lanes{};
        for (std::size_t k = 0; k < kLanesOfProducts; ++k)
            lanes[k] = sums[shift * kLanesOfProducts + k];
        for (std::size_t i = 0; i < count; i += kLanesOfProducts)
            for (std::size_t k = 0; k < kLanesOfProducts; ++k)
                lanes[k] += one[i + k] * moved[i + k];
        for (std::size_t k = 0; k < kLanesOfProducts; ++k)
            sums[shift * kLanesOfProducts + k] = lanes[k];
    }
}

using Weights = std::array<float, std::size_t{2} * kTaps>;

/// Lanczos' weights of the values around a place, `part` of a pixel after the one in the middle.
Weights weights_at(float part) {
    Weights weights{};
    float sum = 0.0F;
    for (int k = 0; k < 2 * kTaps; ++k) {
        // Systems differ in the last bit of a sine, which rounding to single precision takes away.
        const double x = std::numbers::pi * (k - kTaps + 1 - static_cast<double>(part));
        const double tapered = x / kTaps;
        const auto weight = static_cast<float>(
            std::fabs(x) < 1e-4 ? 1.0 : std::sin(x) * std::sin(tapered) / (x * tapered));
        weights[static_cast<std::size_t>(k)] = weight;
        sum += weight;
    }
    for (float& weight : weights) weight /= sum;
    return weights;
}

}  // namespace

std::span<const PictureWay> CameraMotion::ways(std::span<const SingleFrameDepth* const> frames,
                                               std::size_t now, const DepthNoise& noise) {
    gather(frames, now, noise);
    if (small_.size() < 2) return {};
    pair();
    const std::int64_t first = small_.front().number;
    const auto count = static_cast<std::size_t>((small_.back().number - first) / 2);
    velocities_.resize(count);
    bool moves = false;
    for (std::size_t k = 0; k < count; ++k) {
        velocities_[k] = velocity_from(first + 2 * static_cast<std::int64_t>(k));
        moves = moves || velocities_[k].right != 0.0F || velocities_[k].down != 0.0F;
    }
    if (!moves) return {};
    // From now on, half a way of two frames at a time.
    const auto velocity_after = [&](std::int64_t number) {
        const std::int64_t k = (number - first) >= 0 ? (number - first) / 2 : 0;
        return velocities_[std::min(static_cast<std::size_t>(k), count - 1)];
    };
    ways_.assign(frames.size(), {});
    const auto scale = static_cast<float>(shrink_);
    for (const int side : {1, -1}) {
        PictureWay way;
        std::int64_t at = numbers_[now];
        for (std::size_t k = now; k < frames.size(); k += static_cast<std::size_t>(side)) {
            for (; at != numbers_[k]; at += side) {
                const Velocity velocity = velocity_after(side > 0 ? at : at - 1);
                way.right += static_cast<float>(side) * scale * velocity.right;
                way.down += static_cast<float>(side) * scale * velocity.down;
            }
            ways_[k] = way;
            if (k == 0 && side < 0) break;
        }
    }
    return ways_;
}

/// The small pictures of every second frame around the frame, from earlier calls where known.
void CameraMotion::gather(std::span<const SingleFrameDepth* const> frames, std::size_t now,
                          const DepthNoise& noise) {
    const DepthImage& here = frames[now]->depth;
    if (!(noise == noise_)) small_.clear();
    noise_ = noise;
    shrink_ = 1;
    while (here.columns / shrink_ > kMostColumns) shrink_ *= 2;
    numbers_.clear();
    for (std::size_t k = 0; k < frames.size(); ++k)
        numbers_.push_back(frames[k]->number < 0 ? static_cast<std::int64_t>(k)
                                                 : frames[k]->number);
    kept_.clear();
    const int least = 2 * margin_of(1) + static_cast<int>(kLanesOfProducts);
    constexpr auto kMostBetween = static_cast<std::int64_t>(kReachInTime);
    const bool follow_each_other =
        std::adjacent_find(numbers_.begin(), numbers_.end(), [](std::int64_t a, std::int64_t b) {
            return b <= a || b > a + kMostBetween;
        }) == numbers_.end();
    if (follow_each_other && here.columns / shrink_ >= least && here.rows / shrink_ >= least) {
        const std::size_t first = now - std::min(now, kReachInTime);
        const std::size_t end = std::min(frames.size(), now + kReachInTime + 1);
        for (std::size_t k = first; k < end; ++k) {
            if (numbers_[k] % 2 != 0 || !are_alike(frames[k]->depth, here)) continue;
            const std::uint64_t id = frames[k]->id;
            const auto found = std::find_if(small_.begin(), small_.end(), [&](const Small& small) {
                return id != 0 && small.id == id && small.number == numbers_[k];
            });
            if (found != small_.end()) {
                kept_.push_back(std::move(*found));
                found->id = 0;
                continue;
            }
            Small& made = kept_.emplace_back();
            made.id = id;
            made.number = numbers_[k];
            make_small(*frames[k], noise, made);
        }
    }
    small_.swap(kept_);
}

/// Means of squares of pixels, without what is coarser than a few bands, over the noise of each.
void CameraMotion::make_small(const SingleFrameDepth& frame, const DepthNoise& noise, Small& made) {
    BandPicture& small = made.picture;
    const DepthImage& depth = frame.depth;
    BandPicture levels;
    levels.set_size(depth.columns / shrink_, depth.rows / shrink_);
    const auto columns = static_cast<std::size_t>(levels.columns * shrink_);
    const float share = 1.0F / static_cast<float>(shrink_ * shrink_);
    for (int j = 0; j < levels.rows; ++j) {
        row_.assign(columns, 0.0F);
        for (int k = 0; k < shrink_; ++k)
            add_row(depth.levels.data() + depth.index(0, j * shrink_ + k), row_.data(),
                    static_cast<std::ptrdiff_t>(columns));
        float* const out = levels.row(j);
        for (int i = 0; i < levels.columns; ++i) {
            float sum = 0.0F;
            for (int k = 0; k < shrink_; ++k)
                sum += row_[static_cast<std::size_t>(i * shrink_ + k)];
            out[i] = share * sum;
        }
    }
    std::array<float, kNoiseBands> factors{};
    std::size_t halvings = 0;
    while ((1 << halvings) < shrink_) ++halvings;
    for (std::size_t b = 0; b < kBandsUsed; ++b) {
        float of_band = noise.character.bands[std::min(b + halvings, kNoiseBands - 1)];
        for (std::size_t k = kNoiseBands; k < b + halvings + 1; ++k) of_band *= 0.25F;
        factors[b] = 1.0F / std::sqrt(std::max(of_band, kLeastShare));
    }
    small = levels;
    bands_.weigh(small, factors);
    const NoiseBound deviation(noise, 1.0F, kLeastNoise, depth.highest_level);
    for (int j = 0; j < small.rows; ++j)
        divide_by_noise(levels.row(j), deviation, small.row(j), small.columns);
    made.energy = 0.0F;
    for (const float value : small.values) made.energy += value * value;
    made.energy /= static_cast<float>(small.values.size());
}

/// Finds pairs, and compares new ones in place and a little away from it.
void CameraMotion::pair() {
    for (std::size_t lag = 0; lag < kLags; ++lag)
        for (std::size_t a = 0, b = 0; a < small_.size(); ++a) {
            const std::int64_t wanted = small_[a].number + kFramesApart[lag];
            while (b < small_.size() && small_[b].number < wanted) ++b;
            Pair& pair = small_[a].pairs[lag];
            pair.later = b < small_.size() && small_[b].number == wanted ? b : 0;
            if (pair.later == 0) continue;
            if (small_[b].id != 0 && small_[b].id == pair.later_id) continue;
            pair.later_id = small_[b].id;
            pair.agrees.assign(static_cast<std::size_t>(width_of(lag) * width_of(lag)), 0.0F);
            pair.is_whole = false;
            compare(small_[a], lag, kShort);
        }
}

/// All ways up to `reach` px to each side.
void CameraMotion::compare(Small& from, std::size_t lag, int reach) {
    const BandPicture& one = from.picture;
    const BandPicture& other = small_[from.pairs[lag].later].picture;
    const int margin = margin_of(lag);
    const auto shifts = static_cast<std::size_t>(2 * reach + 1);
    lanes_.resize(shifts * kLanesOfProducts);
    for (int down = -reach; down <= reach; ++down) {
        std::fill(lanes_.begin(), lanes_.end(), 0.0F);
        for (int j = margin; j < one.rows - margin; ++j)
            add_products(one.row(j) + margin, other.row(j + down) + margin - reach,
                         compared(one.columns, lag), shifts, lanes_.data());
        float* const out = from.pairs[lag].agrees.data() +
                           std::ptrdiff_t{kReach[lag] + down} * width_of(lag) + kReach[lag] - reach;
        for (std::size_t shift = 0; shift < shifts; ++shift) {
            out[shift] = 0.0F;
            for (std::size_t k = 0; k < kLanesOfProducts; ++k)
                out[shift] += lanes_[shift * kLanesOfProducts + k];
        }
    }
}

/// visit(earlier picture, which lag): all pairs within ten frames.
template <typename Visit>
void CameraMotion::visit_pairs(std::int64_t number, const Visit& visit) {
    for (std::size_t lag = 0; lag < kLags; ++lag)
        for (Small& one : small_)
            if (one.pairs[lag].later != 0 && one.number >= number - kBetween &&
                one.number + kFramesApart[lag] <= number + 2 + kBetween)
                visit(one, lag);
}

void CameraMotion::compare_all(std::int64_t number) {
    visit_pairs(number, [this](Small& one, std::size_t lag) {
        if (!std::exchange(one.pairs[lag].is_whole, true)) compare(one, lag, kReach[lag]);
    });
}

float CameraMotion::at(std::size_t lag, int right, int down) const {
    return sums_[lag][static_cast<std::size_t>((kReach[lag] + down) * width_of(lag) + kReach[lag] +
                                               right)];
}

/// Whether pictures agree most in place, and hardly more between that and the ways beside it.
bool CameraMotion::stands_still(float sure) const {
    std::array<float, 2> slope{};
    std::array<float, 2> bend{};
    for (std::size_t lag = 0; lag < kLags; ++lag) {
        const float here = at(lag, 0, 0);
        for (int down = -kShort; down <= kShort; ++down)
            for (int right = -kShort; right <= kShort; ++right)
                if ((right != 0 || down != 0) && at(lag, right, down) >= here) return false;
        const auto frames = static_cast<float>(kFramesApart[lag]);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const int right = axis == 0 ? 1 : 0;
            const float before = at(lag, -right, right - 1);
            const float after = at(lag, right, 1 - right);
            slope[axis] += frames * 0.5F * (after - before);
            bend[axis] += frames * frames * (2.0F * here - before - after);
        }
    }
    float more = 0.0F;
    for (std::size_t axis = 0; axis < 2; ++axis)
        more += 0.5F * slope[axis] * slope[axis] / bend[axis];
    return more < sure;
}

float CameraMotion::agreement(Velocity at) const {
    float whole = 0.0F;
    for (std::size_t lag = 0; lag < kLags; ++lag) {
        if (sums_[lag].empty()) continue;
        const float x = at.right * static_cast<float>(kFramesApart[lag]);
        const float y = at.down * static_cast<float>(kFramesApart[lag]);
        const float left = std::floor(x);
        const float top = std::floor(y);
        const Weights across = weights_at(x - left);
        const Weights along = weights_at(y - top);
        const std::ptrdiff_t width = width_of(lag);
        const int first = kReach[lag] - kTaps + 1;
        const float* const from = sums_[lag].data() + (first + static_cast<int>(top)) * width +
                                  first + static_cast<int>(left);
        for (int j = 0; j < 2 * kTaps; ++j) {
            float sum = 0.0F;
            for (int i = 0; i < 2 * kTaps; ++i)
                sum += across[static_cast<std::size_t>(i)] * from[j * width + i];
            whole += along[static_cast<std::size_t>(j)] * sum;
        }
    }
    return whole;
}

/// Sums the agreements of the pairs within ten frames. Returns how much is surely more than noise.
float CameraMotion::sum_agreements(std::int64_t number) {
    for (std::size_t lag = 0; lag < kLags; ++lag)
        sums_[lag].assign(static_cast<std::size_t>(width_of(lag) * width_of(lag)), 0.0F);
    float variance = 0.0F;
    visit_pairs(number, [&](const Small& one, std::size_t lag) {
        add_row(one.pairs[lag].agrees.data(), sums_[lag].data(),
                static_cast<std::ptrdiff_t>(sums_[lag].size()));
        variance += static_cast<float>(compared(one.picture.columns, lag)) *
                    static_cast<float>(one.picture.rows - 2 * margin_of(lag)) * one.energy *
                    std::min(one.energy, kOwnEnergy);
    });
    return kSurely * std::sqrt(variance);
}

/// The best of all velocities in steps of a quarter; over two frames that is half a pixel.
CameraMotion::Velocity CameraMotion::rough_velocity() const {
    Velocity best;
    float most = -std::numeric_limits<float>::infinity();
    for (int y = -kFastest_quarters; y <= kFastest_quarters; ++y)
        for (int x = -kFastest_quarters; x <= kFastest_quarters; ++x) {
            const int left = (x + 8) / 2 - 4;
            const int top = (y + 8) / 2 - 4;
            const int right = left + std::abs(x % 2);
            const int bottom = top + std::abs(y % 2);
            const float agrees = at(1, x, y) + 0.25F * (at(0, left, top) + at(0, right, top) +
                                                        at(0, left, bottom) + at(0, right, bottom));
            if (agrees <= most) continue;
            most = agrees;
            best = {0.25F * static_cast<float>(x), 0.25F * static_cast<float>(y)};
        }
    return best;
}

/// Of the two frames from that one on; 0 where nothing says surely that they move.
CameraMotion::Velocity CameraMotion::find_velocity(std::int64_t number) {
    constexpr float kLimit = 0.25F * static_cast<float>(kFastest_quarters);
    const float sure = sum_agreements(number);
    if (!(sure > 0.0F) || stands_still(sure)) return {};  // 0: nothing is to be seen
    compare_all(number);
    (void)sum_agreements(number);
    Velocity velocity = rough_velocity();
    float best = agreement(velocity);
    for (float step = 0.125F; step >= kFinest; step *= 0.5F) {
        for (bool better = true; std::exchange(better, false);)
            for (const auto& [right, down] :
                 {std::pair{step, 0.0F}, {-step, 0.0F}, {0.0F, step}, {0.0F, -step}}) {
                const Velocity tried{velocity.right + right, velocity.down + down};
                if (std::fabs(tried.right) > kLimit || std::fabs(tried.down) > kLimit) continue;
                const float agrees = agreement(tried);
                if (agrees <= best) continue;
                best = agrees;
                velocity = tried;
                better = true;
                break;
            }
    }
    if (best <= agreement({}) + sure) return {};
    for (const Velocity simple : {Velocity{0.0F, velocity.down}, {velocity.right, 0.0F}})
        if (agreement(simple) >= best - kAcross * sure) velocity = simple;
    // The best way may be beyond the longest one.
    const bool is_longest = std::max(std::fabs(velocity.right), std::fabs(velocity.down)) >= kLimit;
    return is_longest ? Velocity{} : velocity;
}

/// The same, from earlier calls where known.
CameraMotion::Velocity CameraMotion::velocity_from(std::int64_t number) {
    Ids ids{};
    bool is_known = true;
    Small* here = nullptr;
    for (Small& small : small_) {
        if (small.number == number) here = &small;
        if (small.number < number - kBetween || small.number > number + 2 + kBetween) continue;
        ids[static_cast<std::size_t>(small.number - number + kBetween) / 2] = small.id;
        is_known = is_known && small.id != 0;
    }
    if (here != nullptr && is_known && here->from == ids) return here->velocity;
    const Velocity velocity = find_velocity(number);
    if (here == nullptr) return velocity;
    here->velocity = velocity;
    here->from = ids;
    return velocity;
}

}  // namespace dibhr
