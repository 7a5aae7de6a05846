// The measures, each over all frames of a clip.
#include "tests/bench/truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "core/haptics/facet.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/video/cleaning/sparse_meter.hpp"
#include "core/video/cleaning/temporal_filter.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "tests/support/listed_media.hpp"

namespace dibhr::bench {

namespace {

constexpr double kLeastEdge_px = 8.0;  ///< high, or it is no silhouette to speak of
constexpr double kShift_frames = 0.25;
constexpr int kShifts = 8;                   ///< to each side
constexpr float kMuch = 0.3F;                ///< of the quickest pixel's motion
constexpr std::size_t kMovingPixels = 3000;  ///< are enough

/// Steps from a pixel to those around it, nearest first.
struct Away {
    int right, down;
    double px;
};

std::vector<Away> disc() {
    const int reach = static_cast<int>(kFarthestEdge_px);
    std::vector<Away> steps;
    for (int down = -reach; down <= reach; ++down)
        for (int right = -reach; right <= reach; ++right)
            if (const double px = std::hypot(right, down); px < kFarthestEdge_px)
                steps.push_back({right, down, px});
    std::stable_sort(steps.begin(), steps.end(),
                     [](const Away& a, const Away& b) { return a.px < b.px; });
    return steps;
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return Nearness::kNone;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

/// Pixels that move much at some time, not all of many.
std::vector<std::size_t> moving_pixels(const TrueFrames& truth) {
    std::vector<float> changes(truth[0].object.size(), 0.0F);
    for (int frame = 1; frame < truth.count(); ++frame) {
        const std::vector<float>& before = truth[frame - 1].elevation.levels;
        const std::vector<float>& now = truth[frame].elevation.levels;
        for (std::size_t k = 0; k < changes.size(); ++k)
            changes[k] = std::max(changes[k], std::fabs(now[k] - before[k]));
    }
    const float most = *std::max_element(changes.begin(), changes.end());
    std::vector<std::size_t> moving;
    for (std::size_t k = 0; k < changes.size(); ++k)
        if (changes[k] > kMuch * most) moving.push_back(k);
    const std::size_t every = moving.size() / kMovingPixels + 1;
    std::vector<std::size_t> some;
    for (std::size_t k = 0; k < moving.size(); k += every) some.push_back(moving[k]);
    return some;
}

/// Differences in time, each from its own mean: a constant offset is no lag.
class Deviations {
  public:
    void add(double difference) {
        sum_ += difference;
        squares_ += difference * difference;
        count_ += 1.0;
    }
    [[nodiscard]] double squares() const {
        return count_ > 0.0 ? squares_ - sum_ * sum_ / count_ : 0.0;
    }

  private:
    double sum_{0.0}, squares_{0.0}, count_{0.0};
};

std::vector<std::size_t> tops_of_bumps(const KnownScene& scene) {
    std::vector<std::size_t> tops;
    const auto columns = static_cast<std::size_t>(scene.columns);
    for (std::size_t k = 0; scene.bump && k < columns * static_cast<std::size_t>(scene.rows); ++k)
        if (scene.bump(static_cast<double>(k % columns), static_cast<double>(k / columns)) > 0.999)
            tops.push_back(k);
    return tops;
}

std::vector<char> still_pixels(const TrueFrames& truth) {
    std::vector<char> still(truth[0].object.size(), 1);
    for (int frame = 0; frame < truth.count(); ++frame) {
        const TrueFrame& now = truth[frame];
        for (std::size_t k = 0; k < still.size(); ++k)
            if (now.to_silhouette_px[k] < kBeside_px ||
                now.elevation.levels[k] != truth[0].elevation.levels[k])
                still[k] = 0;
    }
    return still;
}

}  // namespace

double NearnessMeter::Squares::root() const {
    return count > 0.0 ? std::sqrt(sum / count) : Nearness::kNone;
}

NearnessMeter::NearnessMeter(const TrueFrames& truth) : truth_(truth), still_(still_pixels(truth)) {
    if (truth.scene().moves) moving_ = moving_pixels(truth);
    tops_ = tops_of_bumps(truth.scene());
    sums_.assign(still_.size(), 0.0);
    squares_.assign(still_.size(), 0.0);
}

void NearnessMeter::add(const DepthImage& depth) {
    now_ = depth;
    const auto px_per_level = static_cast<float>(kRelief_px / depth.highest_level);
    for (float& level : now_.levels) level *= px_per_level;
    now_.highest_level = kRelief_px;
    add_elevations();
    add_normals();
    add_edges();
    keep_moving();
    add_bumps();
    add_flicker();
    ++frame_;
}

void NearnessMeter::add_elevations() {
    const TrueFrame& truth = truth_[frame_];
    for (std::size_t k = 0; k < now_.levels.size(); ++k)
        if (truth.to_silhouette_px[k] >= kBeside_px)
            elevation_.add(static_cast<double>(now_.levels[k] - truth.elevation.levels[k]));
}

void NearnessMeter::add_normals() {
    const TrueFrame& truth = truth_[frame_];
    const DepthSurface surface(now_, now_, 0.0, {.relief_px = kRelief_px});
    const bool on_objects = *std::max_element(truth.object.begin(), truth.object.end()) > 0;
    const auto is_measured = [&](std::size_t k) {
        return truth.to_silhouette_px[k] >= kBeside_px && (truth.object[k] > 0 || !on_objects);
    };
    for (int j = 0; j + 1 < now_.rows; ++j) {
        for (int i = 0; i + 1 < now_.columns; ++i) {
            const std::size_t k = now_.index(i, j);
            const auto below = k + static_cast<std::size_t>(now_.columns);
            if (!is_measured(k) || !is_measured(k + 1) || !is_measured(below)) continue;
            const Facet facet(surface, triangle(TriangleSide::near_origin, i, j));
            normal_.add(kDegPerRad * angle_between_rad(facet.normal(), truth.normal[k]));
        }
    }
}

void NearnessMeter::add_edges() {
    const TrueFrame& truth = truth_[frame_];
    const auto columns = static_cast<std::size_t>(now_.columns);
    for (std::size_t k = 0; k < truth.object.size(); ++k) {
        const bool last = (k + 1) % columns == 0;
        if (!last && truth.object[k] != truth.object[k + 1]) look_for_edge(k, k + 1);
        if (k + columns < truth.object.size() && truth.object[k] != truth.object[k + columns])
            look_for_edge(k, k + columns);
    }
}

/// Between neighbours to the right of each other, or below.
void NearnessMeter::look_for_edge(std::size_t from, std::size_t to) {
    static const std::vector<Away> around = disc();
    const std::vector<float>& truth = truth_[frame_].elevation.levels;
    const float height = truth[to] - truth[from];
    if (static_cast<double>(std::fabs(height)) < kLeastEdge_px) return;
    const auto columns = static_cast<std::size_t>(now_.columns);
    const int i = static_cast<int>(from % columns);
    const int j = static_cast<int>(from / columns);
    const auto is_edge = [&](const Away& away) {
        const int x = i + away.right;
        const int y = j + away.down;
        const int last_x = now_.columns - (to == from + 1 ? 1 : 0);
        const int last_y = now_.rows - (to == from + 1 ? 0 : 1);
        if (x < 0 || y < 0 || x >= last_x || y >= last_y) return false;
        const std::size_t k = now_.index(x, y);
        return (now_.levels[k + to - from] - now_.levels[k]) / height >= 0.5F;
    };
    const auto found = std::find_if(around.begin(), around.end(), is_edge);
    edges_px_.push_back(found == around.end() ? kFarthestEdge_px : found->px);
}

void NearnessMeter::keep_moving() {
    for (const std::size_t k : moving_) of_moving_.push_back(now_.levels[k]);
}

/// Of the moving pixels from the truth so many frames before, where the chain sees to both sides.
double NearnessMeter::squares_from_truth(double late_frames) const {
    const int reach = static_cast<int>(kNearInTime);
    const auto columns = static_cast<std::size_t>(now_.columns);
    double squares = 0.0;
    for (std::size_t n = 0; n < moving_.size(); ++n) {
        const auto i = static_cast<double>(moving_[n] % columns);
        const auto j = static_cast<double>(moving_[n] / columns);
        Deviations deviations;
        for (int frame = reach; frame + reach < frame_; ++frame) {
            const float level = of_moving_[static_cast<std::size_t>(frame) * moving_.size() + n];
            const Seen then = truth_.scene().at(frame - late_frames, i, j);
            deviations.add(static_cast<double>(level) - then.elevation_px);
        }
        squares += deviations.squares();
    }
    return squares;
}

/// Where a parabola through the least squares and those beside them is lowest.
double NearnessMeter::lag_frames() const {
    if (moving_.empty() || frame_ <= 2 * static_cast<int>(kNearInTime)) return Nearness::kNone;
    std::vector<double> squares;
    for (int shift = -kShifts; shift <= kShifts; ++shift)
        squares.push_back(squares_from_truth(kShift_frames * shift));
    const auto least = std::min_element(squares.begin() + 1, squares.end() - 1);
    const double before = *(least - 1);
    const double after = *(least + 1);
    const double bend = before - 2.0 * *least + after;
    const double between = bend > 0.0 ? 0.5 * (before - after) / bend : 0.0;
    const auto shift = static_cast<double>(least - squares.begin()) - kShifts;
    return kShift_frames * (shift + std::clamp(between, -1.0, 1.0));
}

/// At their tops, above the plane.
void NearnessMeter::add_bumps() {
    const KnownScene& scene = truth_.scene();
    const DepthImage& truth = truth_[frame_].elevation;
    for (const std::size_t k : tops_) {
        const auto whole =
            scene.bump(static_cast<double>(k % static_cast<std::size_t>(now_.columns)),
                       static_cast<double>(k / static_cast<std::size_t>(now_.columns)));
        bump_ += static_cast<double>(now_.levels[k] - truth.levels[k]) + whole;
        whole_bump_ += whole;
    }
}

void NearnessMeter::add_flicker() {
    for (std::size_t k = 0; k < still_.size(); ++k) {
        if (still_[k] == 0) continue;
        const auto level = static_cast<double>(now_.levels[k]);
        sums_[k] += level;
        squares_[k] += level * level;
    }
}

double NearnessMeter::flicker_px() const {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < still_.size(); ++k) {
        if (still_[k] == 0) continue;
        const double mean = sums_[k] / frame_;
        sum += std::max(squares_[k] / frame_ - mean * mean, 0.0);
        count += 1.0;
    }
    return count > 0.0 ? std::sqrt(sum / count) : Nearness::kNone;
}

Nearness NearnessMeter::nearness() const {
    return {.elevation_px = elevation_.root(),
            .normal_deg = normal_.root(),
            .edge_px = quantile(edges_px_, 0.95),
            .lag_frames = lag_frames(),
            .bump_kept = whole_bump_ > 0.0 ? bump_ / whole_bump_ : Nearness::kNone,
            .flicker_px = flicker_px()};
}

std::string each_cleaned(const std::vector<DepthImage>& recorded, CleaningPreset preset,
                         const std::function<void(const DepthImage&)>& take,
                         std::vector<ColourImage> colours) {
    const CleaningOptions options{.preset = preset};
    auto media = std::make_unique<test::ListedMedia>(recorded, 1.0 / kRate);
    SparseMeter sparse;
    sparse.add(recorded.front());
    media->set_sparse(sparse.sparse_share());
    media->set_colours(std::move(colours));
    FrameReader reader(std::move(media));
    reader.set_cleaning(options);
    for (auto frame = reader.at(0.0); frame; frame = reader.after(frame->media_s))
        take(*frame->depth);
    return in_words(options, reader.plan());
}

Cleaned cleaned_against(const TrueFrames& truth, const std::vector<DepthImage>& recorded,
                        CleaningPreset preset) {
    NearnessMeter meter(truth);
    std::string words =
        each_cleaned(recorded, preset, [&](const DepthImage& depth) { meter.add(depth); });
    return {meter.nearness(), std::move(words)};
}

}  // namespace dibhr::bench
