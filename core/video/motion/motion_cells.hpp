// The picture in cells, each of one surface or of a near and a far one, and sums over those alike.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/motion/motion_pictures.hpp"

namespace dibhr {

/// One value of each cell for what is near in it and for what is far.
struct MotionLayers {
    std::array<MotionPlane, 2> of{};

    void resize(int columns, int rows) {
        for (MotionPlane& plane : of) plane.resize(columns, rows);
    }
    void fill(float value) {
        for (MotionPlane& plane : of) std::fill(plane.values.begin(), plane.values.end(), value);
    }
};

/// What is summed over the pixels of a part of a surface, of the difference r between the second
/// picture, moved, and the first, whose slope is x and y.
/// The first three are of the difference alone.
enum class MotionSum { n, r, rr, x, y, xx, xy, yy, xr, yr };
inline constexpr std::size_t kMotionSums = 10;

/// Which of them are wanted: as many as it says.
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
};

/// Which way parts go [px of the largest picture].
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

/// Cells of kMotionCell_px squared.
struct MotionCells {
    int columns{0};
    int rows{0};
    /// What is above it is the near part, the rest the far one; below all: there is no far part.
    MotionPlane between{};
    /// Depths of the parts [0, 255]; the highest is kNoPart where the cell has no such part.
    MotionLayers lowest{}, highest{};

    std::vector<std::uint32_t> split{};  ///< indices of those that have both, in order

    static constexpr float kNoPart = -1e9F;

    [[nodiscard]] bool has(std::size_t part, int i, int j) const {
        return highest.of[part].row(j)[i] != kNoPart;
    }
};

/// One frame of the two.
struct MotionSide {
    MotionPictures pictures{};
    MotionCells cells{};
    /// Of all that is in a cell, and nearer within an outline's reach; and in four of them, with
    /// that one up left.
    MotionPlane lowest{}, highest{}, lowest_of_four{}, highest_of_four{};
};

/// Makes the cells of its pictures.
void divide(MotionSide& side);

/// Rows of cells [begin, end) that are looked at.
struct MotionRows {
    int begin{0}, end{0};
};

/// Depths that differ by less may be of one surface [0, 255].
inline constexpr float kMotionAlike = 12.0F;

/// How alike two parts are in depth, in [0, 1], by the gap between their depths.
[[nodiscard]] inline float alike_across(float gap) {
    const float alike = 1.0F - gap * (1.0F / kMotionAlike);
    return std::min(std::max(alike, 0.0F), 1.0F);
}

/// Sums over ways that lie about a place, of one place or, in a vector, of several.
template <typename Value>
struct MotionMoments {
    Value n{}, x{}, y{}, xx{}, xy{}, yy{};
    Value right{}, right_x{}, right_y{};
    Value down{}, down_x{}, down_y{};

    /// Of what lies (i, j) away: its weight, and its way with that weight.
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

/// Which parts are alike those around them: found once, asked for many sums. Near parts, which are
/// everywhere, lie in planes; far ones in a list.
class MotionKin {
  public:
    static constexpr int kReach = 2;           ///< cells to each side
    static constexpr std::size_t kMargin = 8;  ///< read beyond an end, without meaning

    void find(const MotionCells& cells);

    /// For each part in the rows the sums over all parts up to `reach` (kReach at most) cells away,
    /// the more the more alike their depths are.
    void gather(const MotionRows& rows, int reach, MotionMeasure measure, const MotionSums& from,
                MotionSums& to) const;

    /// For each wanted part the way that even motion would have, which turns and grows: that of the
    /// plane through the ways of the wanted parts around it.
    void smooth(const MotionLayers& wanted, const MotionWays& from, MotionWays& to);

    /// Of the near part of every cell beside the near one so many cells away: how alike they are;
    /// 0 where that is outside.
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
    /// With a far part at an end, and at most so many cells long: beside each other, farther.
    std::array<std::vector<Edge>, kReach> far_{};
    // For smooth(): of the ways around each part; and what each weighs, and its way, with a margin.
    std::array<std::vector<MotionMoments<float>>, 2> moments_{};
    std::array<std::vector<float>, 3> padded_{};
};

}  // namespace dibhr
