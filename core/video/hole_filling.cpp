// Closes small holes of a depth image from the levels around them.
#include "core/video/hole_filling.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace dibhr {
namespace {

constexpr int kWidthsInImage = 20;  ///< a hole may be this part of the image's width
constexpr int kNone = -1;           ///< no row holds a level

}  // namespace

void HoleFiller::fill(DepthImage& image) {
    find_runs(image);
    if (runs_.empty()) return;
    join_runs();
    keep_small(image);
    std::size_t pixels = 0;
    for (const Run& run : runs_) pixels += static_cast<std::size_t>(run.end - run.begin);
    sum_.assign(pixels, 0.0F);
    weight_.assign(pixels, 0.0F);
    weigh_rows(image);
    weigh_columns(image, 1);
    weigh_columns(image, -1);
    std::size_t k = 0;
    for (const Run& run : runs_)
        for (int i = run.begin; i < run.end; ++i, ++k)
            if (weight_[k] > 0.0F) image.at(i, run.row) = sum_[k] / weight_[k];
}

void HoleFiller::find_runs(const DepthImage& image) {
    runs_.clear();
    for (int j = 0; j < image.rows; ++j) {
        const float* row = image.levels.data() + image.index(0, j);
        const float* const end = row + image.columns;
        for (const float* at = std::find(row, end, 0.0F); at != end;
             at = std::find(at, end, 0.0F)) {
            const float* const stop =
                std::find_if(at, end, [](float level) { return level != 0.0F; });
            runs_.push_back({j, static_cast<int>(at - row), static_cast<int>(stop - row), 0});
            at = stop;
        }
    }
}

/// Each run begins as its own patch and joins those of the row above that it touches.
void HoleFiller::join_runs() {
    patches_.clear();
    std::size_t above = 0;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        Run& run = runs_[k];
        run.patch = static_cast<std::int32_t>(k);
        patches_.push_back({run.begin, run.end, run.row, run.row + 1, run.patch});
        while (above < k && (runs_[above].row < run.row - 1 ||
                             (runs_[above].row == run.row - 1 && runs_[above].end < run.begin)))
            ++above;
        for (std::size_t a = above;
             a < k && runs_[a].row == run.row - 1 && runs_[a].begin <= run.end; ++a)
            join(runs_[a].patch, run.patch);
    }
}

std::int32_t HoleFiller::root(std::int32_t patch) {
    const auto parent = [this](std::int32_t p) -> std::int32_t& {
        return patches_[static_cast<std::size_t>(p)].parent;
    };
    while (parent(patch) != patch) {
        parent(patch) = parent(parent(patch));
        patch = parent(patch);
    }
    return patch;
}

void HoleFiller::join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    Patch& first = patches_[static_cast<std::size_t>(a)];
    Patch& second = patches_[static_cast<std::size_t>(b)];
    second.parent = a;
    first.left = std::min(first.left, second.left);
    first.right = std::max(first.right, second.right);
    first.top = std::min(first.top, second.top);
    first.bottom = std::max(first.bottom, second.bottom);
}

/// Forgets the runs of patches that are too large to be filled.
void HoleFiller::keep_small(const DepthImage& image) {
    const int most = std::max(2, image.columns / kWidthsInImage);
    const auto large = [&](const Run& run) {
        const Patch& patch = patches_[static_cast<std::size_t>(root(run.patch))];
        return patch.right - patch.left > most || patch.bottom - patch.top > most;
    };
    runs_.erase(std::remove_if(runs_.begin(), runs_.end(), large), runs_.end());
}

void HoleFiller::weigh_rows(const DepthImage& image) {
    std::size_t k = 0;
    for (const Run& run : runs_) {
        const bool left = run.begin > 0;
        const bool right = run.end < image.columns;
        const float left_level = left ? image.at(run.begin - 1, run.row) : 0.0F;
        const float right_level = right ? image.at(run.end, run.row) : 0.0F;
        for (int i = run.begin; i < run.end; ++i, ++k) {
            const float from_left = left ? 1.0F / static_cast<float>(i - run.begin + 1) : 0.0F;
            const float from_right = right ? 1.0F / static_cast<float>(run.end - i) : 0.0F;
            sum_[k] += left_level * from_left + right_level * from_right;
            weight_[k] += from_left + from_right;
        }
    }
}

/// Walks the runs down (step 1) or up (-1). Where the pixel before is no hole it is the column's
/// nearest level from here on; where it is one, it belongs to the same patch and its column stands.
void HoleFiller::weigh_columns(const DepthImage& image, int step) {
    column_level_.assign(static_cast<std::size_t>(image.columns), 0.0F);
    column_row_.assign(static_cast<std::size_t>(image.columns), kNone);
    std::size_t before = step > 0 ? 0 : sum_.size();
    for (std::size_t n = 0; n < runs_.size(); ++n) {
        const Run& run = runs_[step > 0 ? n : runs_.size() - 1 - n];
        const auto length = static_cast<std::size_t>(run.end - run.begin);
        const std::size_t first = step > 0 ? before : before - length;
        const int previous = run.row - step;
        const bool inside = previous >= 0 && previous < image.rows;
        for (int i = run.begin; i < run.end; ++i) {
            const auto column = static_cast<std::size_t>(i);
            if (!inside) {
                column_row_[column] = kNone;
            } else if (const float level = image.at(i, previous); level != 0.0F) {
                column_level_[column] = level;
                column_row_[column] = previous;
            }
            if (column_row_[column] == kNone) continue;
            const std::size_t k = first + static_cast<std::size_t>(i - run.begin);
            const float near = 1.0F / static_cast<float>(std::abs(run.row - column_row_[column]));
            sum_[k] += column_level_[column] * near;
            weight_[k] += near;
        }
        before = step > 0 ? first + length : first;
    }
}

}  // namespace dibhr
