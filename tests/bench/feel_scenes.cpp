// Sees each scene, cleans it as the program does, and prints a row.
#include "tests/bench/feel_scenes.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/video/cleaning/single_frame_depth.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "tests/bench/blemishes.hpp"
#include "tests/bench/carried.hpp"
#include "tests/bench/detail.hpp"
#include "tests/bench/sensors.hpp"
#include "tests/bench/truth.hpp"

namespace dibhr::bench {

namespace {

constexpr std::uint32_t kSeed = 1;
constexpr std::size_t kSettled = 30;          ///< frames before the first that is measured
constexpr std::size_t kMeasured = 6;          ///< frames
constexpr std::size_t kAfter = kReachInTime;  ///< frames that cleaning looks ahead
constexpr std::size_t kMeanOf = 11;           ///< frames, the yardstick

struct Frames {
    std::vector<DepthImage> depth{};
    std::string words{};  ///< what was done
};

Frames cleaned(const std::vector<DepthImage>& recorded, const std::string& cleaning,
               std::vector<ColourImage> colours = {}) {
    Frames frames;
    frames.words = each_cleaned(
        recorded, named<CleaningPreset>(cleaning).value(),
        [&](const DepthImage& depth) { frames.depth.push_back(depth); }, std::move(colours));
    return frames;
}

Detail detail_of(const std::vector<DepthImage>& frames, const CameraPath& path) {
    DetailMeter meter(path);
    for (std::size_t k = kSettled; k < kSettled + kMeasured; ++k)
        meter.add(static_cast<int>(k), frames[k], frames[k + 1]);
    return meter.detail();
}

/// Of a camera that stands still: each frame is the mean of those up to it.
Detail detail_of_means(const std::vector<DepthImage>& recorded) {
    std::vector<DepthImage> means(kSettled);
    for (std::size_t k = kSettled; k <= kSettled + kMeasured; ++k)
        means.push_back(mean_of(recorded, k + 1 - kMeanOf, kMeanOf));
    return detail_of(means, {});
}

void print_detail(const std::string& noise, const char* camera, const std::string& cleaning,
                  const Detail& detail, const Detail& yardstick) {
    std::printf("| %s | %s | %s |", noise.c_str(), camera, cleaning.c_str());
    for (std::size_t k = 0; k < kRidges.size(); ++k)
        std::printf(" %.0f |", 100.0 * detail.ridges[k] / yardstick.ridges[k]);
    // The flat panel is not in its rows where a step is not measured.
    if (std::isnan(detail.step))
        std::printf(" | %.2f | |\n", detail.noise_mm);
    else
        std::printf(" %.0f | %.2f | %.2f (%.2f) |\n", 100.0 * detail.step, detail.noise_mm,
                    detail.flat.pimples, detail.flat.pimples_again);
    std::fflush(stdout);
}

void print_details(const std::vector<std::string>& cleanings) {
    std::printf(
        "Detail at 1 m, %zu frames in: share of the amplitude of ridges, of what a mean of %zu "
        "frames keeps [%%] (its own: of the truth); of a step within 4 px [%%]; noise left [mm]; "
        "pimples per 1000 px of a flat panel (there again in the next frame)\n\n",
        kSettled, kMeanOf);
    std::printf("| noise | camera | cleaning |");
    for (const Ridges& ridges : kRidges)
        std::printf(" +-%.0f mm, %.0f mm |", ridges.amplitude_mm, ridges.period_px / 0.525);
    std::printf(" step of %.0f mm | noise | pimples |\n|---|---|---|", kStep_mm);
    for (std::size_t k = 0; k < kRidges.size() + 3; ++k) std::printf("---|");
    std::printf("\n");
    Detail truth;
    truth.ridges.fill(1.0);
    struct Camera {
        const char* name;
        CameraPath path;
    };
    constexpr double kDegree = std::numbers::pi / 180.0;
    constexpr std::array kCameras{Camera{"still", {}},
                                  Camera{"50 px/s", {.right_px = 50.0 / kRate}},
                                  Camera{"rolls 10 deg/s", {.roll = 10.0 * kDegree / kRate}},
                                  Camera{"nears 0.2 m/s", {.nearer_mm = 200.0 / kRate}}};
    constexpr auto kFrames = static_cast<int>(kSettled + kMeasured + kAfter);
    for (const Sensor& noise : noises()) {
        Detail yardstick;
        for (const auto& [camera, path] : kCameras) {
            const std::vector<DepthImage> recorded =
                noise.see(TrueFrames(detail_scene(path), kFrames), kSeed);
            const std::vector<ColourImage> colours = detail_colours(path, kFrames, kSeed);
            if (!path.moves()) {
                yardstick = detail_of_means(recorded);
                print_detail(noise.name, camera, "mean of 11", yardstick, truth);
            }
            for (const std::string& cleaning : cleanings)
                print_detail(noise.name, camera, cleaning,
                             detail_of(cleaned(recorded, cleaning, colours).depth, path),
                             yardstick);
        }
    }
}

void print_outlines(const std::vector<std::string>& cleanings) {
    std::printf(
        "\nOutlines and ground: teeth per 100,000 px; pimples per 1000 px of flat ground (there "
        "again in the next frame), and how much of the picture that is\n\n"
        "| scene | seen by | cleaning | teeth | pimples | flat [%%] | done |\n"
        "|---|---|---|---|---|---|---|\n");
    constexpr int kFrames = 20;
    constexpr std::size_t kFirst = 8, kEnd = 14;
    for (const char* scene : {"face", "hand"}) {
        const TrueFrames truth(known_scene(scene, 320, 240), kFrames);
        for (const Sensor& by : {sensor("tof"), sensor("lidar"), sensor("kinect"), sensor("stereo"),
                                 standing_noise()}) {
            const std::vector<DepthImage> recorded = by.see(truth, kSeed);
            for (const std::string& cleaning : cleanings) {
                const Frames frames = cleaned(recorded, cleaning);
                BlemishMeter meter;
                for (std::size_t k = kFirst; k < kEnd; ++k)
                    meter.add(frames.depth[k], frames.depth[k + 1]);
                const Blemishes found = meter.blemishes();
                std::printf("| %s | %s | %s | %.1f | %.2f (%.2f) | %.0f | %s |\n", scene,
                            by.name.c_str(), cleaning.c_str(), found.teeth, found.pimples,
                            found.pimples_again, 100.0 * found.flat, frames.words.c_str());
                std::fflush(stdout);
            }
        }
    }
}

void print_discs() {
    using test::MovingScene;
    using Look = MovingScene::Look;
    constexpr std::array kTimes_s{0.25, 1.0};
    std::printf(
        "\nDiscs that move before a textured wall: how far fingers are from their material points, "
        "median (worst) [px]\n\n"
        "| disc | diameter [px] | px/s | exposure | after 0.25 s | after 1 s | fingers |\n"
        "|---|---|---|---|---|---|---|\n");
    const auto row = [&](Look look, const char* name, double diameter_px, double exposure) {
        for (const double px_per_s : {60.0, 150.0}) {
            const MovingScene scene({.shape = MovingScene::Shape::disc,
                                     .speed_px_per_s = px_per_s,
                                     .columns = 480,
                                     .rows = 270,
                                     .look = look,
                                     .diameter_px = diameter_px});
            const std::vector<Astray> after = astray_after(scene, {.exposure = exposure}, kTimes_s);
            std::printf("| %s | %.0f | %.0f | %s |", name, diameter_px, px_per_s,
                        exposure > 0.0 ? "+-25 %, 2 Hz" : "even");
            for (const Astray& astray : after)
                std::printf(" %.1f (%.1f) |", astray.median_px, astray.worst_px);
            std::printf(" %d |\n", after.back().fingers);
            std::fflush(stdout);
        }
    };
    constexpr std::array kLooks{std::pair{Look::plain, "plain"}, std::pair{Look::shaded, "shaded"},
                                std::pair{Look::textured, "textured"}};
    for (const auto& [look, name] : kLooks) {
        for (const double diameter_px : {30.0, 60.0, 120.0})
            if (look != Look::textured || diameter_px == 120.0) row(look, name, diameter_px, 0.0);
        row(look, name, 120.0, 0.25);
    }
}

}  // namespace

std::vector<std::string> feel_scenes() {
    return {"detail", "outlines", "discs"};
}

void print_feel_scenes(const std::vector<std::string>& scenes,
                       const std::vector<std::string>& cleanings) {
    for (const std::string& scene : scenes) {
        if (scene == "detail") print_details(cleanings);
        if (scene == "outlines") print_outlines(cleanings);
        if (scene == "discs") print_discs();
    }
}

}  // namespace dibhr::bench
