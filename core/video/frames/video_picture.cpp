// Red, green and blue of luma and chroma, for what is drawn by the processor.
#include "core/video/frames/video_picture.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kWhite = 255.0F;

float highest_of(const VideoPicture& picture) {
    return picture.sample_bytes == 1 ? 255.0F : 65535.0F;
}

/// Of samples as they are stored, to [0, 255].
std::array<std::array<float, 4>, 3> bytes_of_samples(const VideoPicture& picture) {
    auto matrix = picture.rgb_of_samples;
    const float each = kWhite / highest_of(picture);
    for (auto& row : matrix) {
        for (std::size_t k = 0; k < 3; ++k) row[k] *= each;
        row[3] = kWhite * row[3] + 0.5F;
    }
    return matrix;
}

float sample_at(const VideoPicture& picture, std::size_t of_plane, int channel, int column,
                int row) {
    const SamplePlane& plane = picture.planes[of_plane];
    const auto channels =
        static_cast<std::size_t>(picture.plane_count == 2 && of_plane > 0 ? 2 : 1);
    const std::size_t place =
        static_cast<std::size_t>(row) * plane.row_bytes +
        (static_cast<std::size_t>(column) * channels + static_cast<std::size_t>(channel)) *
            static_cast<std::size_t>(picture.sample_bytes);
    if (picture.sample_bytes == 1) return static_cast<float>(plane.samples[place]);
    std::uint16_t word = 0;
    std::memcpy(&word, plane.samples + place, sizeof word);
    return static_cast<float>(word);
}

/// Samples of one row for every `step`-th pixel of luma.
struct RowTaker {
    int step;
    int count;

    template <typename Sample>
    void take(const Sample* from, int shift, int channels, int columns, std::uint16_t* to) const {
        if (columns == 1) {
            std::fill_n(to, count, std::uint16_t{*from});
        } else if (step == 1 && shift == 0 && channels == 1) {
            std::copy_n(from, count, to);
        } else if (step == 1 && shift == 1) {
            for (std::ptrdiff_t k = 0; 2 * k < count; ++k)  // `to` has room for one more
                to[2 * k] = to[2 * k + 1] = from[k * channels];
        } else {
            for (std::ptrdiff_t k = 0; k < count; ++k)
                to[k] = from[std::min<std::ptrdiff_t>((k * step + step / 2) >> shift, columns - 1) *
                             channels];
        }
    }

    void take(const VideoPicture& picture, std::size_t of_plane, int channel, int row,
              std::vector<std::uint16_t>& to) const {
        const SamplePlane& plane = picture.planes[of_plane];
        const std::uint8_t* const from =
            plane.samples + static_cast<std::size_t>(row) * plane.row_bytes +
            static_cast<std::size_t>(channel) * static_cast<std::size_t>(picture.sample_bytes);
        const int shift = plane.columns < picture.planes[0].columns ? 1 : 0;
        const int channels = picture.plane_count == 2 && of_plane > 0 ? 2 : 1;
        if (picture.sample_bytes == 1)
            take(from, shift, channels, plane.columns, to.data());
        else
            take(reinterpret_cast<const std::uint16_t*>(from), shift, channels, plane.columns,
                 to.data());
    }
};

DIBHR_VECTOR_CLONES void write_row(const std::uint16_t* __restrict luma,
                                   const std::uint16_t* __restrict blue,
                                   const std::uint16_t* __restrict red,
                                   const std::array<std::array<float, 4>, 3>& matrix, int count,
                                   std::uint32_t* __restrict to) {
    const auto [r, g, b] = matrix;
    for (int i = 0; i < count; ++i) {
        const auto y = static_cast<float>(luma[i]);
        const auto u = static_cast<float>(blue[i]);
        const auto v = static_cast<float>(red[i]);
        const float of_red = r[0] * y + r[1] * u + r[2] * v + r[3];
        const float of_green = g[0] * y + g[1] * u + g[2] * v + g[3];
        const float of_blue = b[0] * y + b[1] * u + b[2] * v + b[3];
        const auto first = static_cast<std::uint32_t>(
            static_cast<std::int32_t>(std::min(std::max(of_red, 0.0F), kWhite)));
        const auto second = static_cast<std::uint32_t>(
            static_cast<std::int32_t>(std::min(std::max(of_green, 0.0F), kWhite)));
        const auto third = static_cast<std::uint32_t>(
            static_cast<std::int32_t>(std::min(std::max(of_blue, 0.0F), kWhite)));
        to[i] = std::endian::native == std::endian::little
                    ? first | second << 8U | third << 16U | 0xff000000U
                    : first << 24U | second << 16U | third << 8U | 0xffU;
    }
}

}  // namespace

PlaneTurn turn_of(int quarter_turns) noexcept {
    switch (quarter_turns) {
        case 1:
            return {{0.0F, 1.0F, 0.0F}, {-1.0F, 0.0F, 1.0F}};
        case 2:
            return {{-1.0F, 0.0F, 1.0F}, {0.0F, -1.0F, 1.0F}};
        case 3:
            return {{0.0F, -1.0F, 1.0F}, {1.0F, 0.0F, 0.0F}};
        default:
            return {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    }
}

std::array<std::uint8_t, 3> rgb_at(const VideoPicture& picture, int column, int row) noexcept {
    const auto x = (static_cast<float>(column) + 0.5F) / static_cast<float>(picture.columns);
    const auto y = (static_cast<float>(row) + 0.5F) / static_cast<float>(picture.rows);
    const PlaneTurn turn = turn_of(picture.quarter_turns);
    const float across = turn.across[0] * x + turn.across[1] * y + turn.across[2];
    const float down = turn.down[0] * x + turn.down[1] * y + turn.down[2];
    const auto place = [](float share, int count) {
        return std::clamp(static_cast<int>(share * static_cast<float>(count)), 0, count - 1);
    };
    const SamplePlane& luma = picture.planes[0];
    const int i = place(across, luma.columns);
    const int j = place(down, luma.rows);
    std::array<float, 3> samples{sample_at(picture, 0, 0, i, j)};
    for (int k = 1; k < 3; ++k) {
        const bool is_second = picture.plane_count == 2 && k == 2;
        const std::size_t of_plane = is_second ? 1 : static_cast<std::size_t>(k);
        const SamplePlane& plane = picture.planes[of_plane];
        samples[static_cast<std::size_t>(k)] =
            sample_at(picture, of_plane, is_second ? 1 : 0, i * plane.columns / luma.columns,
                      j * plane.rows / luma.rows);
    }
    std::array<std::uint8_t, 3> rgb{};
    const auto matrix = bytes_of_samples(picture);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& of = matrix[k];
        const float value = of[0] * samples[0] + of[1] * samples[1] + of[2] * samples[2] + of[3];
        rgb[k] = static_cast<std::uint8_t>(std::clamp(value, 0.0F, kWhite));
    }
    return rgb;
}

std::array<int, 2> write_rgbx(const VideoPicture& picture, int step,
                              std::vector<std::uint32_t>& rgbx) {
    const SamplePlane& luma = picture.planes[0];
    const SamplePlane& chroma = picture.planes[1];
    const int columns = std::max(luma.columns / step, 1);
    const int rows = std::max(luma.rows / step, 1);
    const auto matrix = bytes_of_samples(picture);
    const bool has_two = picture.plane_count == 2;
    const RowTaker taker{step, columns};
    const std::size_t room = static_cast<std::size_t>(columns) + 1;
    std::vector<std::uint16_t> luminances(room), blues(room), reds(room);
    rgbx.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    int taken = -1;  // row of chroma
    for (int j = 0; j < rows; ++j) {
        const int row = std::min(j * step + step / 2, luma.rows - 1);
        const int chroma_row = static_cast<int>(std::int64_t{row} * chroma.rows / luma.rows);
        taker.take(picture, 0, 0, row, luminances);
        if (chroma_row != taken) {
            taker.take(picture, 1, 0, chroma_row, blues);
            taker.take(picture, has_two ? 1 : 2, has_two ? 1 : 0, chroma_row, reds);
            taken = chroma_row;
        }
        write_row(luminances.data(), blues.data(), reds.data(), matrix, columns,
                  rgbx.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(columns));
    }
    return {columns, rows};
}

}  // namespace dibhr
