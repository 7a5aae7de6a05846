// Halves a picture by a binomial filter again and again; a band is what each halving loses.
#include "core/video/cleaning/noise_bands.hpp"

#include <algorithm>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// How many values beside a row its filters read.
constexpr std::ptrdiff_t kBeside = 2;

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
        row_.resize(static_cast<std::size_t>(coarse.columns + 2 * kBeside));
        wide_.resize(2 * static_cast<std::size_t>(coarse.columns));
        for (int j = 0; j < fine->rows; ++j) {
            float* const between = row_.data() + kBeside;
            const float* const here = coarse.row(j / 2);
            const float* const after = coarse.row(j / 2 + 1);
            if (j % 2 == 0)
                mix_three(coarse.row(j / 2 - 1), here, after, between, coarse.columns);
            else
                mix_two(here, after, between, coarse.columns);
            pad(row_, coarse.columns);
            double_row(between, wide_.data(), coarse.columns);
            subtract(fine->row(j), wide_.data(), band.row(j), fine->columns);
        }
        fine = &coarse;
    }
}

}  // namespace dibhr
