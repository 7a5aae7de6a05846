// Still surfaces are steadied; moving ones are neither delayed nor smeared.
#include "core/video/cleaning/temporal_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/video/cleaning/camera/camera_motion.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/noisy_scene.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr DepthNoise kQuiet{.constant = 0.2F / 255.0F};
constexpr DepthNoise kNoisy{.constant = 1.0F / 255.0F};

std::vector<SingleFrameDepth> single_frames(const std::vector<DepthImage>& frames) {
    std::vector<SingleFrameDepth> made;
    for (const DepthImage& frame : frames) made.push_back({frame, {}, {}});
    return made;
}

DepthImage filtered(const std::vector<SingleFrameDepth>& frames, std::size_t now,
                    const DepthNoise& noise) {
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& frame : frames) all.push_back(&frame);
    return TemporalFilter().filtered(all, now, noise);
}

double wall(int /*frame*/, int i, int j) {
    return 60.0 + 0.2 * i + 0.1 * j;
}

/// Ridges of one level and steps of two before a camera that moves so many pixels a frame, to the
/// right and half as far down.
Scene relief(double px_per_frame) {
    return [px_per_frame](int frame, int i, int j) {
        const double x = i + px_per_frame * frame;
        const double y = j + 0.5 * px_per_frame * frame;
        const double ridges = std::fmod(y + 4000.0, 80.0) < 40.0 ? std::sin(x) : 0.0;
        const double steps = std::fmod(x + y + 4000.0, 50.0) < 25.0 ? 2.0 : 0.0;
        return 120.0 + 0.1 * x + ridges + steps;
    };
}

/// A hand of 60 by 70 pixels with three fingers of 12 that moves so many pixels a frame to the
/// right.
Scene hand(double px_per_frame) {
    return [px_per_frame](int frame, int i, int j) {
        const double x = i - 20.0 - px_per_frame * frame;
        const bool palm = x >= 0.0 && x < 60.0 && j >= 60 && j < 100;
        const bool finger = x >= 0.0 && x < 60.0 && j >= 30 && j < 60 && std::fmod(x, 24.0) < 12.0;
        return palm || finger ? 180.0 : 60.0;
    };
}

}  // namespace

TEST_CASE("a still surface shimmers at most half as much", "[temporal]") {
    const NoisyScene scene{wall, [](double) { return 1.0; }};
    const auto frames = single_frames(scene.frames(15));
    CHECK(rms_error(filtered(frames, 7, kNoisy), scene.truth(7)) < 0.45);
    CHECK(rms_error(filtered(frames, 7, kNoisy), filtered(frames, 8, kNoisy)) < 0.25);
}

TEST_CASE("a still surface is the mean of what 27 frames tell, and how many and how noisy is known",
          "[temporal]") {
    const NoisyScene scene{wall, [](double) { return 1.0; }, 320, 240};
    const auto frames = single_frames(scene.frames(41));
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& frame : frames) all.push_back(&frame);
    TemporalFilter filter;
    CHECK(rms_error(filter.filtered(all, 20, kNoisy), scene.truth(20)) < 0.22);
    const TimeEvidence& evidence = filter.evidence();
    double weight = 0.0;
    for (const float each : evidence.weights) weight += static_cast<double>(each);
    CHECK(weight / static_cast<double>(evidence.weights.size()) > 25.0);
    REQUIRE(evidence.variances.size() == std::size_t{40} * 30);
    for (const float variance : evidence.variances) REQUIRE_THAT(variance, WithinAbs(1.0, 0.35));
}

TEST_CASE("what moves slowly is not smeared over the frames that are farther", "[temporal]") {
    const Scene moving = [](int frame, int i, int j) {
        return wall(0, i, j) + 3.0 * std::sin(0.5 * (i - 0.3 * frame));
    };
    const NoisyScene scene{moving, [](double) { return 0.0; }};
    const auto frames = single_frames(scene.frames(41));
    CHECK(rms_error(filtered(frames, 20, kNoisy), scene.truth(20)) < 0.35);
}

TEST_CASE("small shapes stay before a moving camera, and noise goes", "[temporal]") {
    const double px = GENERATE(0.0, 0.7, -1.6, 2.5);
    CAPTURE(px);
    const NoisyScene scene{relief(px), [](double) { return 1.0; }, 320, 240};
    const auto frames = single_frames(scene.frames(41));
    CHECK(rms_error(filtered(frames, 20, kNoisy), scene.truth(20), 32) < (px == 0.0 ? 0.24 : 0.42));
}

TEST_CASE("what stands still before a picture that moves is not smeared", "[temporal]") {
    const Scene both = [](int frame, int i, int j) {
        return j < 160 ? relief(1.7)(frame, i, j) : relief(0.0)(0, i, j) + 20.0;
    };
    const NoisyScene scene{both, [](double) { return 1.0; }, 320, 240};
    const auto frames = single_frames(scene.frames(41));
    CHECK(rms_error(filtered(frames, 20, kNoisy), scene.truth(20), 32) < 0.55);
}

TEST_CASE("a hand before a moving camera keeps its outline", "[temporal]") {
    const double px = GENERATE(-5.0, 1.0, 9.0);
    CAPTURE(px);
    const Scene both = [px](int frame, int i, int j) {
        const double level = hand(px)(frame, i - 100, j - 60);
        return level > 100.0 ? level + 40.0 : relief(1.7)(frame, i, j) - 60.0;
    };
    const NoisyScene scene{both, [](double) { return 0.2; }, 400, 240};
    const DepthImage truth = scene.truth(20);
    const DepthImage done = filtered(single_frames(scene.frames(41)), 20, kQuiet);
    const auto wrong =
        std::count_if(truth.levels.begin(), truth.levels.end(), [&](const float& level) {
            const auto k = static_cast<std::size_t>(&level - truth.levels.data());
            return std::fabs(done.levels[k] - level) > 10.0F;
        });
    CHECK(wrong < 40);  // of 3900 pixels of the hand
    CHECK(rms_error(done, truth, 32) < 4.0);
}

TEST_CASE("a camera's motion is exact where the noise hides what moves", "[temporal]") {
    const double px = GENERATE(0.4, -1.6, 2.5);
    CAPTURE(px);
    const NoisyScene scene{relief(px), [](double) { return 2.0; }, 320, 240};
    const auto frames = single_frames(scene.frames(33));
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& frame : frames) all.push_back(&frame);
    CameraMotion camera;
    const auto ways = camera.ways(all, 16, {.constant = 2.0F / 255.0F});
    REQUIRE(ways.size() == all.size());
    for (const std::size_t k : {6U, 11U, 21U, 26U}) {
        const double frames_later = static_cast<double>(k) - 16.0;
        CHECK_THAT(static_cast<double>(ways[k].right) / frames_later, WithinAbs(-px, 0.05));
        CHECK_THAT(static_cast<double>(ways[k].down) / frames_later, WithinAbs(-0.5 * px, 0.05));
    }
}

TEST_CASE("a camera that stands still has no motion", "[temporal]") {
    const Scene of = GENERATE(Scene(wall), relief(0.0));
    const NoisyScene scene{of, [](double) { return 1.0; }, 320, 240};
    const auto frames = single_frames(scene.frames(33));
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& frame : frames) all.push_back(&frame);
    CHECK(CameraMotion{}.ways(all, 16, kNoisy).empty());
}

TEST_CASE("a hand that passes before a still camera does not move what is behind it",
          "[temporal]") {
    const double px = GENERATE(1.0, 3.0);
    CAPTURE(px);
    const auto with_hand = [](double px_per_frame) {
        return [px_per_frame](int frame, int i, int j) {
            const double level = hand(px_per_frame)(frame, i - 40, j - 60);
            return level > 100.0 ? level + 40.0 : relief(0.0)(0, i, j) - 60.0;
        };
    };
    const auto done = [&](double px_per_frame) {
        const NoisyScene scene{with_hand(px_per_frame), [](double) { return 1.0; }, 400, 240};
        return filtered(single_frames(scene.frames(33)), 16, kNoisy);
    };
    const DepthImage passed = done(px);
    const DepthImage still = done(0.0);
    for (int j = 176; j < 240; ++j)
        for (int i = 0; i < 400; ++i) REQUIRE(passed.at(i, j) == still.at(i, j));
}

TEST_CASE("groups of frames are the same whichever frames are given before them", "[temporal]") {
    const Scene of = GENERATE(Scene(wall), relief(1.6));
    const NoisyScene scene{of, [](double) { return 1.0; }};
    auto frames = single_frames(scene.frames(45));
    for (std::size_t k = 0; k < frames.size(); ++k) {
        frames[k].number = static_cast<std::int64_t>(k);
        frames[k].id = k + 1;
    }
    const auto part = [&](std::size_t first, std::size_t now) {
        return std::vector<SingleFrameDepth>(
            frames.begin() + static_cast<std::ptrdiff_t>(first),
            frames.begin() + static_cast<std::ptrdiff_t>(now + 17));
    };
    const DepthImage alone = filtered(part(8, 25), 17, kNoisy);
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& frame : frames) all.push_back(&frame);
    TemporalFilter played;
    for (std::size_t now = 16; now < 25; ++now) (void)played.filtered(all, now, kNoisy);
    CHECK(played.filtered(all, 25, kNoisy).levels == alone.levels);
}

TEST_CASE("at the ends of a clip less is known, and nothing is made up", "[temporal]") {
    const NoisyScene scene{wall, [](double) { return 1.0; }};
    const auto frames = single_frames(scene.frames(15));
    for (const std::size_t k : {0U, 1U, 13U, 14U})
        CHECK(rms_error(filtered(frames, k, kNoisy), scene.truth(static_cast<int>(k))) < 0.65);
    CHECK(filtered(single_frames(scene.frames(1)), 0, kNoisy).levels == scene.frames(1)[0].levels);
}

TEST_CASE("a surface that moves evenly, as a chest does, is not late", "[temporal]") {
    const double step = GENERATE(0.05, 0.3, 2.0, -4.0);  // levels a frame
    const Scene moving = [step](int frame, int i, int j) { return wall(0, i, j) + step * frame; };
    const NoisyScene scene{moving, [](double) { return 0.0; }};
    const auto frames = single_frames(scene.frames(15));
    for (const int k : {2, 7, 12}) {
        const DepthImage done = filtered(frames, static_cast<std::size_t>(k), kNoisy);
        const double late =
            static_cast<double>(scene.truth(k).at(80, 60)) - static_cast<double>(done.at(80, 60));
        CHECK(std::fabs(late / step) <
              (k == 7 ? 0.1 : 1.6));  // of a frame; at the ends less is known
    }
}

TEST_CASE("a hand in motion keeps its outline, fingers and all", "[temporal]") {
    const double px = GENERATE(1.0, 5.0, 9.0, 17.0);  // 17 are 1 m/s at 1 m and 30 frames/s
    CAPTURE(px);
    const NoisyScene scene{hand(px), [](double) { return 0.2; }, 400, 120};
    const DepthImage truth = scene.truth(9);
    const DepthImage done = filtered(single_frames(scene.frames(20)), 9, kQuiet);
    const auto wrong =
        std::count_if(truth.levels.begin(), truth.levels.end(), [&](const float& level) {
            const auto k = static_cast<std::size_t>(&level - truth.levels.data());
            return std::fabs(done.levels[k] - level) > 10.0F;
        });
    CHECK(wrong < 30);  // of 3900 pixels of the hand
}

TEST_CASE("a round finger that crosses a pixel within three frames keeps its shape", "[temporal]") {
    const Scene finger = [](int frame, int i, int j) {
        const double away = (i - 60.0 - 9.0 * frame) / 12.0;
        const bool there = std::fabs(away) < 1.0 && j > 20;
        return there ? 100.0 + 11.0 * (1.0 - away * away) : 60.0;
    };
    const NoisyScene scene{finger, [](double) { return 0.2; }, 400, 120};
    const auto frames = single_frames(scene.frames(20));
    for (const std::size_t k : {0U, 9U, 19U})
        CHECK(rms_error(filtered(frames, k, kQuiet), scene.truth(static_cast<int>(k))) < 1.0);
}

TEST_CASE("flickers of a frame or two on a few pixels are not followed", "[temporal]") {
    const NoisyScene scene{wall, [](double) { return 0.0; }};
    std::vector<DepthImage> frames = scene.frames(15);
    for (int k = 0; k < 15; ++k)
        if (k % 5 < 2)
            for (int j = 50; j < 55; ++j)
                for (int i = 40; i < 45; ++i) frames[static_cast<std::size_t>(k)].at(i, j) += 60.0F;
    for (const std::size_t k : {5U, 6U, 7U, 10U})
        CHECK(rms_error(filtered(single_frames(frames), k, kQuiet), scene.truth(0)) < 0.02);
}

TEST_CASE("a frame that is off as a whole is not followed", "[temporal]") {
    const NoisyScene scene{wall, [](double) { return 0.0; }};
    std::vector<DepthImage> frames = scene.frames(15);
    for (float& level : frames[7].levels) level += 60.0F;
    CHECK(rms_error(filtered(single_frames(frames), 7, kQuiet), scene.truth(7)) < 0.02);
}

TEST_CASE("what comes for good comes at once", "[temporal]") {
    const Scene coming = [](int frame, int i, int j) {
        return wall(0, i, j) + (frame >= 7 && i > 80 ? 50.0 : 0.0);
    };
    const NoisyScene scene{coming, [](double) { return 0.0; }};
    const auto frames = single_frames(scene.frames(15));
    for (const std::size_t k : {6U, 7U})
        CHECK(rms_error(filtered(frames, k, kQuiet), scene.truth(static_cast<int>(k))) < 0.01);
}

TEST_CASE("levels that were made up count little", "[temporal]") {
    const NoisyScene scene{wall, [](double) { return 0.0; }};
    std::vector<SingleFrameDepth> frames = single_frames(scene.frames(11));
    for (SingleFrameDepth& frame : frames) frame.filled.assign(frame.depth.levels.size(), 0);
    const std::size_t hole = frames[0].depth.index(80, 60);
    for (std::size_t k = 4; k < 7; ++k) {
        frames[k].filled[hole] = 1;
        frames[k].depth.levels[hole] += 0.4F;  // of what a finger rests on
    }
    CHECK_THAT(filtered(frames, 5, kQuiet).levels[hole], WithinAbs(wall(0, 80, 60), 0.06));
}

TEST_CASE("frames of another size are passed over", "[temporal]") {
    const NoisyScene scene{wall, [](double) { return 0.3; }};
    std::vector<SingleFrameDepth> frames = single_frames(scene.frames(5));
    const DepthImage alone = filtered({frames[2]}, 0, kNoisy);
    const SingleFrameDepth other{image_of(20, 20, 255.0, [](int, int) { return 9.0; }), {}, {}};
    frames[0] = frames[1] = frames[3] = frames[4] = other;
    CHECK(filtered(frames, 2, kNoisy).levels == alone.levels);
}
