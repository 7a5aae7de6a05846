// Energies of bands in tiles, of second differences in time and of the frames themselves.
#include "core/video/cleaning/noise_character.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace dibhr {

namespace {

constexpr int kCharacterTile_px = 16;
constexpr int kAroundTile_px = 4;  ///< data that the finer bands of a tile depend on, too
constexpr int kMiddleColumns = 640, kMiddleRows = 480;
constexpr std::size_t kCharacterBins = 16;  ///< of levels
constexpr std::size_t kTilesOfBin = 4;      ///< in fewer, motion may be in most of them
constexpr std::size_t kFramesBetween = 3;   ///< every third frame is enough for what stands still
constexpr std::size_t kFirstFrames = 5;     ///< half of those that are measured
constexpr std::size_t kFramesOfSteps = 3;   ///< frames whose levels are compared
constexpr int kStepSample = 3;              ///< every third of their pixels
/// What a median shows of the variance: a tile has few values of the coarser bands.
constexpr std::array<float, kNoiseBands> kShownByMedian{1.0F, 0.99F, 0.96F, 0.84F, 0.455F};
constexpr double kQuietTiles = 0.4;       ///< quantile, as of NoiseMeter
constexpr float kAlsoQuiet = 1.7F;        ///< times its variance: tiles with the same noise
constexpr double kSmoothestTiles = 0.2;   ///< quantile: tiles without shapes in a band
constexpr float kDip = 0.9F;              ///< deviation of the second band in that of the first
constexpr float kEvenNoise = 1.7F;        ///< median in the smoothest tiles' deviation
constexpr double kPlainTiles = 0.1;       ///< share: of the tiles, those with least shape
constexpr float kShownAtLeast = 0.3F;     ///< as what smooths by it: codecs repeat pixels
constexpr float kMostStanding = 4.0F;     ///< of the moving noise: beyond, it is shape
constexpr double kVerySmoothTiles = 0.1;  ///< quantile: also where a picture is full of shapes
/// What stands still differs from place to place, unlike what moves.
constexpr float kStandingVaries = 6.0F;
/// It is hardly coarser than what moves: what a coarser band has beyond that is shape.
constexpr float kMostRise = 2.0F;
constexpr float kMoves = 2.0F;  ///< times the change that noise makes of the means of frames
constexpr std::size_t kLeastLevels = 500, kLeastGaps = 2;
constexpr std::size_t kRepeatsPerGap = 2;  ///< levels in steps repeat; continuous ones do not
constexpr double kTypicalGap = 0.3;        ///< quantile: some levels in between do not occur

float quantile_of(std::vector<float> values, double share) {
    if (values.empty()) return 0.0F;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

float median_of(std::vector<float> values) {
    return quantile_of(std::move(values), 0.5);
}

template <std::size_t Count>
std::array<float, Count> medians_of(const std::vector<std::array<float, Count>>& frames) {
    std::array<float, Count> medians{};
    for (std::size_t b = 0; b < Count; ++b) {
        std::vector<float> values;
        for (const auto& frame : frames) values.push_back(frame[b]);
        medians[b] = median_of(std::move(values));
    }
    return medians;
}

/// Of a tile: its shape over its noise, and how much more two frames differ than one does: as a
/// whole, and without the tile's mean.
struct RatioOfTile {
    float shape, ratio, level_ratio;
};

/// The median of the ratios, which shapes that move add to, and slopes by their mean; and that of
/// the tiles with least shape.
std::pair<float, float> ratios_of(std::vector<RatioOfTile> tiles) {
    std::vector<float> ratios;
    for (const RatioOfTile& tile : tiles) ratios.push_back(tile.ratio);
    const float median = median_of(std::move(ratios));
    const auto plain = static_cast<std::size_t>(kPlainTiles * static_cast<double>(tiles.size()));
    if (plain < kTilesOfBin) return {median, median};
    std::nth_element(tiles.begin(), tiles.begin() + static_cast<std::ptrdiff_t>(plain), tiles.end(),
                     [](const RatioOfTile& a, const RatioOfTile& b) { return a.shape < b.shape; });
    std::vector<float> of_plain;
    for (std::size_t k = 0; k < plain; ++k) of_plain.push_back(tiles[k].level_ratio);
    return {median, std::min(median, median_of(std::move(of_plain)))};
}

float square(float value) {
    return value * value;
}

template <typename Value>
float mean_of_part(const BandPicture& of, int left, int top, int side, const Value& value) {
    double sum = 0.0;
    for (int j = top; j < top + side; ++j)
        for (int i = left; i < left + side; ++i) sum += static_cast<double>(value(of.row(j)[i]));
    return static_cast<float>(sum / (side * side));
}

/// The share of its variance that noise with this correlation from frame to frame shows in second
/// differences: 1 - 4/3 r + 1/3 r^2 where each frame's depends on the one before.
float shown_in_time(float kept) {
    return 1.0F - (4.0F - kept) * kept / 3.0F;
}

}  // namespace

/// What the tiles of one range of levels have.
struct NoiseCharacterMeter::Bin {
    std::vector<float> variances{}, ratios{}, level_ratios{};
    std::vector<float> shapes{};  ///< of all bands, what is in space over what is in time
    std::vector<Energies> in_time{}, in_space{};
    std::vector<float> levels{};  ///< single ones, for the steps

    [[nodiscard]] std::vector<float> of(const std::vector<Energies>& tiles,
                                        std::size_t band) const {
        std::vector<float> values;
        values.reserve(tiles.size());
        for (const Energies& tile : tiles) values.push_back(tile[band]);
        return values;
    }
};

void NoiseCharacterMeter::look(const DepthImage& frame, Seen& seen) const {
    const int columns = std::min(frame.columns, kMiddleColumns);
    const int rows = std::min(frame.rows, kMiddleRows);
    seen.picture.set_size(columns, rows);
    seen.data.resize(seen.picture.values.size());
    float last = 0.0F;
    std::size_t k = 0;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i, ++k) {
            const float level =
                frame.at(i + (frame.columns - columns) / 2, j + (frame.rows - rows) / 2);
            seen.data[k] = std::isnan(level) ? 0 : 1;
            if (seen.data[k] != 0) last = level;
            seen.picture.values[k] = last;
        }
    }
}

void NoiseCharacterMeter::add(const DepthImage& frame) {
    if (frame.levels.empty()) return;
    look(frame, now_);
    highest_ = frame.highest_level;
    columns_ = now_.picture.columns / kCharacterTile_px;
    rows_ = now_.picture.rows / kCharacterTile_px;
    tiles_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    if (count_ % kFramesBetween == 0) measure(now_.picture, now_.data, false);
    if (count_ < kFramesOfSteps)
        for (std::size_t k = 0; k < now_.data.size(); k += kStepSample)
            if (now_.data[k] != 0) some_levels_.push_back(now_.picture.values[k]);
    if (count_ >= 2) compare_frames();
    if (count_ == kFirstFrames) sum_of_first_ = sum_;
    if (count_ == 0) {
        sum_ = now_.picture;
        seen_all_ = now_.data;
    } else {
        for (std::size_t k = 0; k < seen_all_.size(); ++k) {
            sum_.values[k] += now_.picture.values[k];
            seen_all_[k] &= now_.data[k];
        }
    }
    ++count_;
    std::swap(before_last_, last_);
    std::swap(last_, now_);
}

/// Even motion has no second differences.
void NoiseCharacterMeter::compare_frames() {
    change_.set_size(now_.picture.columns, now_.picture.rows);
    known_.resize(now_.data.size());
    const float scale = 1.0F / std::sqrt(6.0F);
    for (std::size_t k = 0; k < known_.size(); ++k) {
        known_[k] = before_last_.data[k] & last_.data[k] & now_.data[k];
        const float change = before_last_.picture.values[k] - 2.0F * last_.picture.values[k] +
                             now_.picture.values[k];
        change_.values[k] = known_[k] != 0 ? scale * change : 0.0F;
    }
    measure(change_, known_, true);
}

/// Whether a tile, and what its finer bands depend on, has data all over.
bool NoiseCharacterMeter::has_data(const std::vector<std::uint8_t>& data, std::size_t tile) const {
    const auto tile_columns = static_cast<std::size_t>(columns_);
    const int left = static_cast<int>(tile % tile_columns) * kCharacterTile_px;
    const int top = static_cast<int>(tile / tile_columns) * kCharacterTile_px;
    const int columns = now_.picture.columns;
    const int right = std::min(left + kCharacterTile_px + kAroundTile_px, columns);
    const int bottom = std::min(top + kCharacterTile_px + kAroundTile_px, now_.picture.rows);
    for (int j = std::max(top - kAroundTile_px, 0); j < bottom; ++j) {
        const auto row = data.begin() + std::ptrdiff_t{j} * columns;
        if (std::find(row + std::max(left - kAroundTile_px, 0), row + right, 0) != row + right)
            return false;
    }
    return true;
}

NoiseCharacterMeter::Energies NoiseCharacterMeter::energies_of(const NoiseBands& bands, int x,
                                                               int y) {
    Energies energies{};
    for (std::size_t b = 0; b < kNoiseBands; ++b) {
        const int side = kCharacterTile_px >> b;
        energies[b] = mean_of_part(bands.band(b), x * side, y * side, side, square);
    }
    return energies;
}

/// What the mean of all frames has in each band, beyond the part of moving noise that is left in
/// it, over a frame's moving noise: of the smoothest tiles, since shapes can only add to it. The
/// part that is left is known by how the means of the first and the last frames differ. `moving`:
/// the shares of the bands; `shown`: the share of its variance that moving noise shows.
NoiseCharacterMeter::Energies NoiseCharacterMeter::standing(const Energies& moving,
                                                            float kept) const {
    Energies standing{};
    const float shown = std::max(shown_in_time(kept), kShownAtLeast);
    const float shared = (1.0F + kept) / (1.0F - kept);
    if (count_ <= kFirstFrames) return standing;
    constexpr auto kFirst = static_cast<float>(kFirstFrames);
    const auto all = static_cast<float>(count_);
    BandPicture mean = sum_;
    BandPicture change = sum_of_first_;
    for (std::size_t k = 0; k < mean.values.size(); ++k) {
        change.values[k] =
            change.values[k] / kFirst - (mean.values[k] - change.values[k]) / (all - kFirst);
        mean.values[k] /= all;
    }
    const float left = 1.0F / all / (1.0F / kFirst + 1.0F / (all - kFirst));
    NoiseBands of_mean;
    NoiseBands of_change;
    of_mean.split(mean);
    of_change.split(change);
    std::array<std::vector<float>, kNoiseBands> shares;
    for (std::size_t k = 0; k < tiles_.size(); ++k) {
        if (tiles_[k].variances.empty() || !has_data(seen_all_, k)) continue;
        const float variance = median_of(tiles_[k].variances) / shown;
        if (!(variance > 0.0F)) continue;
        const auto at = static_cast<int>(k);
        const Energies whole = energies_of(of_mean, at % columns_, at / columns_);
        const Energies changing = energies_of(of_change, at % columns_, at / columns_);
        // What moves is in the change, and not in the mean: it would be taken for little noise.
        const float moved = left * std::accumulate(changing.begin(), changing.end(), 0.0F);
        if (moved > kMoves * variance * std::min(shared / all, 1.0F)) continue;
        for (std::size_t b = 0; b < kNoiseBands; ++b)
            shares[b].push_back((whole[b] - left * changing[b]) / variance);
    }
    float most = std::numeric_limits<float>::infinity();
    for (std::size_t b = 0; b < kNoiseBands; ++b) {
        if (shares[b].size() < kTilesOfBin || !(moving[b] > 0.0F)) continue;
        const float share = std::max(quantile_of(std::move(shares[b]), kVerySmoothTiles), 0.0F);
        const float ratio = std::min(share / moving[b], most);
        most = std::min(most, kMostRise * ratio);
        standing[b] = std::min(kStandingVaries * ratio * moving[b], kMostStanding);
    }
    return standing;
}

void NoiseCharacterMeter::measure(const BandPicture& picture, const std::vector<std::uint8_t>& data,
                                  bool in_time) {
    split_.split(picture);
    for (int y = 0; y < rows_; ++y) {
        for (int x = 0; x < columns_; ++x) {
            const int left = x * kCharacterTile_px;
            const int top = y * kCharacterTile_px;
            const auto number = static_cast<std::size_t>(y * columns_ + x);
            if (!has_data(data, number)) continue;
            Tile& tile = tiles_[number];
            (in_time ? tile.in_time : tile.in_space).push_back(energies_of(split_, x, y));
            if (!in_time) {
                const auto same = [](float value) { return value; };
                tile.levels.push_back(mean_of_part(picture, left, top, kCharacterTile_px, same));
                continue;
            }
            tile.variances.push_back(mean_of_part(picture, left, top, kCharacterTile_px, square));
            double one = 0.0;
            double two = 0.0;
            double rise = 0.0;
            double rise_of_two = 0.0;
            for (int j = top; j < top + kCharacterTile_px; ++j) {
                for (int i = left; i < left + kCharacterTile_px; ++i) {
                    const float first = before_last_.picture.row(j)[i];
                    const float by_one = first - last_.picture.row(j)[i];
                    const float by_two = first - now_.picture.row(j)[i];
                    one += static_cast<double>(square(by_one));
                    two += static_cast<double>(square(by_two));
                    rise += static_cast<double>(by_one);
                    rise_of_two += static_cast<double>(by_two);
                }
            }
            if (!(one > 0.0)) continue;
            tile.ratios.push_back(static_cast<float>(two / one));
            constexpr double kPixels = kCharacterTile_px * kCharacterTile_px;
            const double shaken = one - rise * rise / kPixels;
            if (shaken > 0.0)
                tile.level_ratios.push_back(
                    static_cast<float>((two - rise_of_two * rise_of_two / kPixels) / shaken));
        }
    }
}

std::vector<NoiseCharacterMeter::Bin> NoiseCharacterMeter::bins() const {
    std::vector<Bin> bins(kCharacterBins);
    const auto bin_of = [&](float level) -> Bin& {
        const double height = std::clamp(static_cast<double>(level) / highest_, 0.0, 0.999);
        return bins[static_cast<std::size_t>(height * kCharacterBins)];
    };
    for (const Tile& tile : tiles_) {
        if (tile.levels.empty()) continue;
        Bin& bin = bin_of(median_of(tile.levels));
        bin.in_space.push_back(medians_of(tile.in_space));
        if (tile.in_time.empty()) continue;
        bin.in_time.push_back(medians_of(tile.in_time));
        bin.variances.push_back(median_of(tile.variances));
        bin.ratios.push_back(tile.ratios.empty() ? 1.0F : median_of(tile.ratios));
        bin.level_ratios.push_back(tile.level_ratios.empty() ? 1.0F : median_of(tile.level_ratios));
        const auto whole = [](const Energies& of) {
            return std::accumulate(of.begin(), of.end(), 0.0F);
        };
        bin.shapes.push_back(whole(bin.in_space.back()) / whole(bin.in_time.back()));
    }
    for (const float level : some_levels_) bin_of(level).levels.push_back(level);
    return bins;
}

NoiseCharacter NoiseCharacterMeter::character() const {
    const std::vector<Bin> all = bins();
    std::array<std::vector<float>, kNoiseBands> shares;
    std::vector<RatioOfTile> ratios;
    for (const Bin& bin : all) {
        if (bin.variances.size() < kTilesOfBin) continue;
        const float most = kAlsoQuiet * quantile_of(bin.variances, kQuietTiles);
        for (std::size_t k = 0; k < bin.variances.size(); ++k) {
            const float variance = bin.variances[k];
            if (!(variance > 0.0F) || variance > most) continue;
            for (std::size_t b = 0; b < kNoiseBands; ++b)
                shares[b].push_back(bin.in_time[k][b] / variance);
            ratios.push_back({bin.shapes[k], bin.ratios[k], bin.level_ratios[k]});
        }
    }
    NoiseCharacter character;
    if (!ratios.empty()) {
        for (std::size_t b = 0; b < kNoiseBands; ++b)
            character.bands[b] = median_of(shares[b]) / kShownByMedian[b];
        const std::pair<float, float> of_two = ratios_of(std::move(ratios));
        character.kept = std::clamp(of_two.first - 1.0F, 0.0F, kMostKeptNoise);
        character.kept_in_motion = std::clamp(of_two.second - 1.0F, 0.0F, kMostKeptNoise);
        character.standing = standing(character.bands, character.kept);
    }
    // What the finest band has in space beyond time and rounding stands still. A texture has more
    // in the coarser bands, or varies from place to place: it is no noise.
    double sum = 0.0;
    double tiles = 0.0;
    for (const Bin& bin : all) {
        if (bin.in_space.size() < kTilesOfBin) continue;
        const std::vector<float> finest = bin.of(bin.in_space, 0);
        const float here = quantile_of(finest, kSmoothestTiles);
        const float next = quantile_of(bin.of(bin.in_space, 1), kSmoothestTiles);
        const auto count = static_cast<double>(bin.in_space.size());
        tiles += count;
        if (next > kDip * kDip * here || median_of(finest) > kEvenNoise * kEvenNoise * here)
            continue;
        const float moving =
            quantile_of(bin.of(bin.in_time, 0), kQuietTiles) / shown_in_time(character.kept);
        const float step = step_in(bin).value_or(0.0F);
        const float rounding = kWhiteBands[0] * step * step / 12.0F;
        sum += count * static_cast<double>(std::max(here - std::max(moving, rounding), 0.0F));
    }
    if (tiles > 0.0)
        character.fixed = static_cast<float>(
            std::sqrt(sum / tiles / static_cast<double>(kWhiteBands[0])) / highest_);
    return character;
}

/// The step of a bin's levels, 0 where they are continuous. Nothing: there are too few.
std::optional<float> NoiseCharacterMeter::step_in(const Bin& bin) {
    if (bin.levels.size() < kLeastLevels) return std::nullopt;
    std::vector<float> levels = bin.levels;
    std::sort(levels.begin(), levels.end());
    std::vector<float> gaps;
    for (std::size_t k = 1; k < levels.size(); ++k)
        if (levels[k] > levels[k - 1]) gaps.push_back(levels[k] - levels[k - 1]);
    if (gaps.size() < kLeastGaps) return std::nullopt;
    const std::size_t repeats = levels.size() - 1 - gaps.size();
    return repeats < kRepeatsPerGap * gaps.size() ? 0.0F
                                                  : quantile_of(std::move(gaps), kTypicalGap);
}

std::vector<LevelStep> NoiseCharacterMeter::steps() const {
    std::vector<LevelStep> steps;
    const std::vector<Bin> all = bins();
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::optional<float> step = step_in(all[k]);
        if (!step) continue;
        steps.push_back({1.0 - (static_cast<double>(k) + 0.5) / kCharacterBins,
                         static_cast<double>(*step) / highest_,
                         std::max(1.0, static_cast<double>(all[k].in_space.size()))});
    }
    return steps;
}

}  // namespace dibhr
