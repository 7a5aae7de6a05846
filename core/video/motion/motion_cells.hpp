// The picture in cells, each with one surface or with a near and a far part, and sums over parts
// that are alike in depth.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/motion/motion_pictures.hpp"

namespace dibhr {

/// Two values of each cell: for its near part [0], and its far part [1].
struct MotionLayers {
    std::array<MotionPlane, 2> of{};

    void resize(int columns, int rows) {
        for (MotionPlane& plane : of) plane.resize(columns, rows);
    }
    void fill(float value) {
        for (MotionPlane& plane : of) std::fill(plane.values.begin(), plane.values.end(), value);
    }
};

/// Sums over the pixels of a part: n counts them, r is the difference of the moved second picture
/// from the first, x and y are the slopes of the first. The first three need the difference only.
enum class MotionSum { n, r, rr, x, y, xx, xy, yy, xr, yr };
inline constexpr std::size_t kMotionSums = 10;

/// How many of the sums are computed.
enum class MotionMeasure : std::size_t { difference = 3, slopes = kMotionSums };

struct MotionSums {
    std::array<MotionLayers, kMotionSums> of{};

    void resize(int columns, int rows) {
        for (MotionLayers& layers : of) layers.resize(columns, rows);
    }
    void fill(float value) {
        for (MotionLayers& layers : of) layers.fill(value);
    }
    [[nodiscard]] MotionLayers& operator[](MotionSum sum) {
        return of[static_cast<std::size_t>(sum)];
    }
    [[nodiscard]] const MotionLayers& operator[](MotionSum sum) const {
        return of[static_cast<std::size_t>(sum)];
    }
    /// Not with so few pixels.
    [[nodiscard]] bool is_known(std::size_t part, std::size_t k) const {
        constexpr float kFewPixels = 2.0F;
        return (*this)[MotionSum::n].of[part].values[k] > kFewPixels;
    }
    /// Mean square of the differences of a part, without their common offset.
    [[nodiscard]] float mean_square(std::size_t part, std::size_t k) const {
        const float n = (*this)[MotionSum::n].of[part].values[k];
        const float r = (*this)[MotionSum::r].of[part].values[k] / n;
        return (*this)[MotionSum::rr].of[part].values[k] / n - r * r;
    }
};

/// Mean square at which a part's trust is a quarter [levels^2].
inline constexpr float kMotionFits = 50.0F;
/// Trust of a part that does not fit at all.
inline constexpr float kLeastMotionTrust = 0.01F;

/// Weight, in [0, 1], of a part with this mean square: Geman and McClure's.
[[nodiscard]] inline float motion_trust(float mean_square, float fits = kMotionFits) {
    const float share = fits / (fits + mean_square);
    return std::max(share * share, kLeastMotionTrust);
}

/// How far parts move [px of the largest picture].
struct MotionWays {
    MotionLayers right{}, down{};

    void resize(int columns, int rows) {
        right.resize(columns, rows);
        down.resize(columns, rows);
    }
    void fill(float value) {
        right.fill(value);
        down.fill(value);
    }
};

/// Depths that differ by less may be of one surface [depth, 0 to 255].
inline constexpr float kMotionAlike = 12.0F;

/// How alike two parts are in depth, in [0, 1], by the gap between their depths.
[[nodiscard]] inline float alike_across(float gap) {
    const float alike = 1.0F - gap * (1.0F / kMotionAlike);
    return std::min(std::max(alike, 0.0F), 1.0F);
}

/// The near part of a cell (0), or the far one (1).
struct MotionPart {
    int i, j;
    std::size_t part;
};

/// Cells of kMotionCell_px squared.
struct MotionCells {
    int columns{0};
    int rows{0};
    /// Depth that separates the parts: above it is the near part. Below all depths of the cell:
    /// there is no far part.
    MotionPlane threshold{};
    /// Range of depth of the parts [0, 255]; `highest` is kNoPart where there is no such part.
    MotionLayers lowest{}, highest{};

    std::vector<std::uint32_t> split{};  ///< indices of cells with both parts, in order

    static constexpr float kNoPart = -1e9F;

    [[nodiscard]] bool has(std::size_t part, int i, int j) const {
        return highest.of[part].row(j)[i] != kNoPart;
    }
    [[nodiscard]] MotionPart part_at(std::size_t part, std::size_t k) const {
        const auto across = static_cast<std::size_t>(columns);
        return {static_cast<int>(k % across), static_cast<int>(k / across), part};
    }
    /// Between the depths of two parts.
    [[nodiscard]] float gap(const MotionPart& a, const MotionPart& b) const {
        const auto depth = [](const MotionLayers& of, const MotionPart& part) {
            return of.of[part.part].row(part.j)[part.i];
        };
        return std::max(depth(lowest, a) - depth(highest, b), depth(lowest, b) - depth(highest, a));
    }

    /// visit(part, index of its cell) for all parts.
    template <typename Visit>
    void each_part(const Visit& visit) const {
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) visit(MotionPart{i, j, 0}, threshold.index(i, j));
        for (const std::uint32_t k : split) visit(part_at(1, k), std::size_t{k});
    }
    /// visit(part, index of its cell, how alike in depth) for the parts around one that are of its
    /// surface.
    template <typename Visit>
    void each_alike(const MotionPart& of, const Visit& visit) const {
        for (int j = std::max(of.j - 1, 0); j <= std::min(of.j + 1, rows - 1); ++j)
            for (int i = std::max(of.i - 1, 0); i <= std::min(of.i + 1, columns - 1); ++i)
                for (std::size_t part = 0; part < 2; ++part) {
                    if (!has(part, i, j) || (i == of.i && j == of.j && part == of.part)) continue;
                    const MotionPart beside{i, j, part};
                    const float alike = alike_across(gap(of, beside));
                    if (alike > 0.0F) visit(beside, threshold.index(i, j), alike);
                }
    }
};

/// One of the two frames.
struct MotionSide {
    MotionPictures pictures{};
    MotionCells cells{};
    /// Of a cell: its lowest depth, and the highest within an outline's reach. Likewise of four
    /// cells, of which it is the upper left one.
    MotionPlane lowest{}, highest{}, lowest_of_four{}, highest_of_four{};
};

/// Makes the cells of the side's pictures.
void split_into_cells(MotionSide& side);

/// Rows of cells [begin, end) that are processed.
struct MotionRows {
    int begin{0}, end{0};
};

/// Sums over ways of parts around a place; in a vector: around several places.
template <typename Value>
struct MotionMoments {
    Value n{}, x{}, y{}, xx{}, xy{}, yy{};
    Value right{}, right_x{}, right_y{};
    Value down{}, down_x{}, down_y{};

    /// Adds a part that lies (i, j) cells away: its weight, and its way times that weight.
    [[gnu::always_inline]] void add(const Value& weight, const Value& rights, const Value& downs,
                                    float i, float j) {
        n += weight;
        x += weight * i;
        y += weight * j;
        xx += weight * (i * i);
        xy += weight * (i * j);
        yy += weight * (j * j);
        right += rights;
        right_x += rights * i;
        right_y += rights * j;
        down += downs;
        down_x += downs * i;
        down_y += downs * j;
    }
};

/// How alike in depth each part is to those around it: found once, used for many sums. Near parts,
/// which every cell has, are stored in planes; far parts in a list.
class SimilarParts {
  public:
    static constexpr int kReach = 2;           ///< cells to each side
    static constexpr std::size_t kMargin = 8;  ///< values that may be read beyond the end

    void find(const MotionCells& cells);

    /// Sums for each part in the rows: over all parts up to `reach` (kReach at most) cells away,
    /// weighted by how alike they are.
    void gather(const MotionRows& rows, int reach, MotionMeasure measure, const MotionSums& from,
                MotionSums& to) const;

    /// The way of even motion, which may turn and grow, for each wanted part: that of the plane
    /// through the ways of the wanted parts around it.
    void smooth(const MotionLayers& wanted, const MotionWays& from, MotionWays& to);

    /// How alike each cell's near part is to the near part this many cells away; 0 outside.
    [[nodiscard]] const float* near_beside(int right, int down) const {
        return near_.data() + tap(right, down) * count_;
    }

  private:
    static constexpr auto kSide = std::size_t{2 * kReach + 1};
    struct Edge {
        std::uint32_t to, from;
        float alike;
        std::uint8_t to_part, from_part;
        std::int8_t right, down;  ///< cells to `from`
    };
    [[nodiscard]] static std::size_t tap(int right, int down) {
        return static_cast<std::size_t>(down + kReach) * kSide +
               static_cast<std::size_t>(right + kReach);
    }
    void find_near(const MotionCells& cells, int right, int down);
    void find_far(const MotionCells& cells, int i, int j);
    void add_near_moments(const MotionLayers& wanted, const MotionWays& ways);
    void add_far_moments(const MotionLayers& wanted, const MotionWays& ways);

    int columns_{0}, rows_{0};
    std::size_t count_{0};
    std::vector<float> near_{};
    std::vector<std::uint32_t> split_{};
    /// Edges with a far part at one end or both: at most one cell long, and longer ones.
    std::array<std::vector<Edge>, kReach> far_{};
    // For smooth(): moments of the ways around each part; weights and ways, with a margin.
    std::array<std::vector<MotionMoments<float>>, 2> moments_{};
    std::array<std::vector<float>, 3> padded_{};
};

}  // namespace dibhr
