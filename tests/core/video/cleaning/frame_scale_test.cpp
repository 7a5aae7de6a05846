// A whole scene that flickers is brought onto one scale; everything else does not change.
#include "core/video/cleaning/frame_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/noisy_scene.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

std::vector<SingleFrameDepth> single_frames(const std::vector<DepthImage>& frames) {
    std::vector<SingleFrameDepth> made;
    for (const DepthImage& frame : frames) made.push_back({frame, {}, {}});
    return made;
}

std::vector<const SingleFrameDepth*> span_of(const std::vector<SingleFrameDepth>& frames) {
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& frame : frames) all.push_back(&frame);
    return all;
}

/// A wall and an object of a man's size before it.
double room(int /*frame*/, int i, int j) {
    const bool before = std::hypot(i - 80, j - 70) < 45.0;
    return before ? 170.0 - 0.2 * std::hypot(i - 80, j - 70) : 60.0 + 0.2 * i + 0.1 * j;
}

/// The scale of each frame, as from an estimator: 1.5 % of gain and of shift.
std::vector<LevelMap> scales_of(std::size_t count, double deviation = 0.015) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<LevelMap> scales;
    for (std::size_t k = 0; k < count; ++k) {
        const double gain = 1.0 + deviation * normal(random);
        scales.push_back({gain, 255.0 * deviation * normal(random)});
    }
    return scales;
}

std::vector<DepthImage> in_scales(std::vector<DepthImage> frames,
                                  const std::vector<LevelMap>& scales) {
    for (std::size_t k = 0; k < frames.size(); ++k)
        for (float& level : frames[k].levels)
            level = static_cast<float>(scales[k](static_cast<double>(level)));
    return frames;
}

/// A level in the mean of the scales around frame `now`.
double common(const std::vector<LevelMap>& scales, std::size_t now, double level) {
    double sum = 0.0;
    for (std::size_t k = now - kNearInTime; k <= now + kNearInTime; ++k) sum += scales[k](level);
    return sum / (2.0 * kNearInTime + 1.0);
}

bool are_identities(const std::vector<LevelMap>& maps) {
    return std::all_of(maps.begin(), maps.end(),
                       [](const LevelMap& map) { return map == LevelMap{}; });
}

std::vector<LevelMap> maps_of(const std::vector<SingleFrameDepth>& frames, std::size_t now) {
    return FrameScale().maps(span_of(frames), now);
}

/// Whether no frame of that clip is changed.
bool stays(const std::vector<DepthImage>& frames) {
    const std::vector<SingleFrameDepth> all = single_frames(frames);
    for (std::size_t now = 0; now < all.size(); ++now)
        if (!are_identities(maps_of(all, now))) return false;
    return true;
}

constexpr auto kQuiet = [](double) { return 0.0; };

}  // namespace

TEST_CASE("frames of a scale each come onto the mean of the scales around", "[scale]") {
    const double noise = GENERATE(0.0, 0.5);
    const NoisyScene scene{room, [noise](double) { return noise; }};
    const std::vector<LevelMap> scales = scales_of(16);
    const auto frames = single_frames(in_scales(scene.frames(16), scales));
    for (const std::size_t now : {5U, 8U, 10U}) {
        const std::vector<LevelMap> maps = maps_of(frames, now);
        for (std::size_t k = now - 5; k <= now + 5; ++k)
            for (const double level : {60.0, 100.0, 170.0})
                CHECK_THAT(maps[k](scales[k](level)),
                           WithinAbs(common(scales, now, level), 0.01 + 0.5 * noise));
    }
}

TEST_CASE("what flickers by its scale alone does so only slowly then", "[scale]") {
    const NoisyScene scene{room, kQuiet};
    const auto frames = single_frames(in_scales(scene.frames(40), scales_of(40)));
    double before = 0.0;
    double after = 0.0;
    for (std::size_t now = 6; now < 34; ++now) {
        FrameScale scale;
        const float level = scale.on_one_scale(span_of(frames), now)[now]->depth.at(5, 5);
        const float next = scale.on_one_scale(span_of(frames), now + 1)[now + 1]->depth.at(5, 5);
        before += std::fabs(frames[now + 1].depth.at(5, 5) - frames[now].depth.at(5, 5));
        after += std::fabs(next - level);
    }
    CHECK(after < 0.15 * before);
}

TEST_CASE("noise, however coarse, is no flicker of the scale", "[scale]") {
    const double noise = GENERATE(0.0, 0.5, 3.0);
    CHECK(stays(NoisyScene{room, [noise](double) { return noise; }}.frames(12)));
}

TEST_CASE("what moves in a part of the picture is no flicker of the scale", "[scale]") {
    // A hand as large as half the picture moves towards the camera and back, in jerks.
    const Scene hand = [](int frame, int i, int j) {
        return i < 80 ? 120.0 + 0.3 * j + 12.0 * (frame % 3) : 60.0 + 0.1 * j;
    };
    CHECK(stays(NoisyScene{hand, kQuiet}.frames(12)));
    CHECK(stays(NoisyScene{hand, [](double) { return 0.5; }}.frames(12)));
}

TEST_CASE("a chest that breathes and a scene that comes nearer evenly stay", "[scale]") {
    const Scene breathing = [](int frame, int i, int j) {
        return 100.0 + 0.1 * i + 0.1 * j +
               2.5 * std::sin(2.0 * std::numbers::pi * 0.2 * frame / 30.0);
    };
    CHECK(stays(NoisyScene{breathing, kQuiet}.frames(40)));
    const Scene coming = [](int frame, int i, int j) {
        return room(0, i, j) * (1.0 + 0.01 * frame);
    };
    CHECK(stays(NoisyScene{coming, kQuiet}.frames(20)));
}

TEST_CASE("a scene that comes nearer while it flickers does so without lag", "[scale]") {
    const Scene coming = [](int frame, int i, int j) { return room(0, i, j) + 1.5 * frame; };
    const NoisyScene scene{coming, kQuiet};
    const std::vector<LevelMap> scales = scales_of(16);
    const auto frames = single_frames(in_scales(scene.frames(16), scales));
    const std::vector<LevelMap> maps = maps_of(frames, 8);
    double late = 0.0;
    for (const double level : {80.0, 180.0})
        late += maps[8](scales[8](level)) - common(scales, 8, level);
    CHECK_THAT(late / 2.0, WithinAbs(0.0, 0.3));  // of 1.5 a frame
}

TEST_CASE("a hand that moves before a scene that flickers does not move the scene", "[scale]") {
    const Scene hand = [](int frame, int i, int j) {
        const double x = i - 20.0 - 5.0 * frame;
        return x >= 0.0 && x < 50.0 && j > 40 ? 200.0 + 4.0 * frame : room(0, i, j);
    };
    const NoisyScene scene{hand, kQuiet};
    const std::vector<LevelMap> scales = scales_of(14);
    const auto frames = single_frames(in_scales(scene.frames(14), scales));
    const std::vector<LevelMap> maps = maps_of(frames, 6);
    for (const std::size_t k : {2U, 6U, 10U})
        CHECK_THAT(maps[k](scales[k](70.0)), WithinAbs(common(scales, 6, 70.0), 0.25));
}

TEST_CASE("holes and what was made up in them do not count", "[scale]") {
    const NoisyScene scene{room, kQuiet};
    const std::vector<LevelMap> scales = scales_of(12);
    std::vector<SingleFrameDepth> frames = single_frames(in_scales(scene.frames(12), scales));
    for (std::size_t k = 0; k < frames.size(); ++k) {
        frames[k].filled.assign(frames[k].depth.levels.size(), 0);
        for (int j = 0; j < 120; ++j)
            for (int i = 0; i < 70; ++i) {
                frames[k].depth.at(i, j) = k % 2 == 0 ? 0.0F : 200.0F;
                frames[k].filled[frames[k].depth.index(i, j)] = 1;
            }
        for (int j = 0; j < 30; ++j)
            for (int i = 70; i < 160; ++i)
                frames[k].depth.at(i, j) = std::numeric_limits<float>::quiet_NaN();
    }
    const std::vector<LevelMap> maps = maps_of(frames, 5);
    CHECK_THAT(maps[5](scales[5](150.0)), WithinAbs(common(scales, 5, 150.0), 0.05));
    SingleFrameDepth mapped;
    scale_levels(frames[5], maps[5], mapped);
    CHECK(std::isnan(mapped.depth.at(100, 10)));
}

TEST_CASE("behind a cut the scale is another one's, and nothing is made of it", "[scale]") {
    const NoisyScene scene{room, kQuiet};
    std::vector<DepthImage> images = in_scales(scene.frames(14), scales_of(14));
    for (std::size_t k = 8; k < 14; ++k)
        images[k] = image_of(160, 120, 255.0, [&](int i, int j) {
            return 20.0 + std::fmod(3.0 * i + 7.0 * j, 190.0) + static_cast<double>(k);
        });
    const std::vector<LevelMap> maps = maps_of(single_frames(images), 6);
    CHECK_FALSE(maps[7] == LevelMap{});
    for (std::size_t k = 8; k < 14; ++k) CHECK(maps[k] == LevelMap{});
}

TEST_CASE("frames of another size, and too few of them, say nothing", "[scale]") {
    const NoisyScene scene{room, kQuiet};
    std::vector<SingleFrameDepth> frames =
        single_frames(in_scales(scene.frames(11), scales_of(11)));
    const std::vector<SingleFrameDepth> few(frames.begin(), frames.begin() + 3);
    CHECK(are_identities(maps_of(few, 1)));
    frames[4] = frames[6] = {image_of(20, 20, 255.0, [](int, int) { return 9.0; }), {}, {}};
    CHECK(are_identities(maps_of(frames, 5)));
}

TEST_CASE("levels stay within those there are, and what was never seen stays", "[scale]") {
    SingleFrameDepth frame{image_of(4, 2, 255.0, [](int i, int) { return 85.0 * i; }), {}, {}};
    frame.unseen.assign(8, 0);
    frame.unseen[0] = 1;
    SingleFrameDepth scaled;
    scale_levels(frame, {1.1, 5.0}, scaled);
    CHECK(scaled.depth.at(0, 0) == 0.0F);
    CHECK_THAT(scaled.depth.at(1, 0), WithinAbs(98.5, 1e-4));
    CHECK(scaled.depth.at(3, 0) == 255.0F);
    CHECK(scaled.unseen == frame.unseen);
}

TEST_CASE("the same frames give the same maps, whatever was asked for before", "[scale]") {
    const NoisyScene scene{room, [](double) { return 0.5; }};
    const auto frames = single_frames(in_scales(scene.frames(14), scales_of(14)));
    FrameScale scale;
    const std::vector<LevelMap> once = scale.maps(span_of(frames), 9);
    (void)scale.maps(span_of(frames), 3);
    CHECK(scale.maps(span_of(frames), 9) == once);
}
