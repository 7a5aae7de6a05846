// Models of noise as they were published, with the numbers that recordings have.
#include "tests/bench/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::bench {

namespace {

constexpr double kHighest = 65535.0;
constexpr double kPerStep = 2.85e-6;  ///< of a Kinect's disparity [1/mm]
constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();

/// Normally distributed numbers, and chances.
class Chance {
  public:
    explicit Chance(std::uint32_t seed) : random_(seed) {}
    double normal(double deviation) { return deviation * normal_(random_); }
    double share() { return uniform_(random_); }
    bool one_in(double share_of_times) { return share() < share_of_times; }

  private:
    std::mt19937 random_;
    std::normal_distribution<double> normal_{};
    std::uniform_real_distribution<double> uniform_{};
};

/// A frame that is being seen: elevations [px], NaN is no data.
struct Sight {
    const KnownScene& scene;
    const TrueFrame& truth;
    int frame;
    DepthImage elevation;

    [[nodiscard]] bool is_near_silhouette(std::size_t k, float reach_px) const {
        return truth.to_silhouette_px[k] < reach_px;
    }
};

/// As a file of 16 bits has it.
DepthImage levels_of(const DepthImage& elevation) {
    DepthImage image = elevation;
    image.highest_level = kHighest;
    for (float& level : image.levels) {
        const double in_range = std::clamp(static_cast<double>(level) / kRelief_px, 0.0, 1.0);
        level = std::isnan(level) ? kNoData : static_cast<float>(std::round(in_range * kHighest));
    }
    return image;
}

/// Sees frame after frame as `degrade(sight)` says.
template <typename Degrade>
std::vector<DepthImage> each_frame(const TrueFrames& truth, Degrade&& degrade) {
    std::vector<DepthImage> seen;
    for (int k = 0; k < truth.count(); ++k) {
        Sight sight{truth.scene(), truth[k], k, truth[k].elevation};
        degrade(sight);
        seen.push_back(levels_of(sight.elevation));
    }
    return seen;
}

void add_grain(Sight& sight, double deviation_px, Chance& chance) {
    for (float& level : sight.elevation.levels)
        level += static_cast<float>(chance.normal(deviation_px));
}

std::vector<DepthImage> exact(const TrueFrames& truth, std::uint32_t /*seed*/) {
    return each_frame(truth, [](Sight&) {});
}

std::vector<DepthImage> white(const TrueFrames& truth, std::uint32_t seed) {
    Chance chance(seed);
    return each_frame(truth, [&](Sight& sight) { add_grain(sight, 0.5, chance); });
}

/// Near a silhouette a pixel gets the elevation of another place, a few pixels away.
void shake_silhouettes(Sight& sight, double deviation_px, Chance& chance) {
    constexpr float kReach_px = 4.0F;
    for (int j = 0; j < sight.scene.rows; ++j) {
        for (int i = 0; i < sight.scene.columns; ++i) {
            const std::size_t k = sight.elevation.index(i, j);
            if (!sight.is_near_silhouette(k, kReach_px)) continue;
            const double x = i + chance.normal(deviation_px);
            const double y = j + chance.normal(deviation_px);
            sight.elevation.levels[k] =
                static_cast<float>(sight.scene.at(sight.frame, x, y).elevation_px);
        }
    }
}

/// No data where the second ray of a triangulation, from `base_mm` to the right, does not reach.
void take_shadows(Sight& sight, double base_mm, double focal_px) {
    const double px_mm = base_mm * focal_px * sight.scene.columns / 640.0;
    DepthImage& image = sight.elevation;
    for (int j = 0; j < image.rows; ++j) {
        double leftmost = std::numeric_limits<double>::infinity();
        for (int i = image.columns - 1; i >= 0; --i) {
            const std::size_t k = image.index(i, j);
            const double from_base =
                i - px_mm / distance_mm(static_cast<double>(sight.truth.elevation.levels[k]));
            if (from_base >= leftmost) image.levels[k] = kNoData;
            leftmost = std::min(leftmost, from_base);
        }
    }
}

/// Kinect v1. Along the ray: disparities of whole steps, z = 1 / (2.85e-6/mm d), whose standard
/// deviation is half a step, so 1.425e-6/mm z^2 (K. Khoshelham and S. Oude Elberink, Accuracy and
/// resolution of Kinect depth data, Sensors 12, 2012). Across it: 0.8 px at silhouettes (C. Nguyen,
/// S. Izadi and D. Lovell, Modeling Kinect sensor noise for improved 3D reconstruction and
/// tracking, 3DIMPVT 2012). The projector is 75 mm beside the camera, f = 575 px. Around
/// silhouettes 8 % of the pixels have no data in a frame and some in the next: so many flip in
/// recordings.
std::vector<DepthImage> kinect(const TrueFrames& truth, std::uint32_t seed) {
    const double grain = std::sqrt(0.25 - 1.0 / 12.0);  // rounding to steps adds the rest
    constexpr double kFlips = 0.08;
    constexpr float kFlipsWithin_px = 4.0F;
    Chance chance(seed);
    return each_frame(truth, [&](Sight& sight) {
        shake_silhouettes(sight, 0.8, chance);
        for (std::size_t k = 0; k < sight.elevation.levels.size(); ++k) {
            float& level = sight.elevation.levels[k];
            const double steps = 1.0 / (kPerStep * distance_mm(static_cast<double>(level)));
            const double measured = std::round(steps + chance.normal(grain));
            level = static_cast<float>(elevation_px(1.0 / (kPerStep * measured)));
            if (sight.is_near_silhouette(k, kFlipsWithin_px) && chance.one_in(kFlips))
                level = kNoData;
        }
        take_shadows(sight, 75.0, 575.0);
    });
}

/// Means over a square of so many pixels, where a silhouette is in reach.
void blur_silhouettes(Sight& sight, int side_px) {
    DepthImage& image = sight.elevation;
    const cv::Mat sharp(image.rows, image.columns, CV_32F, image.levels.data());
    cv::Mat blurred;
    cv::blur(sharp, blurred, {side_px, side_px}, {-1, -1}, cv::BORDER_REPLICATE);
    const float reach = 0.5F * static_cast<float>(side_px) * std::numbers::sqrt2_v<float>;
    for (std::size_t k = 0; k < image.levels.size(); ++k)
        if (sight.is_near_silhouette(k, reach))
            image.levels[k] = reinterpret_cast<const float*>(blurred.data)[k];
}

/// Noise of deviation 1 that is alike within `wide_px` (0: grain) and, by the share `stays`, from a
/// frame to the next.
class Blotches {
  public:
    Blotches(const KnownScene& scene, double wide_px, double stays)
        : wide_px_(wide_px), stays_(stays), now_(scene.rows, scene.columns, CV_32F) {}

    const float* next(Chance& chance) {
        cv::Mat fresh(now_.size(), CV_32F);
        std::for_each(fresh.begin<float>(), fresh.end<float>(),
                      [&](float& value) { value = static_cast<float>(chance.normal(1.0)); });
        if (wide_px_ > 0.0) {
            cv::GaussianBlur(fresh, fresh, {0, 0}, wide_px_);
            // What the filter takes of grain.
            fresh *= 2.0 * std::sqrt(std::numbers::pi) * wide_px_;
        }
        if (first_)
            now_ = fresh;
        else
            now_ = stays_ * now_ + std::sqrt(1.0 - stays_ * stays_) * fresh;
        first_ = false;
        return now_.ptr<float>();
    }

  private:
    double wide_px_, stays_;
    cv::Mat now_;
    bool first_{true};
};

/// Stereo as of a RealSense D435: base 50 mm, f = 382 px at 640 columns, and disparities that err
/// by 0.08 px, so z^2 0.08 / (50 382) mm (A. Grunnet-Jepsen, J. Sweetser and J. Woodfill, Tuning
/// depth cameras for best performance, Intel), 4 at 1 m as recordings have. Its windows make errors
/// alike within several pixels and widen silhouettes to ramps: 87 % of the pixels there lie between
/// near and far.
std::vector<DepthImage> stereo(const TrueFrames& truth, std::uint32_t seed) {
    constexpr double kBase_mm = 50.0, kFocal_px = 382.0, kSubpixel = 0.08;
    Chance chance(seed);
    Blotches blotches(truth.scene(), 2.0, 0.5);
    return each_frame(truth, [&](Sight& sight) {
        blur_silhouettes(sight, 3);
        const float* blotch = blotches.next(chance);
        for (std::size_t k = 0; k < sight.elevation.levels.size(); ++k) {
            float& level = sight.elevation.levels[k];
            const double z_mm = distance_mm(static_cast<double>(level));
            const double deviation_mm = z_mm * z_mm * kSubpixel / (kBase_mm * kFocal_px);
            level = static_cast<float>(
                elevation_px(z_mm + deviation_mm * static_cast<double>(blotch[k])));
        }
        take_shadows(sight, kBase_mm, kFocal_px);
    });
}

/// A phone's LiDAR: few points, made an image under guidance of the colour. Smooth but for ramps of
/// 13 px at silhouettes, and 0.03 px of shaking, as recordings have.
std::vector<DepthImage> lidar(const TrueFrames& truth, std::uint32_t seed) {
    Chance chance(seed);
    return each_frame(truth, [&](Sight& sight) {
        blur_silhouettes(sight, 13);
        add_grain(sight, 0.03, chance);
    });
}

/// Time of flight: 1.6 mm of grain (a Kinect v2's median in recordings; an Azure Kinect has about
/// as much: M. Tolgyessy et al., Evaluation of the Azure Kinect and its comparison to Kinect V1 and
/// Kinect V2, Sensors 21, 2021). A quarter of the pixels at silhouettes get light from both sides
/// and fly between them, elsewhere in every frame.
std::vector<DepthImage> time_of_flight(const TrueFrames& truth, std::uint32_t seed) {
    constexpr double kGrain_px = 1.6 * kRelief_px / (kFar_mm - kNear_mm);
    constexpr double kFlying = 0.25;
    Chance chance(seed);
    return each_frame(truth, [&](Sight& sight) {
        const std::vector<float> sharp = sight.elevation.levels;
        const auto columns = static_cast<std::size_t>(sight.scene.columns);
        for (std::size_t k = columns + 1; k + columns + 1 < sharp.size(); ++k) {
            if (!sight.is_near_silhouette(k, 1.0F) || !chance.one_in(kFlying)) continue;
            const auto [low, high] = std::minmax(
                {sharp[k - 1], sharp[k + 1], sharp[k - columns], sharp[k + columns], sharp[k]});
            sight.elevation.levels[k] = std::lerp(low, high, static_cast<float>(chance.share()));
        }
        add_grain(sight, kGrain_px, chance);
    });
}

/// A level a pixel of relief.
DepthImage in_eight_bits(const DepthImage& elevation) {
    DepthImage image = elevation;
    for (float& level : image.levels) level = std::round(std::clamp(level, 0.0F, 255.0F));
    return image;
}

std::vector<DepthImage> eight_bit(const TrueFrames& truth, std::uint32_t /*seed*/) {
    std::vector<DepthImage> seen;
    for (int k = 0; k < truth.count(); ++k) seen.push_back(in_eight_bits(truth[k].elevation));
    return seen;
}

void write_grey(const std::vector<DepthImage>& frames, const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary);
    for (const DepthImage& frame : frames) {
        std::string bytes;
        for (const float level : frame.levels)
            bytes.push_back(static_cast<char>(static_cast<std::uint8_t>(level)));
        out << bytes;
    }
}

/// A video of 8 bits as most programs write it: 4:2:0, levels 16 to 235, the encoder's own quality
/// (CRF 23); coded by the encoder itself and read by the program's own reader.
std::vector<DepthImage> h264(const TrueFrames& truth, std::uint32_t seed) {
    const test::TemporaryFolder folder;
    write_grey(eight_bit(truth, seed), folder / "levels");
    const KnownScene& scene = truth.scene();
    test::ffmpeg("-f rawvideo -pix_fmt gray -r 30 -s " + std::to_string(scene.columns) + "x" +
                 std::to_string(scene.rows) + " -i '" + (folder / "levels").string() +
                 "' -c:v libx264 -crf 23 -pix_fmt yuv420p '" + (folder / "depth.mp4").string() +
                 "'");
    const std::unique_ptr<Media> media = open_depth(folder / "depth.mp4");
    std::vector<DepthImage> seen;
    while (std::optional<RawFrame> frame = media->next()) seen.push_back(std::move(frame->depth));
    if (seen.size() != static_cast<std::size_t>(truth.count()))
        throw std::runtime_error("the coded video holds another number of frames");
    return seen;
}

/// An estimator from single pictures: right but for a scale and a shift of its own in every frame,
/// 1.5 % of the range each (as affine-invariant ones have: R. Ranftl et al., Towards robust
/// monocular depth estimation, TPAMI 2022).
std::vector<DepthImage> monocular(const TrueFrames& truth, std::uint32_t seed) {
    constexpr double kDeviation = 0.015;
    Chance chance(seed);
    return each_frame(truth, [&](Sight& sight) {
        const auto gain = static_cast<float>(1.0 + chance.normal(kDeviation));
        const auto shift = static_cast<float>(kRelief_px * chance.normal(kDeviation));
        for (float& level : sight.elevation.levels) level = gain * level + shift;
    });
}

/// Noise in millimetres or, for a Kinect v1, in whole steps of disparity (see kinect()), new in
/// every frame.
struct Noise {
    std::string name{};
    double deviation{0.0};  ///< [mm] or [steps]
    double wide_px{0.0};    ///< alike within
    bool in_steps{false};
    double standing{0.0};  ///< [mm], the same in every frame
};
constexpr double kLidar_mm = 0.4, kLidarWide_px = 2.0;

std::vector<DepthImage> noisy(const TrueFrames& truth, std::uint32_t seed, const Noise& noise) {
    Chance chance(seed);
    Blotches blotches(truth.scene(), noise.wide_px, 0.0);
    Blotches standing(truth.scene(), noise.wide_px, 1.0);
    return each_frame(truth, [&](Sight& sight) {
        const float* blotch = blotches.next(chance);
        const float* stays = noise.standing > 0.0 ? standing.next(chance) : nullptr;
        for (std::size_t k = 0; k < sight.elevation.levels.size(); ++k) {
            float& level = sight.elevation.levels[k];
            const double off = noise.deviation * static_cast<double>(blotch[k]);
            const double standing_mm =
                stays != nullptr ? noise.standing * static_cast<double>(stays[k]) : 0.0;
            const double z_mm = distance_mm(static_cast<double>(level)) + standing_mm;
            const double seen_mm =
                noise.in_steps ? 1.0 / (kPerStep * std::round(1.0 / (kPerStep * z_mm) + off))
                               : z_mm + off;
            level = static_cast<float>(elevation_px(std::round(seen_mm)));
        }
    });
}

Sensor sensor_of(const Noise& noise) {
    return {noise.name, [noise](const TrueFrames& truth, std::uint32_t seed) {
                return noisy(truth, seed, noise);
            }};
}

/// One pixel in 20 is seen, exactly, another one in every frame.
std::vector<DepthImage> sparse(const TrueFrames& truth, std::uint32_t seed) {
    Chance chance(seed);
    return each_frame(truth, [&](Sight& sight) {
        for (float& level : sight.elevation.levels)
            if (!chance.one_in(0.05)) level = kNoData;
    });
}

}  // namespace

std::vector<Sensor> sensors() {
    return {{"exact", exact},    {"white", white},        {"kinect", kinect},   {"stereo", stereo},
            {"lidar", lidar},    {"tof", time_of_flight}, {"8-bit", eight_bit}, {"h264", h264},
            {"mono", monocular}, {"sparse", sparse}};
}

std::vector<Sensor> noises() {
    std::vector<Sensor> all;
    for (const Noise& noise : {Noise{"time of flight", 1.6, 0.0},
                               {"LiDAR", kLidar_mm, kLidarWide_px},
                               {"Kinect v1", 0.5, 1.2, true},
                               {"stereo", 2.5, 2.5}})
        all.push_back(sensor_of(noise));
    return all;
}

Sensor standing_noise() {
    return sensor_of({"standing", kLidar_mm, kLidarWide_px, false, 1.0});
}

Sensor sensor(const std::string& name) {
    for (Sensor& each : sensors())
        if (each.name == name) return each;
    throw std::invalid_argument("no sensor is called " + name);
}

}  // namespace dibhr::bench
