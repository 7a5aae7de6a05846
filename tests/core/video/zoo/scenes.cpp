// Distances by formulas, colours by what is seen there.
#include "tests/core/video/zoo/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>

#include "tests/core/video/coded_scene.hpp"

namespace dibhr::test::zoo {

namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// The nearest of the surfaces that a ray meets, numbered as they are added.
struct Nearest {
    double farness{std::numeric_limits<double>::infinity()};
    int object{0};
    int added{0};

    void add(double of) {
        ++added;
        if (!(of > 0.0) || of >= farness) return;
        farness = of;
        object = added;
    }
    /// Only where the condition holds; counts in any case.
    void add_if(bool condition, double of) { add(condition ? of : -1.0); }
};

/// Where a ray goes: from -1 at the left to 1 at the right, and as far a pixel downwards.
struct Ray {
    double u, v;
};

/// How far inside an ellipse: 1 at its middle, 0 at its rim and outside.
double inside(Ray ray, Ray middle, double width, double height) {
    const double off = std::hypot((ray.u - middle.u) / width, (ray.v - middle.v) / height);
    return std::sqrt(std::max(1.0 - off * off, 0.0));
}

bool is_between(double value, double lowest, double highest) {
    return value > lowest && value < highest;
}

double across(double moment) {
    return 1.4 * moment - 0.7;
}

Nearest room(Ray ray, double moment) {
    Nearest seen;
    seen.add(4.2 / (1.0 + 0.12 * ray.u));  // a wall
    seen.add(1.0 / (0.6 * ray.v));         // the floor
    seen.add(-1.6 / (0.6 * ray.u));        // a wall at the left
    const double ball = inside(ray, {across(moment), 0.1}, 0.28, 0.28);
    seen.add_if(ball > 0.0, 1.6 - 0.25 * ball);
    seen.add_if(is_between(ray.u, 0.45, 0.8) && is_between(ray.v, -0.1, 0.5), 2.1 + 0.2 * ray.u);
    return seen;
}

Nearest corridor(Ray ray, double moment) {
    Nearest seen;
    seen.add(12.5);
    seen.add(1.2 / (0.6 * std::abs(ray.v)));
    seen.add(1.0 / (0.6 * std::abs(ray.u)));
    const double person = inside(ray, {0.6 * across(moment), 0.15}, 0.1, 0.25);
    seen.add_if(person > 0.0, 2.4 - 0.15 * person);
    return seen;
}

Nearest street(Ray ray, double moment) {
    constexpr double kFarthest = 70.0;
    Nearest seen;
    const double road = 1.6 / (0.35 * ray.v);
    seen.add_if(road < kFarthest, road);
    const double house = 6.0 / (0.35 * std::abs(ray.u));
    seen.add_if(house < kFarthest && ray.v > -0.3 - 0.3 * std::abs(ray.u), house);
    const Ray car{across(moment), 0.28};
    seen.add_if(std::abs(ray.u - car.u) < 0.16 && std::abs(ray.v - car.v) < 0.14, 9.0);
    return seen;
}

Nearest portrait(Ray ray, double moment) {
    Nearest seen;
    seen.add(2.2 / (1.0 + 0.1 * ray.u + 0.05 * ray.v));
    seen.add_if(inside(ray, {0.0, 0.95}, 0.75, 0.5) > 0.0,
                0.9 - 0.1 * inside(ray, {0.0, 0.95}, 0.75, 0.5));
    const double head = inside(ray, {0.4 * across(moment), 0.0}, 0.3, 0.45);
    seen.add_if(head > 0.0, 0.75 - 0.12 * head);
    return seen;
}

Nearest organ(Ray ray, double moment) {
    Nearest seen;
    const double off = std::hypot(ray.u - 0.15, ray.v - 0.1);
    seen.add(0.012 / (off + 0.14) * (1.0 + 0.12 * std::cos(14.0 * off)));
    const double polyp = inside(ray, {across(moment), 0.35}, 0.2, 0.2);
    seen.add_if(polyp > 0.0, seen.farness * (1.0 - 0.3 * polyp));
    return seen;
}

/// Below 1000 m: mountains around a valley.
Nearest terrain(Ray ray) {
    const double high = 430.0 + 260.0 * (ray.u * ray.u + ray.v * ray.v) +
                        45.0 * std::sin(7.0 * ray.u + 1.0) * std::cos(5.0 * ray.v) +
                        25.0 * std::cos(17.0 * ray.u) * std::sin(13.0 * ray.v + 2.0);
    Nearest seen;
    seen.add(1000.0 - high);
    return seen;
}

/// Millimetres of a soft sensor, into which a ball is pressed from the other side.
Nearest gel(Ray ray, double moment) {
    Nearest seen;
    seen.add(2.0 - 0.1 * ray.u - 1.2 * inside(ray, {0.5 * across(moment), 0.1}, 0.4, 0.4));
    return seen;
}

Nearest seen_in(Place place, Ray ray, double moment) {
    switch (place) {
        case Place::room:
            return room(ray, moment);
        case Place::corridor:
            return corridor(ray, moment);
        case Place::street:
            return street(ray, moment);
        case Place::portrait:
            return portrait(ray, moment);
        case Place::organ:
            return organ(ray, moment);
        case Place::terrain:
            return terrain(ray);
        case Place::gel:
            return gel(ray, moment);
    }
    return {};
}

cv::Vec3b coloured(int object, int light) {
    static constexpr std::array<std::array<double, 3>, 6> kColours{{{1.6, 1.2, 0.8},
                                                                    {0.5, 0.8, 1.1},
                                                                    {0.4, 0.6, 0.5},
                                                                    {0.9, 0.7, 0.6},
                                                                    {0.3, 0.4, 1.4},
                                                                    {1.2, 0.5, 0.3}}};
    const auto& colour = kColours[static_cast<std::size_t>(object) % kColours.size()];
    cv::Vec3b bgr;
    for (int c = 0; c < 3; ++c)
        bgr[c] = cv::saturate_cast<std::uint8_t>(light * colour[static_cast<std::size_t>(c)]);
    return bgr;
}

}  // namespace

View view_of(Place place, double moment, cv::Size size) {
    View view{cv::Mat(size, CV_32FC1), cv::Mat(size, CV_8UC3)};
    const cv::Mat texture = rough(size.width, size.height, 7);
    for (int j = 0; j < size.height; ++j) {
        for (int i = 0; i < size.width; ++i) {
            const Ray ray{(2.0 * i + 1.0) / size.width - 1.0,
                          (2.0 * j + 1.0 - size.height) / size.width};
            const Nearest seen = seen_in(place, ray, moment);
            const bool is_sky = !std::isfinite(seen.farness);
            view.farness.at<float>(j, i) = is_sky ? kNothing : static_cast<float>(seen.farness);
            double light = is_sky ? 150.0 : texture.at<std::uint8_t>(j, i);
            // The lamp of an endoscope is beside its camera.
            if (place == Place::organ) light *= std::min(1.0, std::pow(0.018 / seen.farness, 2.0));
            view.colour.at<cv::Vec3b>(j, i) = coloured(seen.object, static_cast<int>(light));
        }
    }
    return view;
}

Film film_of(Place place, int frames, cv::Size size) {
    Film film;
    for (int k = 0; k < frames; ++k) {
        View view = view_of(place, frames > 1 ? k / (frames - 1.0) : 0.3, size);
        film.farness.push_back(view.farness);
        film.colour.push_back(view.colour);
    }
    return film;
}

cv::Mat with_hole(const cv::Mat& farness) {
    cv::Mat holed = farness.clone();
    holed(cv::Rect(farness.cols / 8, farness.rows / 8, farness.cols / 5, farness.rows / 4))
        .setTo(cv::Scalar(static_cast<double>(kNothing)));
    return holed;
}

cv::Mat thinned(const cv::Mat& farness, double share) {
    cv::Mat chance(farness.size(), CV_32FC1);
    cv::RNG random(41);
    random.fill(chance, cv::RNG::UNIFORM, 0.0, 1.0);
    cv::Mat thin = farness.clone();
    thin.setTo(cv::Scalar(static_cast<double>(kNothing)), chance > share);
    return thin;
}

}  // namespace dibhr::test::zoo
