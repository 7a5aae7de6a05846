// Finds runs of pixels and joins them row by row (union-find).
#include "core/video/cleaning/patches.hpp"

#include <algorithm>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// Of the highest level: beyond the noise of any sensor, below the thickness of a hand.
constexpr float kOutline = 0.04F;

DIBHR_VECTOR_CLONES int any_hole(const float* levels, std::size_t count) noexcept {
    int any = 0;
    for (std::size_t i = 0; i < count; ++i) any |= levels[i] != levels[i] ? 1 : 0;
    return any;
}

/// Marks data with 1 (`other` 0), or pixels without data (`other` 1). Returns 0 if there is none.
DIBHR_VECTOR_CLONES int mark(const float* levels, int other, std::uint8_t* __restrict marks,
                             std::size_t count) noexcept {
    int any = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const int marked = (levels[i] == levels[i] ? 1 : 0) ^ other;
        marks[i] = static_cast<std::uint8_t>(marked);
        any |= marked;
    }
    return any;
}

}  // namespace

bool has_holes(const float* levels, std::size_t count) noexcept {
    constexpr std::size_t kSome = 4096;
    for (std::size_t at = 0; at < count; at += kSome)
        if (any_hole(levels + at, std::min(kSome, count - at)) != 0) return true;
    return false;
}

bool mark_holes(const float* levels, std::uint8_t* marks, std::size_t count) noexcept {
    return mark(levels, 1, marks, count) != 0;
}

float outline_levels(const DepthImage& image) noexcept {
    return kOutline * static_cast<float>(image.highest_level);
}

void Patches::find(const DepthImage& image, bool with_data) {
    find_runs(image, with_data);
    join_runs();
    for (Run& run : runs_) run.patch = root(run.patch);
}

void Patches::find_runs(const DepthImage& image, bool with_data) {
    const auto columns = static_cast<std::size_t>(image.columns);
    marks_.resize(columns);
    runs_.clear();
    for (int j = 0; j < image.rows; ++j) {
        const float* const row = image.levels.data() + image.index(0, j);
        if (mark(row, with_data ? 0 : 1, marks_.data(), columns) == 0) continue;
        visit_marked(marks_.data(), image.columns, [this, j](int begin, int end) {
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
