// Measures noise by second differences in time, tile by tile: even motion has none.
#include "core/video/cleaning/depth_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

#include "core/files/plain_text.hpp"
#include "core/video/cleaning/frame_scale.hpp"

namespace dibhr {

namespace {

constexpr int kTile_px = 16;
constexpr int kStep_px = 2;  ///< every second pixel of a row and column is enough
constexpr std::size_t kPixelsOfTile = kTile_px * kTile_px / (kStep_px * kStep_px);
constexpr std::size_t kLeastChanges = 64;
constexpr std::size_t kBins = 16;  ///< of levels
// Least tiles of a bin: in fewer, motion may be in most of them and would be taken for noise.
constexpr std::size_t kLeastTiles = 4;
constexpr double kLeastShare = 0.02;  ///< of the fullest bin
constexpr double kOneSurface = 0.06;  ///< of the highest level: a tile that varies more has several
/// This quantile of a bin's tiles is its noise: tiles with less noise have no outline in them.
constexpr double kQuietShare = 0.4;
// From a mean absolute value to the deviation of a normal distribution, for x[-1] - 2 x[0] + x[1]
// and for differences from the mean of four around: sqrt(pi / 2) over sqrt(6), over sqrt(5 / 4).
constexpr double kOfSecondDifference = 1.2533141 / 2.4494897;
constexpr double kOfRoughness = 1.2533141 / 1.1180340;

constexpr int kSmall_px = 320;  ///< enough columns to compare the scales of frames

/// Every n-th pixel, so that at most kSmall_px columns are left.
DepthImage small_of(const DepthImage& frame) {
    const int step = (frame.columns + kSmall_px - 1) / kSmall_px;
    return image_of((frame.columns + step - 1) / step, (frame.rows + step - 1) / step,
                    frame.highest_level,
                    [&](int i, int j) { return frame.at(i * step, j * step); });
}

double quantile(std::vector<double>& values, double share) {
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

struct Sample {
    double away;   ///< 1 - level / highest
    double noise;  ///< parts of the highest level
    double weight;
};

/// Factors of {1, away, away^2}.
using Powers = std::array<double, 3>;

double squared_error(const std::vector<Sample>& samples, const Powers& powers) {
    double sum = 0.0;
    for (const Sample& s : samples) {
        const double e = powers[0] + s.away * (powers[1] + s.away * powers[2]) - s.noise;
        sum += s.weight * e * e;
    }
    return sum;
}

/// The best fit with the powers that are bits of `used`, by normal equations.
Powers fitted(const std::vector<Sample>& samples, unsigned used) {
    std::array<std::array<double, 4>, 3> rows{};
    for (const Sample& s : samples) {
        const Powers x{1.0, s.away, s.away * s.away};
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c) rows[r][c] += s.weight * x[r] * x[c];
            rows[r][3] += s.weight * x[r] * s.noise;
        }
    }
    Powers powers{};
    const double whole = rows[0][0];  // the sum of the weights
    for (std::size_t r = 0; r < 3; ++r) {
        if ((used >> r & 1U) != 0) continue;
        for (std::size_t k = 0; k < 3; ++k) rows[r][k] = rows[k][r] = 0.0;
        rows[r][r] = whole;
        rows[r][3] = 0.0;
    }
    for (std::size_t p = 0; p < 3; ++p) {
        if (!(std::fabs(rows[p][p]) > 1e-12 * std::fabs(whole))) return {-1.0, -1.0, -1.0};
        for (std::size_t r = 0; r < 3; ++r) {
            if (r == p) continue;
            const double share = rows[r][p] / rows[p][p];
            for (std::size_t c = 0; c < 4; ++c) rows[r][c] -= share * rows[p][c];
        }
    }
    for (std::size_t p = 0; p < 3; ++p) powers[p] = rows[p][3] / rows[p][p];
    return powers;
}

/// The best fit in which no factor is negative.
Powers fitted(const std::vector<Sample>& samples) {
    Powers best{};
    double least = std::numeric_limits<double>::infinity();
    for (unsigned used = 1; used < 8; ++used) {
        const Powers powers = fitted(samples, used);
        if (*std::min_element(powers.begin(), powers.end()) < 0.0) continue;
        if (const double error = squared_error(samples, powers); error < least) {
            least = error;
            best = powers;
        }
    }
    return best;
}

}  // namespace

std::string text_of(const DepthNoise& noise) {
    const auto text = [](float value) { return number_text(static_cast<double>(value)); };
    std::string character;
    for (const float share : noise.character.bands) character += " " + text(share);
    for (const float value : {noise.character.kept, noise.character.fixed, noise.step.constant,
                              noise.step.linear, noise.step.square})
        character += " " + text(value);
    for (const float share : noise.character.standing) character += " " + text(share);
    character += " " + text(noise.character.kept_in_motion);
    return text(noise.constant) + " " + text(noise.linear) + " " + text(noise.square) + " " +
           text(noise.correlation) + " " + (noise.per_frame_scale ? "1" : "0") + character;
}

std::optional<DepthNoise> noise_in(const std::string& text) {
    std::istringstream words(text);
    words.imbue(std::locale::classic());
    DepthNoise noise;
    words >> noise.constant >> noise.linear >> noise.square >> noise.correlation >>
        noise.per_frame_scale;
    if (!words) return std::nullopt;
    DepthNoise whole = noise;
    for (float& share : whole.character.bands) words >> share;
    words >> whole.character.kept >> whole.character.fixed >> whole.step.constant >>
        whole.step.linear >> whole.step.square;
    for (float& share : whole.character.standing) words >> share;
    if (!words) return noise;
    if (!(words >> whole.character.kept_in_motion))
        whole.character.kept_in_motion = whole.character.kept;
    for (float* const kept : {&whole.character.kept, &whole.character.kept_in_motion})
        *kept = std::clamp(*kept, 0.0F, kMostKeptNoise);
    return whole;
}

void NoiseMeter::add_tile(Tile& tile, const DepthImage& frame, int left, int top) const {
    const int right = std::min(left + kTile_px, frame.columns - 1);
    const int bottom = std::min(top + kTile_px, frame.rows - 1);
    std::array<float, kPixelsOfTile> changes{};
    std::size_t count = 0;
    float sum = 0.0F;
    for (int j = std::max(top, 1); j < bottom; j += kStep_px) {
        for (int i = std::max(left, 1); i < right; i += kStep_px) {
            const float now = frame.at(i, j);
            tile.level.add(now);
            tile.rough.add(now - 0.25F * (frame.at(i - 1, j) + frame.at(i + 1, j) +
                                          frame.at(i, j - 1) + frame.at(i, j + 1)));
            if (before_last_.levels.empty()) continue;
            const float change = before_last_.at(i, j) - 2.0F * last_.at(i, j) + now;
            if (std::isnan(change)) continue;
            changes[count++] = change;
            sum += change;
        }
    }
    // What all pixels of a tile share is motion, or the frame's scale: noise differs within a tile.
    if (count < 2) return;
    const auto pixels = static_cast<float>(count);
    const float mean = sum / pixels;
    const float less = std::sqrt(pixels / (pixels - 1.0F));
    for (std::size_t k = 0; k < count; ++k) tile.shaken.add(less * (changes[k] - mean));
}

void NoiseMeter::add(DepthImage frame) {
    const bool first = last_.levels.empty();
    if (!first && (last_.rows != frame.rows || last_.columns != frame.columns ||
                   last_.highest_level != frame.highest_level))
        return;
    const int columns = (frame.columns + kTile_px - 1) / kTile_px;
    const int rows = (frame.rows + kTile_px - 1) / kTile_px;
    tiles_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    auto tile = tiles_.begin();
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x, ++tile)
            add_tile(*tile, frame, x * kTile_px, y * kTile_px);
    if (small_.size() < kEnoughFrames) small_.push_back({small_of(frame), {}, {}});
    character_.add(frame);
    before_last_ = std::move(last_);
    last_ = std::move(frame);
}

bool NoiseMeter::has_per_frame_scale() const {
    std::vector<const SingleFrameDepth*> frames;
    frames.reserve(small_.size());
    for (const SingleFrameDepth& frame : small_) frames.push_back(&frame);
    if (frames.empty()) return false;
    const std::vector<LevelMap> maps = FrameScale{}.maps(frames, frames.size() / 2);
    return std::any_of(maps.begin(), maps.end(),
                       [](const LevelMap& map) { return map != LevelMap{}; });
}

DepthNoise NoiseMeter::noise() const {
    std::array<std::vector<double>, kBins> noises;
    std::vector<double> grains;
    const double highest = last_.highest_level;
    const bool moves = std::any_of(tiles_.begin(), tiles_.end(), [](const Tile& tile) {
        return tile.shaken.count >= kLeastChanges;
    });  // else it is a still picture, of which only grain is known
    const auto is_one_surface = [highest](const Tile& tile) {
        return tile.rough.count >= kLeastChanges && tile.level.deviation() <= kOneSurface * highest;
    };  // where no tile is one surface, the noise itself varies by more
    const bool has_surfaces = std::any_of(tiles_.begin(), tiles_.end(), is_one_surface);
    for (const Tile& tile : tiles_) {
        if (tile.rough.count < kLeastChanges) continue;
        if (has_surfaces && !is_one_surface(tile)) continue;
        if (moves && tile.shaken.count < kLeastChanges) continue;
        const double grain = tile.rough.of_absolutes() * kOfRoughness;
        const double noise = moves ? tile.shaken.of_absolutes() * kOfSecondDifference : grain;
        const double height = tile.level.of_absolutes() / highest;
        const auto bin = static_cast<std::size_t>(std::clamp(height, 0.0, 0.999) * kBins);
        noises[bin].push_back(noise / highest);
        if (moves && noise > 0.0) grains.push_back(grain / noise);
    }
    std::size_t fullest = 0;
    for (const std::vector<double>& bin : noises) fullest = std::max(fullest, bin.size());
    const std::size_t least =
        std::max(kLeastTiles, static_cast<std::size_t>(kLeastShare * static_cast<double>(fullest)));
    std::vector<Sample> samples;
    for (std::size_t k = 0; k < kBins; ++k) {
        if (noises[k].size() < least) continue;
        const double away = 1.0 - (static_cast<double>(k) + 0.5) / kBins;
        samples.push_back({away, quantile(noises[k], kQuietShare),
                           std::sqrt(static_cast<double>(noises[k].size()))});
    }
    DepthNoise noise;
    noise.per_frame_scale = has_per_frame_scale();
    noise.character = character_.character();
    noise.step = step();
    if (samples.empty()) return noise;
    const Powers powers = fitted(samples);
    const double grain = grains.empty() ? 1.0 : std::min(1.0, quantile(grains, 0.5));
    noise.constant = static_cast<float>(powers[0]);
    noise.linear = static_cast<float>(powers[1]);
    noise.square = static_cast<float>(powers[2]);
    noise.correlation = static_cast<float>(1.0 - grain);
    return noise;
}

StepByDistance NoiseMeter::step() const {
    std::vector<Sample> samples;
    for (const LevelStep& one : character_.steps())
        samples.push_back({one.away, one.step, std::sqrt(one.tiles)});
    if (samples.empty()) return {};
    const Powers powers = fitted(samples);
    return {static_cast<float>(powers[0]), static_cast<float>(powers[1]),
            static_cast<float>(powers[2])};
}

}  // namespace dibhr
