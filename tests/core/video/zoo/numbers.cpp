// Distances and other numbers in single files: what stands for no data, what bytes mean, and what
// programs that draw write.
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "tests/core/video/zoo/zoo.hpp"

namespace dibhr::test::zoo {

namespace {

/// Metres in real numbers, with a hole that is written as `none`.
Form holed_form(const std::string& ending, double none, const std::string& what) {
    return {"holes of " + what + " in " + ending, [=](const fs::path& folder) {
                const cv::Mat farness = with_hole(view_of(Place::room).farness);
                const cv::Mat numbers = with_no_data_as(farness, none);
                const fs::path file = folder / ("scan_depth." + ending);
                if (ending == "npy") save_npy(file, numbers);
                if (ending == "npz") save_npz(file, {{"depth", npy_of({numbers})}});
                if (ending == "tif") save_tiff(file, numbers);
                if (ending == "pfm") save_pfm(file, numbers);
                if (ending == "exr") save_exr(file, {{"Z", numbers}});
                return Brought{file, {}, truth_of(farness)};
            }};
}

/// A frame of zeros around the picture.
Brought constant_border(const fs::path& folder) {
    cv::Mat farness = view_of(Place::room).farness;
    cv::Mat inner = farness(cv::Rect(8, 8, kView.width - 16, kView.height - 16)).clone();
    farness.setTo(std::numeric_limits<double>::quiet_NaN());
    inner.copyTo(farness(cv::Rect(8, 8, inner.cols, inner.rows)));
    save_npy(folder / "scan_depth.npy", with_no_data_as(farness, 0.0));
    return {folder / "scan_depth.npy", {}, truth_of(farness)};
}

/// Far in the middle, no zeros, and most of it above 12000.
Brought corridor_levels(const fs::path& folder) {
    const View view = view_of(Place::corridor);
    save(folder / "corridor_depth.png", in_16_bits(view.farness, 5000.0));
    return {folder / "corridor_depth.png", {}, truth_of(view.farness)};
}

/// From 0, near, to 65535, linear in the distance.
Brought relative_levels(const fs::path& folder) {
    const View view = view_of(Place::organ);
    cv::Mat levels;
    nearness_of(view.farness).convertTo(levels, CV_16U, -65535.0, 65535.0);
    save(folder / "tunnel_depth.png", levels);
    return {folder / "tunnel_depth.png", {}, truth_of(view.farness)};
}

Brought sparse_levels(const fs::path& folder) {
    const View view = view_of(Place::street);
    const cv::Mat seen = thinned(view.farness, 0.05);
    save(folder / "lidar_depth.png", in_16_bits(seen, 256.0));
    Brought brought{folder / "lidar_depth.png", {}, truth_of(seen)};
    brought.truth.between = view.farness;
    return brought;
}

/// The words of a header, and numbers none of whose bytes is below 32.
Brought pfm_like_text(const fs::path& folder) {
    cv::Mat farness = view_of(Place::room).farness + 9.0;  // 10 to 14: bytes of 0x41
    for (int j = 0; j < farness.rows; ++j)
        for (int i = 0; i < farness.cols; ++i) {
            std::uint32_t bits = 0;
            std::memcpy(&bits, &farness.at<float>(j, i), sizeof bits);
            bits |= 0x00202020U;
            std::memcpy(&farness.at<float>(j, i), &bits, sizeof bits);
        }
    save_pfm(folder / "lidar_depth.pfm", farness);  // else 10 to 14 may be millimetres
    return {folder / "lidar_depth.pfm", {}, truth_of(farness)};
}

// Bytes of colours.

/// The bytes of real numbers as red, green, blue and opacity, the least first.
Brought float_bytes(const fs::path& folder) {
    const View view = view_of(Place::room);
    cv::Mat coded(kView, CV_8UC4);
    for (int j = 0; j < kView.height; ++j)
        for (int i = 0; i < kView.width; ++i) {
            std::array<std::uint8_t, 4> bytes{};
            std::memcpy(bytes.data(), &view.farness.at<float>(j, i), bytes.size());
            coded.at<cv::Vec4b>(j, i) = {bytes[2], bytes[1], bytes[0], bytes[3]};
        }
    save(folder / "depth_float32.png", coded);
    return {folder / "depth_float32.png", {}, truth_of(view.farness)};
}

/// Red has the upper byte of 16 bits, green the lower.
cv::Mat in_two_bytes(const cv::Mat& levels) {
    cv::Mat coded(levels.size(), CV_8UC3, cv::Scalar::all(0.0));
    for (int j = 0; j < levels.rows; ++j)
        for (int i = 0; i < levels.cols; ++i) {
            const int level = levels.at<std::uint16_t>(j, i);
            coded.at<cv::Vec3b>(j, i) = {0, static_cast<std::uint8_t>(level % 256),
                                         static_cast<std::uint8_t>(level / 256)};
        }
    return coded;
}

Brought two_bytes(const fs::path& folder) {
    const View view = view_of(Place::room);
    save(folder / "depth_rg.png", in_two_bytes(in_16_bits(view.farness, 5000.0)));
    return {folder / "depth_rg.png", {}, truth_of(view.farness)};
}

Brought video_of_two_bytes(const fs::path& folder) {
    const Film film = film_of(Place::room, 12);
    const Pictures coded = each(film.farness, [](const cv::Mat& farness) {
        return in_two_bytes(in_16_bits(farness, 5000.0));
    });
    save_video(folder / "depth_rg.mp4",
               {{coded, 30.0, "-c:v libx264rgb -qp:v 0 -pix_fmt:v rgb24"}});
    Brought brought{folder / "depth_rg.mp4", {}, truth_of(film)};
    brought.truth.colour.clear();
    brought.truth.times_s = even_times(film.farness.size(), 30.0);
    return brought;
}

// Programs that draw.

Brought blender_layers(const fs::path& folder) {
    const View view = view_of(Place::street);
    Pictures channels;
    cv::split(view.colour, channels);
    for (cv::Mat& channel : channels) channel.convertTo(channel, CV_32F, 1.0 / 255.0);
    save_exr(folder / "render0001.exr", {{"B", channels[0]},
                                         {"G", channels[1]},
                                         {"R", channels[2]},
                                         {"A", cv::Mat(kView, CV_32FC1, cv::Scalar(1.0))},
                                         {"Z", with_no_data_as(view.farness, 1e10)}});
    Brought brought =
        brought_of(folder / "render0001.exr", view.farness, view.colour, Knows::metric);
    brought.truth.sky = true;
    return brought;
}

Brought blender_depth(const fs::path& folder) {
    const View view = view_of(Place::street);
    save_exr(folder / "Depth0001.exr", {{"V", with_no_data_as(view.farness, 1e10)}});
    Brought brought{folder / "Depth0001.exr", {}, truth_of(view.farness)};
    brought.truth.sky = true;
    return brought;
}

/// Centimetres in three equal channels; the sky is the largest half.
Brought unreal(const fs::path& folder) {
    const View view = view_of(Place::street);
    const cv::Mat numbers = with_no_data_as(view.farness * 100.0, 65504.0);
    save_exr(folder / "SceneDepth.0001.exr", {{"R", numbers}, {"G", numbers}, {"B", numbers}});
    Brought brought{folder / "SceneDepth.0001.exr", {}, truth_of(view.farness)};
    brought.truth.sky = true;
    return brought;
}

/// Centimetres in the red channel alone, as Movie Render Queue writes them.
Brought unreal_film(const fs::path& folder) {
    const View view = view_of(Place::street);
    const std::string file = "Shot01_FinalImageMovieRenderQueue_WorldDepth.0001.exr";
    save_exr(folder / file, {{"R", with_no_data_as(view.farness * 100.0, 65504.0)}});
    Brought brought{folder / file, {}, truth_of(view.farness)};
    brought.truth.sky = true;
    return brought;
}

/// Of distances in metres.
Brought logarithm(const fs::path& folder) {
    const cv::Mat farness = view_of(Place::room).farness;
    cv::Mat values;
    cv::log(farness + 1.0, values);
    save_npy(folder / "log_depth.npy", values);
    return {folder / "log_depth.npy", {}, truth_of(values, Knows::shape, Measure::relative)};
}

/// Of a light field: 0 is where its views meet, in the middle of the scene.
Brought signed_disparity(const fs::path& folder) {
    const cv::Mat disparity = disparity_of(view_of(Place::room).farness, 6.0) - 3.0;
    save_pfm(folder / "gt_disp_lowres.pfm", disparity);
    return {
        folder / "gt_disp_lowres.pfm", {}, truth_of(-disparity, Knows::shape, Measure::relative)};
}

/// The depth buffer itself: 1 at the near plane, one over the distance.
Brought unity(const fs::path& folder) {
    const View view = view_of(Place::room);
    cv::Mat levels;
    disparity_of(view.farness, 0.8).convertTo(levels, CV_16U, 65535.0);
    save(folder / "CameraDepthTexture.png", levels);
    return {folder / "CameraDepthTexture.png", {}, truth_of(view.farness)};
}

}  // namespace

Forms forms_of_numbers() {
    Forms forms{{"holes as a border of zeros", constant_border},
                {"corridor in 16 bits", corridor_levels},
                {"0 to 65535, near is 0", relative_levels},
                {"LiDAR, 5 % of the pixels", sparse_levels},
                {"PFM whose bytes look like text", pfm_like_text},
                {"float32 in RGBA", float_bytes},
                {"16 bits in red and green", two_bytes},
                {"16 bits in red and green, video", video_of_two_bytes},
                {"Blender, layers", blender_layers},
                {"Blender, depth alone", blender_depth},
                {"Unreal", unreal},
                {"Unreal, Movie Render Queue", unreal_film},
                {"logarithm of depth", logarithm},
                {"disparities about a plane", signed_disparity},
                {"Unity", unity}};
    for (const char* const ending : {"npy", "npz", "tif", "pfm", "exr"})
        forms.push_back(holed_form(ending, 0.0, "0"));
    forms.push_back(holed_form("npy", -9999.0, "-9999"));
    forms.push_back(holed_form("exr", 1e10, "1e10"));
    forms.push_back(holed_form("npy", 100.0, "100"));
    forms.push_back(holed_form("tif", 0.001, "0.001"));
    return forms;
}

}  // namespace dibhr::test::zoo
