// Joins runs of pixels, row by row.
#include "core/video/depth/patches.hpp"

#include <algorithm>

namespace dibhr {

void Patches::find(const DepthImage& image, bool with_data) {
    find_runs(image, with_data);
    join_runs();
    for (Run& run : runs_) run.patch = root(run.patch);
}

void Patches::find_runs(const DepthImage& image, bool with_data) {
    const auto is_in = [with_data](float level) { return is_data(level) == with_data; };
    runs_.clear();
    for (int j = 0; j < image.rows; ++j) {
        visit_runs(image.levels.data() + image.index(0, j), image.columns, is_in,
                   [this, j](int begin, int end) {
                       runs_.push_back({j, begin, end, static_cast<std::int32_t>(runs_.size())});
                   });
    }
}

/// Each run begins as its own patch and joins those of the row above that it touches.
void Patches::join_runs() {
    patches_.clear();
    parents_.clear();
    std::size_t above = 0;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        const Run& run = runs_[k];
        patches_.push_back({run.begin, run.end, run.row, run.row + 1,
                            static_cast<std::size_t>(run.end - run.begin)});
        parents_.push_back(run.patch);
        while (above < k && (runs_[above].row < run.row - 1 ||
                             (runs_[above].row == run.row - 1 && runs_[above].end < run.begin)))
            ++above;
        for (std::size_t a = above;
             a < k && runs_[a].row == run.row - 1 && runs_[a].begin <= run.end; ++a)
            join(runs_[a].patch, run.patch);
    }
}

std::int32_t Patches::root(std::int32_t patch) {
    const auto parent = [this](std::int32_t p) -> std::int32_t& {
        return parents_[static_cast<std::size_t>(p)];
    };
    while (parent(patch) != patch) {
        parent(patch) = parent(parent(patch));
        patch = parent(patch);
    }
    return patch;
}

void Patches::join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    Patch& first = patches_[static_cast<std::size_t>(a)];
    const Patch& second = patches_[static_cast<std::size_t>(b)];
    parents_[static_cast<std::size_t>(b)] = a;
    first.left = std::min(first.left, second.left);
    first.right = std::max(first.right, second.right);
    first.top = std::min(first.top, second.top);
    first.bottom = std::max(first.bottom, second.bottom);
    first.pixels += second.pixels;
}

}  // namespace dibhr
