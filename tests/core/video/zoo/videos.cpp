// Videos of depth, packed or beside colour, and pictures whose times only the colour video knows.
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/zoo/zoo.hpp"

namespace dibhr::test::zoo {

namespace {

constexpr int kVideoFrames = 20;
constexpr int kFewFrames = 6;

Pictures grey_near_bright(const Film& film) {
    return each(film.farness,
                [](const cv::Mat& farness) { return in_8_bits(nearness_of(farness)); });
}

Brought timed(const fs::path& place, const Film& film, double frames_per_s,
              Knows knows = Knows::order) {
    Brought brought{place, {}, truth_of(film, knows)};
    brought.truth.times_s = even_times(film.farness.size(), frames_per_s);
    brought.truth.colour_times_s = even_times(film.colour.size(), frames_per_s);
    return brought;
}

/// Colour and grey depth as halves, each of the whole size or squeezed. A squeezed half has every
/// other column: of a larger picture, whose outlines are as narrow as in films.
Brought halves(const fs::path& file, Place place, bool above_each_other, bool squeezed) {
    const cv::Size size = squeezed ? cv::Size(kView * 4) : kView;
    const Film film = film_of(place, squeezed ? kFewFrames : kVideoFrames, size);
    const Pictures grey = grey_near_bright(film);
    Pictures packed;
    for (std::size_t k = 0; k < grey.size(); ++k) {
        cv::Mat depth;
        cv::cvtColor(grey[k], depth, cv::COLOR_GRAY2BGR);
        cv::Mat both =
            above_each_other ? above(film.colour[k], depth) : beside(film.colour[k], depth);
        if (squeezed) cv::resize(both, both, size, 0.0, 0.0, cv::INTER_AREA);
        packed.push_back(both);
    }
    save_video(file, {{packed, 30.0, kGoodH264}});
    return timed(file, film, 30.0);
}

Form halves_form(const std::string& name, const std::string& file, bool above_each_other,
                 bool squeezed) {
    return {name, [=](const fs::path& folder) {
                return halves(folder / file, Place::portrait, above_each_other, squeezed);
            }};
}

Brought grey_video(const fs::path& folder, bool near_is_dark, Place place) {
    const Film film = film_of(place, kVideoFrames);
    Pictures grey = grey_near_bright(film);
    if (near_is_dark)
        grey = each(grey, [](const cv::Mat& level) { return cv::Mat(255.0 - level); });
    save_video(folder / "clip_color.mp4", {{film.colour, 30.0, kGoodH264}});
    save_video(folder / "clip_depth.mp4", {{grey, 30.0, kGoodH264}});
    return timed(folder / "clip_color.mp4", film, 30.0);
}

Brought millimetre_video(const fs::path& folder) {
    const Film film = film_of(Place::room, kVideoFrames);
    const Pictures levels =
        each(film.farness, [](const cv::Mat& farness) { return in_16_bits(farness, 1000.0); });
    save_video(folder / "take_color.mkv", {{film.colour, 30.0, kGoodH264}});
    save_video(folder / "take_depth.mkv", {{levels, 30.0, kGrey16}});
    return timed(folder / "take_color.mkv", film, 30.0, Knows::metric);
}

/// Two videos by one clock, of which the depth begins later.
Brought late_depth_video(const fs::path& folder) {
    constexpr int kLater = 6;
    const Film film = film_of(Place::room, kVideoFrames);
    Pictures levels;
    Brought brought = timed(folder / "take_color.mkv", film, 30.0, Knows::metric);
    Truth& truth = brought.truth;
    truth.farness.erase(truth.farness.begin(), truth.farness.begin() + kLater);
    for (const cv::Mat& farness : truth.farness) levels.push_back(in_16_bits(farness, 1000.0));
    truth.times_s = even_times(levels.size(), 30.0);
    for (double& time_s : truth.colour_times_s) time_s -= kLater / 30.0;
    save_video(folder / "take_color.mkv", {{film.colour, 30.0, kGoodH264}});
    save_video(folder / "take_depth.mkv", {{levels, 30.0, kGrey16}}, "-output_ts_offset 0.2");
    return brought;
}

Brought twelve_bit_video(const fs::path& folder) {
    const Film film = film_of(Place::room, kVideoFrames);
    const Pictures levels = each(film.farness, [](const cv::Mat& farness) {
        cv::Mat wide;  // ffmpeg takes the upper 12 of 16 bits
        disparity_of(farness, 65000.0).convertTo(wide, CV_16U);
        return wide;
    });
    save_video(folder / "take_disparity.mkv",
               {{levels, 30.0,
                 "-c:v libx265 -x265-params:v log-level=none:lossless=1 -pix_fmt:v gray12le"}});
    Brought brought = timed(folder / "take_disparity.mkv", film, 30.0, Knows::shape);
    brought.truth.colour.clear();
    return brought;
}

/// A video of colour, and depth pictures of every `step`th of its frames in a folder.
Brought video_and_pictures(const fs::path& folder, int colour_frames, int step, double rate,
                           const std::string& filter) {
    const Film film = film_of(Place::room, colour_frames, {96, 72});
    save_video(folder / "rgb.mp4", {{film.colour, rate, kGoodH264}}, filter);
    Brought brought{folder, {}, {}};
    Truth& truth = brought.truth;
    truth.knows = Knows::metric;
    truth.colour = film.colour;
    for (int k = 0; k < colour_frames; ++k) {
        const double even_s = k / rate;
        const double time_s = filter.empty() ? even_s : (20.0 * k + 2.0 * k * k) / 1000.0;
        truth.colour_times_s.push_back(time_s);
        if (k % step != 0) continue;
        const cv::Mat& farness = film.farness[static_cast<std::size_t>(k)];
        save(folder / numbered_name("depth/######.png", k), in_16_bits(farness, 1000.0));
        truth.farness.push_back(farness);
        truth.times_s.push_back(time_s);
    }
    return brought;
}

}  // namespace

Forms forms_of_videos() {
    return {halves_form("side by side, _RGBD", "hologram_RGBD.mp4", false, false),
            halves_form("side by side of half width, _HRGBD", "hologram_HRGBD.mp4", false, true),
            halves_form("2D-plus-depth without a name", "film.mp4", false, false),
            halves_form("colour above depth without a name", "film_tb.mp4", true, false),
            {"two videos, near is bright",
             [](const fs::path& folder) { return grey_video(folder, false, Place::room); }},
            {"two videos, near is dark",
             [](const fs::path& folder) { return grey_video(folder, true, Place::room); }},
            {"two videos of an organ, near is dark",
             [](const fs::path& folder) { return grey_video(folder, true, Place::organ); }},
            {"two videos, millimetres in FFV1", millimetre_video},
            {"two videos, the depth begins later", late_depth_video},
            {"disparity in HEVC of 12 bits", twelve_bit_video},
            {"video at 60 a second and pictures",
             [](const fs::path& folder) { return video_and_pictures(folder, 60, 1, 60.0, ""); }},
            {"video of uneven times and pictures",
             [](const fs::path& folder) {
                 return video_and_pictures(folder, 20, 1, 25.0,
                                           "-vf 'settb=1/1000,setpts=20*N+2*N*N' "
                                           "-enc_time_base 1/1000");
             }},
            {"video and every fifth picture",
             [](const fs::path& folder) { return video_and_pictures(folder, 100, 5, 30.0, ""); }}};
}

}  // namespace dibhr::test::zoo
