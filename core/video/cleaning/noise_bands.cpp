// Halves a picture by a binomial filter again and again; a band is what each halving loses.
#include "core/video/cleaning/noise_bands.hpp"

#include <algorithm>
#include <cmath>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// How many values beside a row its filters read.
constexpr std::ptrdiff_t kBeside = 2;
constexpr int kEnergyReach = 4;  ///< rows and columns of the halved picture to each side
/// Energy within this many times the noise is noise: around a pixel it varies by a fifth.
constexpr float kNoiseBeyond = 1.6F;
/// That happens now and then: noise beyond so many times the stated one would make a pimple of it,
/// so that energy must be the more beyond it.
constexpr float kUnseen = 2.7F;
/// As squares: of single values, whose noise is at most that of both last bands.
constexpr float kCoarseBeyond = 16.0F;

/// The binomial filter of 1, 4, 6, 4, 1 sixteenths.
inline float binomial(float a, float b, float c, float d, float e) {
    return 0.0625F * (a + e) + 0.25F * (b + d) + 0.375F * c;
}

DIBHR_VECTOR_CLONES void filter_rows(const std::array<const float*, 5>& rows, float* __restrict out,
                                     std::ptrdiff_t columns) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
    for (std::ptrdiff_t i = 0; i < columns; ++i) out[i] = binomial(a[i], b[i], c[i], d[i], e[i]);
}

DIBHR_VECTOR_CLONES void halve_row(const float* row, float* __restrict out,
                                   std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) {
        const float* const at = row + 2 * i;
        out[i] = binomial(at[-2], at[-1], at[0], at[1], at[2]);
    }
}

/// At a pixel of the coarser picture: its filter of 1, 6, 1 eighths; between two: their mean.
DIBHR_VECTOR_CLONES void mix_three(const float* before, const float* here, const float* after,
                                   float* __restrict out, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i)
        out[i] = 0.125F * (before[i] + after[i]) + 0.75F * here[i];
}

DIBHR_VECTOR_CLONES void mix_two(const float* here, const float* after, float* __restrict out,
                                 std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) out[i] = 0.5F * (here[i] + after[i]);
}

DIBHR_VECTOR_CLONES void double_row(const float* row, float* __restrict out,
                                    std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) {
        out[2 * i] = 0.125F * (row[i - 1] + row[i + 1]) + 0.75F * row[i];
        out[2 * i + 1] = 0.5F * (row[i] + row[i + 1]);
    }
}

DIBHR_VECTOR_CLONES void subtract(const float* row, const float* smooth, float* __restrict out,
                                  std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) out[i] = row[i] - smooth[i];
}

DIBHR_VECTOR_CLONES void filter_squares(const std::array<const float*, 5>& rows,
                                        float* __restrict out, std::ptrdiff_t columns) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
    for (std::ptrdiff_t i = 0; i < columns; ++i)
        out[i] = binomial(a[i] * a[i], b[i] * b[i], c[i] * c[i], d[i] * d[i], e[i] * e[i]);
}

/// The binomial filter of nine values, 1 to 70 and back to 1, over 256.
inline float binomial_of_nine(float middle, float one, float two, float three, float four) {
    return (70.0F * middle + 56.0F * one + 28.0F * two + 8.0F * three + four) / 256.0F;
}

DIBHR_VECTOR_CLONES void filter_nine_rows(const std::array<const float*, 9>& rows,
                                          float* __restrict out, std::ptrdiff_t columns) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4], *f = rows[5],
                *g = rows[6], *h = rows[7], *k = rows[8];
    for (std::ptrdiff_t i = 0; i < columns; ++i)
        out[i] = binomial_of_nine(e[i], d[i] + f[i], c[i] + g[i], b[i] + h[i], a[i] + k[i]);
}

/// How much of a band is kept: nearly all of what is far beyond the noise, of what is within it no
/// more than the stated noise is of what is left.
DIBHR_VECTOR_CLONES void find_gains_of_row(const float* energy, const float* noise,
                                           const float* whole_noise, float stated,
                                           float* __restrict gain, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) {
        const float* const e = energy + i;
        const float around =
            binomial_of_nine(e[0], e[-1] + e[1], e[-2] + e[2], e[-3] + e[3], e[-4] + e[4]);
        const float seen = std::sqrt(noise[i]) / (kUnseen * stated);
        const float beyond = kNoiseBeyond * std::max(seen, 1.0F);
        const float part = beyond * noise[i] / std::max(around, 1e-20F);
        const float square = part * part;
        const float least = std::min(stated / std::sqrt(std::max(whole_noise[i], 1e-20F)), 1.0F);
        gain[i] = std::max(1.0F - square * square, least);
    }
}

DIBHR_VECTOR_CLONES void mix_noise(const float* moving, const float* standing, float share_moving,
                                   float share_standing, float* __restrict out,
                                   std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i)
        out[i] = share_moving * moving[i] + share_standing * standing[i];
}

DIBHR_VECTOR_CLONES void add_part(const float* band, const float* gain, float* __restrict out,
                                  std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) out[i] += gain[i] * band[i];
}

DIBHR_VECTOR_CLONES void add_times(const float* smooth, const float* band, float factor,
                                   float* __restrict out, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) out[i] = smooth[i] + factor * band[i];
}

/// Of what is coarser than all bands only what is surely more than noise is kept.
DIBHR_VECTOR_CLONES void keep_beyond(const float* noise, float* __restrict values,
                                     std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) {
        const float square = std::max(values[i] * values[i], 1e-20F);
        values[i] *= std::max(1.0F - kCoarseBeyond * noise[i] / square, 0.0F);
    }
}

/// Repeats the values at both ends of a row of `columns` values that begins at kBeside.
void pad(std::vector<float>& row, std::ptrdiff_t columns) {
    std::fill_n(row.begin(), kBeside, row[kBeside]);
    std::fill_n(row.begin() + kBeside + columns, kBeside,
                row[static_cast<std::size_t>(kBeside + columns - 1)]);
}

void halve(const BandPicture& fine, BandPicture& coarse, std::vector<float>& scratch) {
    coarse.set_size((fine.columns + 1) / 2, (fine.rows + 1) / 2);
    scratch.resize(static_cast<std::size_t>(fine.columns + 2 * kBeside));
    for (int j = 0; j < coarse.rows; ++j) {
        filter_rows({fine.row(2 * j - 2), fine.row(2 * j - 1), fine.row(2 * j), fine.row(2 * j + 1),
                     fine.row(2 * j + 2)},
                    scratch.data() + kBeside, fine.columns);
        pad(scratch, fine.columns);
        halve_row(scratch.data() + kBeside, coarse.row(j), coarse.columns);
    }
}

/// Row `j` of the picture twice as large; `scratch` and `out` have room for it.
void double_to_row(const BandPicture& coarse, int j, std::vector<float>& scratch,
                   std::vector<float>& out) {
    scratch.resize(static_cast<std::size_t>(coarse.columns + 2 * kBeside));
    out.resize(2 * static_cast<std::size_t>(coarse.columns));
    float* const between = scratch.data() + kBeside;
    const float* const here = coarse.row(j / 2);
    const float* const after = coarse.row(j / 2 + 1);
    if (j % 2 == 0)
        mix_three(coarse.row(j / 2 - 1), here, after, between, coarse.columns);
    else
        mix_two(here, after, between, coarse.columns);
    pad(scratch, coarse.columns);
    double_row(between, out.data(), coarse.columns);
}

}  // namespace

void BandPicture::set_size(int new_columns, int new_rows) {
    columns = new_columns;
    rows = new_rows;
    values.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
}

std::size_t BandPicture::index_of_row(int number) const {
    return static_cast<std::size_t>(std::clamp(number, 0, rows - 1)) *
           static_cast<std::size_t>(columns);
}

void NoiseBands::split(const BandPicture& picture) {
    const BandPicture* fine = &picture;
    for (std::size_t b = 0; b < kNoiseBands; ++b) {
        BandPicture& coarse = coarser_[b];
        halve(*fine, coarse, row_);
        BandPicture& band = bands_[b];
        band.set_size(fine->columns, fine->rows);
        for (int j = 0; j < fine->rows; ++j) {
            double_to_row(coarse, j, row_, wide_);
            subtract(fine->row(j), wide_.data(), band.row(j), fine->columns);
        }
        fine = &coarse;
    }
}

void NoiseBands::weigh(BandPicture& picture, const std::array<float, kNoiseBands>& factors) {
    split(picture);
    std::fill(coarser_.back().values.begin(), coarser_.back().values.end(), 0.0F);
    for (std::size_t b = kNoiseBands; b-- > 0;) {
        BandPicture& out = b == 0 ? picture : coarser_[b - 1];
        for (int j = 0; j < out.rows; ++j) {
            double_to_row(coarser_[b], j, row_, wide_);
            add_times(wide_.data(), bands_[b].row(j), factors[b], out.row(j), out.columns);
        }
    }
}

/// The gains of a band, of every second of its columns and rows.
void NoiseBands::find_gains(std::size_t b, const BandNoise& noise) {
    const BandPicture& band = bands_[b];
    const BandPicture& moving = b == 0 ? noise.moving : moving_[b];
    const BandPicture& standing = b == 0 ? noise.standing : standing_[b];
    const bool stands = !noise.standing.values.empty();
    energy_.set_size(moving.columns, moving.rows);
    row_.resize(static_cast<std::size_t>(band.columns + 2 * kBeside));
    for (int j = 0; j < energy_.rows; ++j) {
        filter_squares({band.row(2 * j - 2), band.row(2 * j - 1), band.row(2 * j),
                        band.row(2 * j + 1), band.row(2 * j + 2)},
                       row_.data() + kBeside, band.columns);
        pad(row_, band.columns);
        halve_row(row_.data() + kBeside, energy_.row(j), energy_.columns);
    }
    float standing_whole = 0.0F;
    for (const float share : noise.standing_shares) standing_whole += share;
    BandPicture& gains = gains_[b];
    gains.set_size(energy_.columns, energy_.rows);
    row_.resize(static_cast<std::size_t>(energy_.columns + 2 * kEnergyReach));
    wide_.resize(static_cast<std::size_t>(energy_.columns));
    wide_gain_.resize(static_cast<std::size_t>(energy_.columns));
    for (int j = 0; j < energy_.rows; ++j) {
        std::array<const float*, 9> rows{};
        for (int k = 0; k < 9; ++k)
            rows[static_cast<std::size_t>(k)] = energy_.row(j + k - kEnergyReach);
        float* const around = row_.data() + kEnergyReach;
        filter_nine_rows(rows, around, energy_.columns);
        std::fill_n(row_.begin(), kEnergyReach, around[0]);
        std::fill_n(row_.end() - kEnergyReach, kEnergyReach, around[energy_.columns - 1]);
        const float* const moves = moving.row(j);
        const float* const stays = stands ? standing.row(j) : moves;
        mix_noise(moves, stays, noise.moving_shares[b], stands ? noise.standing_shares[b] : 0.0F,
                  wide_.data(), energy_.columns);
        mix_noise(moves, stays, 1.0F, stands ? standing_whole : 0.0F, wide_gain_.data(),
                  energy_.columns);
        find_gains_of_row(around, wide_.data(), wide_gain_.data(), noise.stated, gains.row(j),
                          energy_.columns);
    }
}

void NoiseBands::keep_shapes(BandPicture& picture, const BandNoise& noise) {
    split(picture);
    for (std::size_t b = 0; b < kNoiseBands; ++b) {
        if (b > 0) {
            halve(b == 1 ? noise.moving : moving_[b - 1], moving_[b], row_);
            if (!noise.standing.values.empty())
                halve(b == 1 ? noise.standing : standing_[b - 1], standing_[b], row_);
        }
        find_gains(b, noise);
    }
    BandPicture& coarsest = coarser_.back();
    const std::vector<float>& last_standing =
        noise.standing.values.empty() ? moving_.back().values : standing_.back().values;
    wide_.resize(coarsest.values.size());
    const auto count = static_cast<std::ptrdiff_t>(wide_.size());
    const auto of_last_two = [](const std::array<float, kNoiseBands>& shares) {
        return shares[kNoiseBands - 2] + shares[kNoiseBands - 1];
    };
    mix_noise(moving_.back().values.data(), last_standing.data(), of_last_two(noise.moving_shares),
              noise.standing.values.empty() ? 0.0F : of_last_two(noise.standing_shares),
              wide_.data(), count);
    keep_beyond(wide_.data(), coarsest.values.data(), count);
    for (std::size_t b = kNoiseBands; b-- > 0;) {
        BandPicture& out = b == 0 ? picture : coarser_[b - 1];
        for (int j = 0; j < out.rows; ++j) {
            double_to_row(gains_[b], j, row_, wide_gain_);
            double_to_row(coarser_[b], j, row_, wide_);
            std::copy_n(wide_.begin(), out.columns, out.row(j));
            add_part(bands_[b].row(j), wide_gain_.data(), out.row(j), out.columns);
        }
    }
}

}  // namespace dibhr
