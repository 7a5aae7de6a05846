// Formulas for what moves.
#include "tests/core/video/moving_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include "tests/core/video/clips.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

namespace {

constexpr double kSwings_hz = 2.0;   // of the exposure
constexpr double kRadius_px = 0.19;  // of the sphere, in picture widths; the hand's reach is alike
constexpr double kWall_px = 60.0;
constexpr double kDisc_px = 60.0;  // before the wall

double hash_of(int x, int y, int seed) {
    auto bits = static_cast<std::uint32_t>(x) * 374761393U +
                static_cast<std::uint32_t>(y) * 668265263U +
                static_cast<std::uint32_t>(seed) * 2246822519U;
    bits = (bits ^ (bits >> 13U)) * 1274126177U;
    bits ^= bits >> 16U;
    return static_cast<double>(bits & 0xffffffU) / 16777216.0 - 0.5;
}

/// Random values a pixel apart, smooth between them.
double waves(double x, double y, int seed) {
    const auto whole = [](double of) {  // floor(), without a call
        const int cut = static_cast<int>(of);
        return cut > of ? cut - 1 : cut;
    };
    const int i = whole(x);
    const int j = whole(y);
    const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const auto between = [](double from, double to, double t) { return from + t * (to - from); };
    const double a = smooth(x - i);
    const double b = smooth(y - j);
    return between(between(hash_of(i, j, seed), hash_of(i + 1, j, seed), a),
                   between(hash_of(i, j + 1, seed), hash_of(i + 1, j + 1, seed), a), b);
}

double squared(double x, double y) {
    return x * x + y * y;
}

/// A pixel's brightness is the mean of that at these places around its middle.
constexpr std::array<MovingScene::Point, 4> kPlaces{
    {{-0.25, -0.25}, {-0.25, 0.25}, {0.25, -0.25}, {0.25, 0.25}}};

struct Bar {
    double x0, y0, x1, y1, radius;
};
/// A palm and five fingers, in a picture of 640 columns.
constexpr std::array kBars{
    Bar{0.0, 30.0, 10.0, 60.0, 52.0},     Bar{-36.0, 10.0, -52.0, -95.0, 14.0},
    Bar{-12.0, 0.0, -18.0, -120.0, 15.0}, Bar{14.0, 0.0, 18.0, -115.0, 15.0},
    Bar{38.0, 10.0, 52.0, -90.0, 13.0},   Bar{-40.0, 60.0, -105.0, 10.0, 16.0}};

double hand_height(MovingScene::Point at) {
    double height = 0.0;
    for (const Bar& bar : kBars) {
        const double x = bar.x1 - bar.x0;
        const double y = bar.y1 - bar.y0;
        const double along = ((at.x - bar.x0) * x + (at.y - bar.y0) * y) / (x * x + y * y);
        const double on = std::clamp(along, 0.0, 1.0);
        const double away =
            squared(at.x - bar.x0 - on * x, at.y - bar.y0 - on * y) / (bar.radius * bar.radius);
        if (away < 1.0) height = std::max(height, 41.0 + 0.9 * bar.radius * (1.0 - away));
    }
    return height;
}

}  // namespace

double texture(double x, double y, int seed) {
    return 50.0 * waves(x / 3.1, y / 3.1, seed) + 60.0 * waves(x / 9.3, y / 9.3, seed + 1) +
           70.0 * waves(x / 31.0, y / 31.0, seed + 2);
}

MovingScene::MovingScene(const What& what) : what_(what) {
    if (what_.shape == Shape::plane) return;  // which hides the wall
    wall_.reserve(kPlaces.size() * static_cast<std::size_t>(what_.columns * what_.rows));
    for (int j = 0; j < what_.rows; ++j)
        for (int i = 0; i < what_.columns; ++i)
            for (const Point place : kPlaces)
                wall_.push_back(110.0 + texture(i + place.x, j + place.y, 31));
}

double MovingScene::size_px() const {
    return what_.shape == Shape::disc ? 0.5 * what_.diameter_px : kRadius_px * what_.columns;
}

/// It passes the middle of the picture at half a second.
MovingScene::Point MovingScene::middle(double t_s) const {
    const double gone_px = what_.goes == Goes::along ? what_.speed_px_per_s * (t_s - 0.1) : 0.0;
    return {0.5 * what_.columns + 0.94 * gone_px, 0.54 * what_.rows + 0.34 * gone_px};
}

/// So many times as large as at first.
double MovingScene::grown(double t_s) const {
    const double rims = what_.speed_px_per_s / size_px() * t_s;
    if (what_.goes == Goes::apart) return 1.0 + rims;
    return what_.goes == Goes::swelling ? std::exp(rims) : 1.0;
}

MovingScene::Point MovingScene::on_thing(double t_s, Point place) const {
    const Point middle = this->middle(t_s);
    const double size = grown(t_s);
    const double x = (place.x - middle.x) / size;
    const double y = (place.y - middle.y) / size;
    if (what_.goes != Goes::round) return {x, y};
    const double turn = what_.speed_px_per_s / size_px() * t_s;
    return {std::cos(turn) * x + std::sin(turn) * y, std::cos(turn) * y - std::sin(turn) * x};
}

MovingScene::Point MovingScene::off_thing(double t_s, Point on) const {
    const Point middle = this->middle(t_s);
    const double turn = what_.goes == Goes::round ? what_.speed_px_per_s / size_px() * t_s : 0.0;
    return {middle.x + grown(t_s) * (std::cos(turn) * on.x - std::sin(turn) * on.y),
            middle.y + grown(t_s) * (std::sin(turn) * on.x + std::cos(turn) * on.y)};
}

MovingScene::Seen MovingScene::at(double t_s, Point place) const {
    return at(on_thing(t_s, place), place);
}

MovingScene::Seen MovingScene::at(Point on, Point place) const {
    if (what_.shape == Shape::plane) return {100.0 + 0.1 * on.x + 0.05 * on.y, 1};
    if (what_.shape == Shape::sphere) {
        const double left = size_px() * size_px() - squared(on.x, on.y);
        if (left > 0.0) return {80.0 + std::sqrt(left), 1};
    }
    if (what_.shape == Shape::disc && squared(on.x, on.y) < size_px() * size_px())
        return {kWall_px + kDisc_px, 1};
    if (what_.shape == Shape::hand) {
        const double scale = what_.columns / 640.0;
        const double height = scale * hand_height({on.x / scale, on.y / scale});
        if (height > 0.0) return {kWall_px + height, 1};
    }
    return {kWall_px + 0.02 * place.x, 0};
}

double MovingScene::brightness_on(Point on) const {
    if (what_.look == Look::textured) return 140.0 + 0.8 * texture(on.x, on.y, 3);
    const double shade = what_.look == Look::shaded ? (0.6 * on.x - 0.8 * on.y) / size_px() : 0.0;
    return 150.0 + 50.0 * shade;
}

double MovingScene::brightness(double t_s, int i, int j) const {
    const auto pixel = static_cast<std::size_t>(j * what_.columns + i);
    double sum = 0.0;
    for (std::size_t k = 0; k < kPlaces.size(); ++k) {
        const Point place{i + kPlaces[k].x, j + kPlaces[k].y};
        const Point on = on_thing(t_s, place);
        sum += at(on, place).object == 0 ? wall_[kPlaces.size() * pixel + k] : brightness_on(on);
    }
    return sum / static_cast<double>(kPlaces.size());
}

MovingScene::Point MovingScene::gone(double t_s, Point place, double later_s) const {
    if (at(t_s, place).object == 0) return place;
    return off_thing(later_s, on_thing(t_s, place));
}

std::shared_ptr<const MotionField> MovingScene::motion(double from_s, double to_s) const {
    MotionField field{what_.columns, what_.rows, {}};
    field.ways.reserve(static_cast<std::size_t>(field.columns) *
                       static_cast<std::size_t>(field.rows));
    for (int j = 0; j < field.rows; ++j)
        for (int i = 0; i < field.columns; ++i) {
            const Point there = gone(from_s, {1.0 * i, 1.0 * j}, to_s);
            field.ways.push_back(
                {static_cast<float>(there.x - i), static_cast<float>(there.y - j)});
        }
    return std::make_shared<const MotionField>(std::move(field));
}

Frame MovingScene::frame(double t_s, const CameraNoise& noise) const {
    std::mt19937 random(noise.seed);
    std::normal_distribution<double> normal;
    const double exposed =
        1.0 + noise.exposure * std::sin(2.0 * std::numbers::pi * kSwings_hz * t_s);
    auto colour = std::make_shared<ColourImage>(ColourImage{what_.columns, what_.rows, {}});
    colour->rgb.reserve(3 * static_cast<std::size_t>(what_.columns * what_.rows));
    Frame frame = uncoloured(t_s, [&](int i, int j) {
        const double bright = noise.brightness * normal(random) + exposed * brightness(t_s, i, j);
        const auto grey = static_cast<std::uint8_t>(std::clamp(std::lround(bright), 0L, 255L));
        colour->rgb.insert(colour->rgb.end(), {grey, grey, grey});
        return noise.elevation_px > 0.0 ? noise.elevation_px * normal(random) : 0.0;
    });
    frame.colour = std::move(colour);
    frame.colour_of_view = true;
    return frame;
}

Frame MovingScene::uncoloured(double t_s, const std::function<double(int i, int j)>& off_px) const {
    Frame frame;
    frame.depth = std::make_shared<const DepthImage>(
        image_of(what_.columns, what_.rows, 255.0, [&](int i, int j) {
            const double off = off_px ? off_px(i, j) : 0.0;
            return at(t_s, {static_cast<double>(i), static_cast<double>(j)}).elevation_px + off;
        }));
    frame.time_s = frame.media_s = t_s;
    return frame;
}

namespace {

/// As a video's colours come back.
void code(std::vector<Frame>& frames, double frames_per_s) {
    const TemporaryFolder folder;
    const ColourImage& first = *frames.front().colour;
    {
        std::ofstream raw(folder / "raw", std::ios::binary);
        for (const Frame& frame : frames)
            raw.write(reinterpret_cast<const char*>(frame.colour->rgb.data()),
                      static_cast<std::streamsize>(frame.colour->rgb.size()));
    }
    ffmpeg("-f rawvideo -pix_fmt rgb24 -s " + std::to_string(first.columns) + "x" +
           std::to_string(first.rows) + " -r " + std::to_string(frames_per_s) + " -i '" +
           (folder / "raw").string() + "' -c:v libx264 -crf 23 -pix_fmt yuv420p '" +
           (folder / "coded.mp4").string() + "'");
    ffmpeg("-i '" + (folder / "coded.mp4").string() + "' -f rawvideo -pix_fmt rgb24 '" +
           (folder / "decoded").string() + "'");
    std::ifstream decoded(folder / "decoded", std::ios::binary);
    for (Frame& frame : frames) {
        auto colour = std::make_shared<ColourImage>(*frame.colour);
        decoded.read(reinterpret_cast<char*>(colour->rgb.data()),
                     static_cast<std::streamsize>(colour->rgb.size()));
        if (!decoded) throw std::runtime_error("the coded video holds too few frames");
        frame.colour = std::move(colour);
    }
}

}  // namespace

std::vector<Frame> film(const MovingScene& scene, int count, double frames_per_s,
                        const CameraNoise& noise, bool coded) {
    std::vector<Frame> frames;
    for (int k = 0; k < count; ++k) {
        CameraNoise now = noise;
        now.seed += static_cast<std::uint32_t>(k);
        frames.push_back(scene.frame(k / frames_per_s, now));
        frames.back().index = k;
    }
    if (coded) code(frames, frames_per_s);
    return frames;
}

}  // namespace dibhr::test
