// Formulas for surfaces, and what follows from them at every pixel.
#include "tests/bench/known_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace dibhr::bench {

namespace {

constexpr double kMostColumns = 640.0;  // at this width the numbers below are pixels
constexpr double kWall_px = 40.0;

double gauss(double x, double wide_x, double y, double wide_y) {
    return std::exp(-0.5 * (x * x / (wide_x * wide_x) + y * y / (wide_y * wide_y)));
}

/// Places from the middle of the picture, in pixels of the widest one.
struct Centred {
    double x, y;
};

using Shape = std::function<Seen(double frame, Centred at)>;

KnownScene scaled(const std::string& name, int columns, int rows, const Shape& shape) {
    const double scale = columns / kMostColumns;
    KnownScene scene{name, columns, rows, {}, false, {}};
    scene.at = [=](double frame, double x, double y) {
        Seen seen = shape(frame, {(x - 0.5 * columns) / scale, (y - 0.5 * rows) / scale});
        // Slopes are the same at any size, and the wall stays well above the back.
        seen.elevation_px = kWall_px + scale * (seen.elevation_px - kWall_px);
        return seen;
    };
    return scene;
}

Seen plane(double /*frame*/, Centred at) {
    return {120.0 + 0.2 * at.x + 0.1 * at.y, 0};
}

Seen sphere(double /*frame*/, Centred at) {
    constexpr double kRadius_px = 150.0;
    const double left2 = kRadius_px * kRadius_px - at.x * at.x - at.y * at.y;
    if (left2 <= 0.0) return {kWall_px, 0};
    return {80.0 + std::sqrt(left2), 1};
}

/// A head of 47 x 63 % of the picture's width, its rim 20 cm before the wall.
Seen face(double /*frame*/, Centred at) {
    const double out2 = std::pow(at.x / 150.0, 2.0) + std::pow(at.y / 200.0, 2.0);
    if (out2 >= 1.0) return {kWall_px, 0};
    const double nose = 28.0 * gauss(at.x, 18.0, at.y - 10.0, 35.0);
    const double eyes = 14.0 * (gauss(at.x - 55.0, 22.0, at.y + 45.0, 16.0) +
                                gauss(at.x + 55.0, 22.0, at.y + 45.0, 16.0));
    const double lips =
        7.0 * (gauss(at.x, 35.0, at.y - 85.0, 7.0) + gauss(at.x, 30.0, at.y - 105.0, 8.0));
    return {145.0 + 65.0 * (1.0 - out2) + nose - eyes + lips, 1};
}

/// A round bar from one point to another.
struct Finger {
    Centred from, to;
    double radius;
};
constexpr std::array kHand{
    Finger{{0.0, 30.0}, {10.0, 60.0}, 52.0},      // the palm
    Finger{{-36.0, 10.0}, {-52.0, -95.0}, 14.0},  // and what is on it
    Finger{{-12.0, 0.0}, {-18.0, -120.0}, 15.0}, Finger{{14.0, 0.0}, {18.0, -115.0}, 15.0},
    Finger{{38.0, 10.0}, {52.0, -90.0}, 13.0},   Finger{{-40.0, 60.0}, {-105.0, 10.0}, 16.0}};

/// 1 on the bar's line, 0 at its rim, below 0 beyond.
double roundness(const Finger& finger, Centred at) {
    const double x = finger.to.x - finger.from.x;
    const double y = finger.to.y - finger.from.y;
    const double along =
        ((at.x - finger.from.x) * x + (at.y - finger.from.y) * y) / (x * x + y * y);
    const double on = std::clamp(along, 0.0, 1.0);
    const double away =
        std::hypot(at.x - finger.from.x - on * x, at.y - finger.from.y - on * y) / finger.radius;
    return 1.0 - away * away;
}

/// 41 px are 80 mm.
Seen hand(double frame, Centred at) {
    // 0.5 m/s at 1 m, where a pixel of a Kinect of 640 columns (f = 575 px) is 1.74 mm.
    constexpr double kSpeed_px = 500.0 / kRate / 1.74;
    const double wall = kWall_px + 20.0 + 0.02 * at.x;
    const Centred moved{at.x + 190.0 - kSpeed_px * frame, at.y};
    double height = 0.0;
    for (const Finger& finger : kHand) {
        const double round = roundness(finger, moved);
        if (round > 0.0) height = std::max(height, 41.0 + 0.9 * finger.radius * round);
    }
    if (height == 0.0) return {wall, 0};
    return {kWall_px + 20.0 + height, 1};
}

constexpr double kTorso_px = 200.0;  // to each side

Seen chest(double /*frame*/, Centred at) {
    if (std::fabs(at.x) >= kTorso_px) return {kWall_px, 0};
    return {kWall_px + 50.0 + 70.0 * gauss(at.x, 120.0, at.y, 250.0), 1};
}

/// 12 times a minute, 5 px from lowest to highest, whatever the picture's size. It turns in the
/// middle of a clip of 40 frames: even motion would not tell a lag from an offset.
KnownScene breathing(KnownScene scene) {
    const double scale = scene.columns / kMostColumns;
    const auto still = scene.at;
    const double columns = scene.columns;
    const double rows = scene.rows;
    scene.at = [=](double frame, double x, double y) {
        constexpr double kTurns_per_s = 12.0 / 60.0;
        constexpr double kHighest_frame = 20.0;
        Seen seen = still(frame, x, y);
        if (seen.object == 0) return seen;
        const double t_s = (frame - kHighest_frame) / kRate;
        const double breath = std::cos(2.0 * std::numbers::pi * kTurns_per_s * t_s);
        const double part =
            gauss((x - 0.5 * columns) / scale, 110.0, (y - 0.5 * rows) / scale, 150.0);
        seen.elevation_px += 2.5 * breath * part;
        return seen;
    };
    scene.moves = true;
    return scene;
}

/// Round, 1 px high, 8 px wide, every 40 px.
double bump(double x, double y) {
    const double away = std::hypot(std::fmod(x, 40.0) - 20.0, std::fmod(y, 40.0) - 20.0);
    return away < 4.0 ? 0.5 * (1.0 + std::cos(std::numbers::pi * away / 4.0)) : 0.0;
}

KnownScene bumps(int columns, int rows) {
    KnownScene scene{"bumps", columns, rows, {}, false, bump};
    scene.at = [](double /*frame*/, double x, double y) {
        return Seen{60.0 + 0.15 * x + 0.1 * y + bump(x, y), 0};
    };
    return scene;
}

/// How far the middle of each pixel is from the line between objects.
std::vector<float> distances(const KnownScene& scene, const std::vector<std::uint8_t>& object) {
    const auto columns = static_cast<std::size_t>(scene.columns);
    cv::Mat inside(scene.rows, scene.columns, CV_8U, cv::Scalar(255));
    bool any = false;
    const auto compare = [&](std::size_t a, std::size_t b) {
        if (object[a] == object[b]) return;
        inside.data[a] = inside.data[b] = 0;
        any = true;
    };
    for (std::size_t k = 0; k < object.size(); ++k) {
        if ((k + 1) % columns != 0) compare(k, k + 1);
        if (k + columns < object.size()) compare(k, k + columns);
    }
    if (!any) return std::vector<float>(object.size(), std::numeric_limits<float>::infinity());
    cv::Mat away;
    cv::distanceTransform(inside, away, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    away += 0.5F;
    return {away.begin<float>(), away.end<float>()};
}

Vec3 normal_at(const KnownScene& scene, double frame, double x, double y) {
    constexpr double kStep_px = 1e-3;
    const auto slope = [&](double right, double down) {
        return (scene.at(frame, x + right, y + down).elevation_px -
                scene.at(frame, x - right, y - down).elevation_px) /
               (2.0 * kStep_px);
    };
    return {-slope(kStep_px, 0.0), -slope(0.0, kStep_px), 1.0};
}

TrueFrame true_frame(const KnownScene& scene, int frame) {
    TrueFrame truth;
    truth.elevation = image_of(scene.columns, scene.rows, kRelief_px, [&](int i, int j) {
        const Seen seen = scene.at(frame, i, j);
        truth.object.push_back(static_cast<std::uint8_t>(seen.object));
        return seen.elevation_px;
    });
    truth.to_silhouette_px = distances(scene, truth.object);
    truth.normal.resize(truth.object.size());
    for (int j = 0; j + 1 < scene.rows; ++j) {
        for (int i = 0; i + 1 < scene.columns; ++i) {
            const std::size_t k = truth.elevation.index(i, j);
            if (truth.to_silhouette_px[k] >= kBeside_px)
                truth.normal[k] = normal_at(scene, frame, i + 1.0 / 3.0, j + 1.0 / 3.0);
        }
    }
    return truth;
}

}  // namespace

std::vector<KnownScene> known_scenes(int columns, int rows) {
    std::vector<KnownScene> scenes{scaled("plane", columns, rows, plane),
                                   scaled("sphere", columns, rows, sphere),
                                   scaled("face", columns, rows, face),
                                   scaled("hand", columns, rows, hand),
                                   breathing(scaled("chest", columns, rows, chest)),
                                   bumps(columns, rows)};
    scenes[3].moves = true;
    return scenes;
}

KnownScene known_scene(const std::string& name, int columns, int rows) {
    for (KnownScene& scene : known_scenes(columns, rows))
        if (scene.name == name) return scene;
    throw std::invalid_argument("no scene is called " + name);
}

TrueFrames::TrueFrames(const KnownScene& scene, int count) : scene_(scene), count_(count) {
    const int made = scene.moves ? count : 1;
    for (int k = 0; k < made; ++k) frames_.push_back(true_frame(scene, k));
}

}  // namespace dibhr::bench
