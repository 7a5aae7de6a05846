#include "core/video/cleaning/fingertip/image_dilation.hpp"

#include <algorithm>
#include <cstring>
#include <future>

namespace dibhr::fingertip {

namespace {

constexpr int kLarge_px = 300'000;  ///< fewer pixels are dilated in the time of a thread's start

/// Copies the image over the one before, and returns where they differed.
Tiles replace(PaddedImage& before, const DepthImage& image) {
    Tiles changed(image.columns, image.rows);
    const auto bytes = [](int columns) {
        return static_cast<std::size_t>(columns) * sizeof(float);
    };
    for (int row = 0; row < image.rows; ++row) {
        float* const old = before.pixel(0, row);
        const float* const now = image.levels.data() + image.index(0, row);
        if (std::memcmp(old, now, bytes(image.columns)) == 0) continue;
        for (int left = 0; left < image.columns; left += Tiles::kSide_px) {
            const int right = std::min(left + Tiles::kSide_px, image.columns);
            if (std::memcmp(old + left, now + left, bytes(right - left)) != 0)
                changed.mark({left, right, row, row + 1});
        }
        std::copy_n(now, image.columns, old);
    }
    return changed;
}

}  // namespace

void ImageDilation::take(const DepthImage& image, const Fingertip& by) {
    const bool is_next = image_.columns == image.columns && image_.rows == image.rows &&
                         finger_ == by && highest_level_ == image.highest_level;
    has_squares_ = false;
    if (is_next) {
        Tiles changed = replace(image_.levels, image);
        changed.widen(image_.reach() + 1);
        dilated_.unmark(changed);
        return;
    }
    image_.columns = image.columns;
    image_.rows = image.rows;
    finger_ = by;
    highest_level_ = image.highest_level;
    image_.ball = Ball(by, highest_level_);
    image_.levels.fit(image.columns, image.rows, image_.reach() + kPadding_px, kNothing);
    image_.levels.copy(image);
    felt_.resize(image.levels.size());
    dilated_ = Tiles(image.columns, image.rows);
}

void ImageDilation::dilate_all() {
    Tiles all(image_.columns, image_.rows);
    all.mark_all();
    dilate(all);
}

/// Another thread dilates the lower half of many tiles.
void ImageDilation::dilate(const Tiles& wanted) {
    Tiles missing = wanted;
    missing.unmark(dilated_);
    const int count = missing.count();
    if (count == 0) return;
    if (!has_squares_) image_.squares.find(image_.levels, image_.columns, image_.rows, image_.ball);
    has_squares_ = true;
    const int middle = missing.middle_row();
    const bool large = count * Tiles::kSide_px * Tiles::kSide_px >= kLarge_px &&
                       image_.rows >= 4 * image_.ball.radius_px;
    std::future<void> lower;
    if (large && middle > 0)
        lower = std::async(std::launch::async,
                           [&] { dilate_rows(workers_[1], missing, middle, image_.rows); });
    dilate_rows(workers_[0], missing, 0, lower.valid() ? middle : image_.rows);
    if (lower.valid()) lower.get();
    dilated_.mark(missing);
}

void ImageDilation::dilate_rows(AreaDilation& worker, const Tiles& wanted, int top, int bottom) {
    worker.dilate(image_, wanted, top, bottom);
    for (int row = top; row < bottom; ++row)
        wanted.each_run(row, [&](int left, int right) {
            std::copy_n(worker.felt(left, row), right - left,
                        felt_.data() + std::ptrdiff_t{row} * image_.columns + left);
        });
}

}  // namespace dibhr::fingertip
