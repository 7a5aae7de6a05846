// Connected pixels of a depth image: holes, and islands of data in holes.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// No data is no number.
[[nodiscard]] inline bool is_data(float level) noexcept {
    return !std::isnan(level);
}

/// visit(begin, end) for each run of values of a row, [begin, end), for which `is_in` is true.
template <typename Value, typename IsIn, typename Visit>
void visit_runs(const Value* row, int columns, const IsIn& is_in, const Visit& visit) {
    const Value* const end = row + columns;
    for (const Value* at = std::find_if(row, end, is_in); at != end;) {
        const Value* const stop = std::find_if_not(at, end, is_in);
        visit(static_cast<int>(at - row), static_cast<int>(stop - row));
        at = std::find_if(stop, end, is_in);
    }
}

/// The first of the marks [at, count) that is set (not 0), or the first that is 0; else `count`.
[[nodiscard]] inline int next_mark(const std::uint8_t* marks, int at, int count,
                                   bool is_set) noexcept {
    constexpr std::uint64_t kOnes = 0x0101010101010101U;
    for (; std::endian::native == std::endian::little && at + 8 <= count; at += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, marks + at, sizeof eight);
        // The lowest bit left is of the first byte that is 0: a borrow reaches later bytes only.
        if (!is_set) eight = (eight - kOnes) & ~eight & (kOnes << 7U);
        if (eight != 0) return at + std::countr_zero(eight) / 8;
    }
    while (at < count && (marks[at] != 0) != is_set) ++at;
    return at;
}

/// visit(begin, end) for each run of marks that are not 0.
template <typename Visit>
void visit_marked(const std::uint8_t* row, int columns, const Visit& visit) {
    for (int begin = next_mark(row, 0, columns, true); begin < columns;) {
        const int end = next_mark(row, begin, columns, false);
        visit(begin, end);
        begin = next_mark(row, end, columns, true);
    }
}

/// Whether any of the pixels has no data.
[[nodiscard]] bool has_holes(const float* levels, std::size_t count) noexcept;
[[nodiscard]] inline bool has_holes(const DepthImage& image) noexcept {
    return has_holes(image.levels.data(), image.levels.size());
}

/// Marks pixels without data with 1, others with 0. Returns whether there are any.
bool mark_holes(const float* levels, std::uint8_t* marks, std::size_t count) noexcept;

/// Largest difference of levels on one surface, with noise [levels]. Levels that differ by more are
/// on two sides of an object's outline.
[[nodiscard]] float outline_levels(const DepthImage& image) noexcept;

/// Patches of pixels with data or without (NaN), joined over edges and corners, row by row.
class Patches {
  public:
    /// Pixels [begin, end) of one row.
    struct Run {
        int row, begin, end;
        std::int32_t patch;
    };
    /// The box around a patch, columns [left, right), rows [top, bottom), and its count of pixels.
    struct Patch {
        int left, right, top, bottom;
        std::size_t pixels;
    };

    void find_holes(const DepthImage& image) { find(image, false); }
    void find_data(const DepthImage& image) { find(image, true); }

    [[nodiscard]] const std::vector<Run>& runs() const noexcept { return runs_; }
    [[nodiscard]] const Patch& patch(std::int32_t number) const noexcept {
        return patches_[static_cast<std::size_t>(number)];
    }

  private:
    void find(const DepthImage& image, bool with_data);
    void find_runs(const DepthImage& image, bool with_data);
    void join_runs();
    std::int32_t root(std::int32_t patch);
    void join(std::int32_t a, std::int32_t b);

    std::vector<std::uint8_t> marks_{};  ///< of a row
    std::vector<Run> runs_{};
    std::vector<Patch> patches_{};
    std::vector<std::int32_t> parents_{};  ///< of each patch the one that it is joined to
};

}  // namespace dibhr
