// Makes the surfaces, and the goals over them.
#include "core/experiment/grounds.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <utility>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

namespace {

constexpr int kLargeColumns = 7680;
constexpr int kLargeRows = 4320;
constexpr double kHighest8Bit = 255.0;
constexpr double kHighest16Bit = 65535.0;
constexpr float kFlat8Bit = 100.0F;
constexpr int kFlat16Bit = 25700;  // 100 of 255
constexpr double kFlat_px = 100.0;
constexpr unsigned kSeed = 5;  // for std::mt19937's standardized bits: the same image everywhere

/// Between two rows of VERTEXes: along a row all algorithms need less time than on a hand's path.
constexpr double kOffRow_px = 0.37;

using GoalAt = Vec3 (*)(const PathPlace&, int) noexcept;

DepthImage flat_image(int columns, int rows) {
    return image_of(columns, rows, kHighest8Bit, [](int, int) { return kFlat8Bit; });
}

/// Two equal images, each in its own memory, a video frame apart.
DepthClip still(DepthImage image, const SurfaceShape& shape = {},
                std::shared_ptr<const BumpMap> bump = nullptr) {
    constexpr double kFrame_s = 1.0 / 30.0;
    std::vector<Frame> frames(2);
    frames[0].depth = std::make_shared<const DepthImage>(image);
    frames[1].depth = std::make_shared<const DepthImage>(std::move(image));
    frames[1].time_s = kFrame_s;
    return {std::move(frames), shape, std::move(bump)};
}

/// The middle of a row: of VERTEXes, or `off_row_px` beside it.
PathPlace middle_of(const DepthClip& clip, double off_row_px) {
    return {0.5 * clip.columns(), 0.5 * clip.rows() + off_row_px, 0.0, kExperimentDepth_px};
}

PathRun path_over(const DepthClip& clip, const char* name, GoalAt goal_at, const PathPlace& place) {
    PathRun path;
    path.name = name;
    path.source = "the paper's path, 20 px below the surface of the moment";
    path.goals.reserve(kExperimentUpdates);
    for (int k = 0; k < kExperimentUpdates; ++k) {
        Vec3 goal = goal_at(place, k);
        const DepthSurface now = clip.at(seconds_of(static_cast<std::size_t>(k)));
        goal.z += now.elevation_at(goal.x, goal.y);
        path.goals.push_back(goal);
    }
    survey_path(path, clip);
    return path;
}

Ground ground_of(const char* name, DepthClip clip, double off_row_px = kOffRow_px) {
    Ground ground{name, std::move(clip)};
    const PathPlace place = middle_of(ground.clip, off_row_px);
    ground.paths.push_back(path_over(ground.clip, "linear", &linear_goal, place));
    ground.paths.push_back(path_over(ground.clip, "circle", &circle_goal, place));
    return ground;
}

Ground bit_flat() {
    return ground_of("bit-flat", still(flat_image(kPaperColumns, kPaperRows)), 0.0);
}

/// From corner to corner, along the surface and just above it.
Ground large_bit_flat() {
    Ground ground = ground_of("bit-flat", still(flat_image(kLargeColumns, kLargeRows)), 0.0);
    for (const auto& [name, z] :
         {std::pair{"contact", kFlat_px - kExperimentDepth_px}, std::pair{"air", kFlat_px + 1.0}}) {
        ground.jumps.push_back({name, {5.3, 4.2, z}, {kLargeColumns - 7.1, kLargeRows - 6.4, z}});
    }
    return ground;
}

Ground near_flat() {
    std::mt19937 bits(kSeed);
    const auto level = [&bits](int, int) { return kFlat16Bit - 1 + static_cast<int>(bits() % 3); };
    return ground_of("near-flat", still(image_of(kPaperColumns, kPaperRows, kHighest16Bit, level)));
}

Ground bumpy() {
    const auto level = [](int i, int j) {
        return std::round(257.0 * (100.0 + 3.0 * std::sin(0.35 * i) * std::sin(0.27 * j) +
                                   2.0 * std::sin(0.11 * i + 0.07 * j)));
    };
    return ground_of("bumpy", still(image_of(kPaperColumns, kPaperRows, kHighest16Bit, level)));
}

Ground bump_mapped() {
    constexpr double kRoughness_px = 2.0;
    std::mt19937 bits(kSeed);
    BumpMap bump{kPaperColumns, kPaperRows, {}};
    bump.heights.resize(static_cast<std::size_t>(bump.columns) *
                        static_cast<std::size_t>(bump.rows));
    for (float& height : bump.heights) {
        height = static_cast<float>(bits() % 256) / static_cast<float>(kHighest8Bit);
    }
    stretch(bump, kPaperColumns, kPaperRows);
    return ground_of("bump map", still(flat_image(kPaperColumns, kPaperRows),
                                       {SurfaceShape{}.relief_px, kRoughness_px},
                                       std::make_shared<const BumpMap>(std::move(bump))));
}

Ground crease() {
    Ground ground{"crease", still(image_of(kLargeColumns, kLargeRows, kHighest16Bit,
                                           [](int, int j) { return kFlat16Bit + j % 2; }))};
    const PathPlace place = middle_of(ground.clip, 0.0);  // an even row: a low one
    ground.paths.push_back(path_over(ground.clip, "linear", &linear_goal, place));
    const double z = kFlat_px - kExperimentDepth_px;
    ground.jumps.push_back(
        {"crease", {5.3, place.centre_y, z}, {kLargeColumns - 7.1, place.centre_y, z}});
    return ground;
}

constexpr std::array<MakeGround, 6> kMakers{&bit_flat, &large_bit_flat, &near_flat,
                                            &bumpy,    &bump_mapped,    &crease};

}  // namespace

std::span<const MakeGround> made_grounds() noexcept {
    return kMakers;
}

Ground video_ground(const std::string& name, DepthClip clip) {
    return ground_of(name.c_str(), std::move(clip));
}

PathRun slanted_path(const DepthClip& plane, double step_px) {
    constexpr double kAngle_rad = 0.4;
    constexpr double kHalf_px = 200.0;
    PathRun path;
    path.name = "slanted";
    const PathPlace middle = middle_of(plane, kOffRow_px);
    for (int k = 0; k < kExperimentUpdates; ++k) {
        const double travelled = std::fmod(k * step_px, 4.0 * kHalf_px);
        const double along = std::abs(travelled - 2.0 * kHalf_px) - kHalf_px;
        const double x = middle.centre_x + along * std::cos(kAngle_rad);
        const double y = middle.centre_y + along * std::sin(kAngle_rad);
        path.goals.push_back({x, y, plane.at(0.0).elevation_at(x, y) - kExperimentDepth_px});
    }
    survey_path(path, plane);
    return path;
}

}  // namespace dibhr
