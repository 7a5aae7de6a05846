// Layouts of public data sets, as their readers and pages describe them.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/files/plain_text.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/zoo/zoo.hpp"

namespace dibhr::test::zoo {

namespace {

using Texts = std::map<std::string, std::string>;

/// The intrinsics of kView, as matrices and numbers write them.
const std::string kMatrix3 = "106.7 0 63.5\n0 106.7 47.5\n0 0 1\n";
const std::string kMatrix4 = "106.7 0 63.5 0\n0 106.7 47.5 0\n0 0 1 0\n0 0 0 1\n";

Brought with_texts(Brought brought, const Texts& texts) {
    for (const auto& text : texts) save_text(brought.place / text.first, text.second);
    return brought;
}

Form row_form(const std::string& name, const Rows& rows, const Texts& texts = {}) {
    return {name, [=](const fs::path& folder) { return with_texts(rows_in(folder, rows), texts); }};
}

/// A street's film, whose sky is far.
Brought sky_film(const fs::path& folder, const Film& film) {
    Brought brought{folder, {}, truth_of(film)};
    brought.truth.sky = true;
    return brought;
}

// Indoors.

Brought replica(const fs::path& folder) {
    save_text(folder / "cam_params.json",
              R"({"camera": {"w": 128, "h": 96, "fx": 106.7, "fy": 106.7, "cx": 63.5, "cy": 47.5,
                  "scale": 6553.5}})");
    return with_texts(rows_in(folder / "room0", {.colour = "results/frame######.jpg",
                                                 .depth = "results/depth######.png",
                                                 .levels_per_m = 6553.5}),
                      {{"traj.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"}});
}

Brought scenenet(const fs::path& folder) {
    const Brought brought =
        rows_in(folder, {.colour = "photo/#.jpg", .depth = "depth/#.png", .step = 25});
    for (int k = 0; k < kRowFrames; ++k)
        save(folder / numbered_name("instance/#.png", 25 * k),
             cv::Mat(kView, CV_16UC1, cv::Scalar(k)));
    return brought;
}

Brought scannet_plus_plus(const fs::path& folder) {
    return with_texts(
        rows_in(folder / "iphone",
                {.colour = "rgb/frame_######.jpg", .depth = "depth/frame_######.png", .step = 10}),
        {{"pose_intrinsic_imu.json", R"({"frame_000000": {"timestamp": 1.5}})"}});
}

/// Colour 13 ms after each depth, which is every 33 or 66 ms.
Brought stamped(const fs::path& folder, const Film& film, const std::string& colour,
                const std::string& depth, double levels_per_m, double begin_s) {
    Brought brought{folder, {}, truth_of(film, Knows::metric)};
    double at_s = 0.0;
    for (std::size_t k = 0; k < film.farness.size(); ++k) {
        save(folder / (depth + number_text(begin_s + at_s, 6) + ".png"),
             in_16_bits(film.farness[k], levels_per_m));
        save(folder / (colour + number_text(begin_s + at_s + 0.013, 6) + ".png"), film.colour[k]);
        brought.truth.times_s.push_back(at_s);
        brought.truth.colour_times_s.push_back(at_s + 0.013);
        at_s += k % 3 == 1 ? 0.066 : 0.033;
    }
    return brought;
}

/// The TUM benchmark's lists; Bonn's and others' are the same.
Brought tum(const fs::path& folder) {
    constexpr double kBegin_s = 1305031102.0;
    Brought brought = stamped(folder, film_of(Place::room, 12), "rgb/", "depth/", 5000.0, kBegin_s);
    const auto list = [&](const std::string& name, const std::vector<double>& times_s) {
        std::string lines = "# " + name + " images\n# timestamp filename\n";
        for (const double time_s : times_s) {
            const std::string stamp = number_text(kBegin_s + time_s, 6);
            lines += stamp + " " + name + "/" + stamp + ".png\n";
        }
        save_text(folder / (name + ".txt"), lines);
    };
    list("rgb", brought.truth.colour_times_s);
    list("depth", brought.truth.times_s);
    return brought;
}

Brought icl_nuim(const fs::path& folder) {
    Brought brought = rows_in(
        folder,
        {.colour = "rgb/#.png", .depth = "depth/#.png", .levels_per_m = 5000.0, .holes = false});
    std::string lines;
    for (int k = 0; k < kRowFrames; ++k) {
        const std::string number = std::to_string(k);
        lines += number + " depth/" + number + ".png " + number + " rgb/" + number + ".png\n";
    }
    return with_texts(std::move(brought), {{"associations.txt", lines}});
}

Brought arkit_scenes(const fs::path& folder) {
    const Brought brought = stamped(folder, film_of(Place::room, 8), "lowres_wide/41048190_",
                                    "lowres_depth/41048190_", 1000.0, 3414.233);
    for (const double time_s : brought.truth.times_s)
        save(folder / ("confidence/41048190_" + number_text(3414.233 + time_s, 6) + ".png"),
             cv::Mat(kView, CV_8UC1, cv::Scalar(2)));
    return brought;
}

/// 16 bits of each level in another order.
template <typename Change>
cv::Mat with_bits_changed(cv::Mat levels, const Change& change) {
    for (int j = 0; j < levels.rows; ++j)
        for (int i = 0; i < levels.cols; ++i) {
            auto& level = levels.at<std::uint16_t>(j, i);
            level = static_cast<std::uint16_t>(change(static_cast<int>(level)) & 0xffff);
        }
    return levels;
}

/// Millimetres in 16 bits, turned three to the left.
cv::Mat turned_levels(const cv::Mat& farness) {
    return with_bits_changed(in_16_bits(farness, 1000.0),
                             [](int level) { return level << 3 | level >> 13; });
}

Brought sun3d(const fs::path& folder) {
    const Film film = film_of(Place::room, kRowFrames);
    for (int k = 0; k < kRowFrames; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const std::string name = numbered_name("#######-", k + 1) +
                                 numbered_name("############", std::int64_t{33369} * k);
        save(folder / "depth" / (name + ".png"), turned_levels(film.farness[at]));
        save(folder / "image" / (name + ".jpg"), film.colour[at]);
    }
    return with_texts({folder, {}, truth_of(film, Knows::metric)},
                      {{"intrinsics.txt", kMatrix3}, {"extrinsics/20140.txt", "1 0 0 0\n"}});
}

/// The Kinect's raw disparities, whose bytes are swapped: 351.3 / (1092.5 - v) metres, as the
/// data set's toolbox has it.
Brought nyu_raw(const fs::path& folder) {
    const cv::Mat farness = with_hole(view_of(Place::room).farness);
    cv::Mat inverse;
    cv::divide(1.0, with_no_data_as(farness, 1.0), inverse);
    cv::Mat raw;
    inverse.convertTo(raw, CV_16U, -351.3, 1092.5);
    raw.setTo(2047, ~(farness == farness));
    const fs::path file = folder / "bedroom_0001/d-1294886360.208451-2996770081.pgm";
    save(file, with_bits_changed(raw, [](int level) { return level << 8 | level >> 8; }));
    return {file, {}, truth_of(farness, Knows::metric)};
}

Brought sun_rgbd(const fs::path& folder) {
    const View view = view_of(Place::room);
    const cv::Mat farness = with_hole(view.farness);
    const cv::Mat turned = turned_levels(farness);
    save(folder / "depth/0000103.png", turned);
    save(folder / "depth_bfx/0000103.png", turned);
    save(folder / "image/0000103.jpg", view.colour);
    return with_texts(brought_of(folder, farness, view.colour, Knows::metric),
                      {{"intrinsics.txt", kMatrix3},
                       {"extrinsics/20140808220511.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n"},
                       {"annotation2Dfinal/index.json", "{}"},
                       {"scene.txt", "office"}});
}

// Streets.

Brought kitti_completion(const fs::path& folder) {
    const View view = view_of(Place::street);
    const auto name = [](const std::string& kind) {
        return kind + "/2011_09_26_drive_0002_sync_" + kind + "_0000000005_image_02.png";
    };
    const cv::Mat seen = thinned(view.farness, 0.3);
    save(folder / name("image"), view.colour);
    save(folder / name("groundtruth_depth"), in_16_bits(seen, 256.0));
    save(folder / name("velodyne_raw"), in_16_bits(thinned(view.farness, 0.05), 256.0));
    Brought brought = brought_of(folder, seen, view.colour, Knows::metric);
    brought.truth.between = view.farness;
    return brought;
}

/// One file out of the data set's own folders.
Brought kitti_file(const fs::path& folder) {
    const View view = view_of(Place::street);
    const fs::path file = folder /
                          "train/2011_09_26_drive_0001_sync/proj_depth/groundtruth/image_02/"
                          "0000000005.png";
    const cv::Mat seen = thinned(view.farness, 0.3);
    save(file, in_16_bits(seen, 256.0));
    Brought brought{file, {}, truth_of(seen, Knows::metric)};
    brought.truth.between = view.farness;
    return brought;
}

/// Disparities x 256, 0 where there is none.
Brought kitti_stereo(const fs::path& folder) {
    const View view = view_of(Place::street);
    const fs::path file = folder / "training/disp_occ_0/000000_10.png";
    save(file, in_16_bits(disparity_of(view.farness, 120.0), 256.0));
    Brought brought{file, {}, truth_of(view.farness, Knows::shape)};
    brought.truth.sky = true;
    return brought;
}

/// Centimetres; the sky is farther than 655.35 m.
Brought virtual_kitti(const fs::path& folder) {
    Brought brought = rows_in(folder, {.colour = "frames/rgb/Camera_0/rgb_#####.jpg",
                                       .depth = "frames/depth/Camera_0/depth_#####.png",
                                       .levels_per_m = 100.0,
                                       .place = Place::street,
                                       .holes = false,
                                       .none = 65535});
    brought.place = folder / "frames/rgb/Camera_0";
    brought.depth = folder / "frames/depth/Camera_0";
    return brought;
}

/// Disparities of 16 bits: (level - 1) / 256, and 0 for none.
Brought cityscapes(const fs::path& folder) {
    const View view = view_of(Place::street);
    cv::Mat levels;
    disparity_of(view.farness, 120.0).convertTo(levels, CV_16U, 256.0, 1.0);
    levels.setTo(0, view.farness != view.farness);
    save(folder / "disparity/aachen_000000_000019_disparity.png", levels);
    save(folder / "leftImg8bit/aachen_000000_000019_leftImg8bit.png", view.colour);
    Brought brought = brought_of(folder / "leftImg8bit", view.farness, view.colour, Knows::shape);
    brought.depth = folder / "disparity";
    brought.truth.sky = true;
    return brought;
}

/// 24 bits, red the least, of 1000 m: carla.readthedocs.io, depth camera.
cv::Mat in_carla_colours(const cv::Mat& farness) {
    cv::Mat coded(farness.size(), CV_8UC3);
    const cv::Mat whole = with_no_data_as(farness, 1000.0);
    for (int j = 0; j < coded.rows; ++j)
        for (int i = 0; i < coded.cols; ++i) {
            const auto value = static_cast<std::uint32_t>(
                static_cast<double>(whole.at<float>(j, i)) / 1000.0 * 16777215.0);
            coded.at<cv::Vec3b>(j, i) = {static_cast<std::uint8_t>(value >> 16U),
                                         static_cast<std::uint8_t>((value >> 8U) & 255U),
                                         static_cast<std::uint8_t>(value & 255U)};
        }
    return coded;
}

Brought carla(const fs::path& folder) {
    const Film film = film_of(Place::street, kRowFrames);
    for (int k = 0; k < kRowFrames; ++k) {
        const auto at = static_cast<std::size_t>(k);
        save(folder / numbered_name("depth/########.png", 1200 + k),
             in_carla_colours(film.farness[at]));
        save(folder / numbered_name("rgb/########.png", 1200 + k), film.colour[at]);
    }
    return sky_film(folder, film);
}

// Arrays and float maps.

/// Depths of which a mask beside them says where they are measured; elsewhere 0.
Brought diode(const fs::path& folder) {
    const View view = view_of(Place::room);
    const cv::Mat farness = with_hole(view.farness);
    const std::string name = "00019_00183_indoors_000_010";
    cv::Mat mask;
    cv::Mat(farness == farness).convertTo(mask, CV_32F, 1.0 / 255.0);
    save(folder / (name + ".png"), view.colour);
    save_npy(folder / (name + "_depth.npy"), with_no_data_as(farness, 0.0), "(96, 128, 1)");
    save_npy(folder / (name + "_depth_mask.npy"), mask);
    return brought_of(folder, farness, view.colour);
}

/// Metres; the sky is at 10000.
Brought tartan_air(const fs::path& folder) {
    const Film film = film_of(Place::street, kRowFrames);
    for (int k = 0; k < kRowFrames; ++k) {
        const auto at = static_cast<std::size_t>(k);
        save(folder / numbered_name("image_left/######_left.png", k), film.colour[at]);
        save_npy(folder / numbered_name("depth_left/######_left_depth.npy", k),
                 with_no_data_as(film.farness[at], 10000.0));
    }
    return sky_film(folder, film);
}

/// Metres as the bytes of floats, written by OpenCV.
Brought tartan_air_2(const fs::path& folder) {
    const Film film = film_of(Place::room, kRowFrames);
    for (int k = 0; k < kRowFrames; ++k) {
        const auto at = static_cast<std::size_t>(k);
        save(folder / numbered_name("image_lcam_front/######_lcam_front.png", k), film.colour[at]);
        save(folder / numbered_name("depth_lcam_front/######_lcam_front_depth.png", k),
             in_bytes(film.farness[at], DepthCode::float32_bgra));
    }
    return {folder, {}, truth_of(film, Knows::metric)};
}

/// A simulated camera's range in 24 bits, red the highest.
Brought rl_bench(const fs::path& folder) {
    constexpr double kNear_m = 0.01;
    constexpr double kFar_m = 6.5;
    const View view = view_of(Place::room);
    const fs::path episode = folder / "episode0";
    save(episode / "front_rgb/0.png", view.colour);
    save(episode / "front_mask/0.png", cv::Mat(view.colour.size(), CV_8UC3, cv::Scalar(0, 0, 7)));
    const cv::Mat parts = (view.farness - kNear_m) / (kFar_m - kNear_m);
    save(episode / "front_depth/0.png", in_bytes(parts * 16777215.0, DepthCode::bgr24));
    return {episode / "front_depth/0.png", {}, truth_of(view.farness, Knows::shape)};
}

/// Millimetres, green the high byte and blue the low one.
Brought nyu_hand(const fs::path& folder) {
    const View view = view_of(Place::room);
    const cv::Mat farness = with_hole(view.farness);
    save(folder / "rgb_1_0000001.png", view.colour);
    save(folder / "depth_1_0000001.png", in_bytes(farness * 1000.0, DepthCode::gb16));
    return {folder / "depth_1_0000001.png", {}, truth_of(farness, Knows::metric)};
}

/// A picture of one number for each pixel, alone.
Form file_form(const std::string& name, const std::string& file, double levels_per_m, int none) {
    return {name, [=](const fs::path& folder) {
                const cv::Mat farness = with_hole(view_of(Place::room).farness);
                const fs::path place = folder / file;
                if (place.extension() == ".pfm")
                    save_pfm(place, with_no_data_as(farness * levels_per_m, none));
                else
                    save(place, in_16_bits(farness, levels_per_m, none));
                return Brought{place, {}, truth_of(farness, Knows::metric)};
            }};
}

Brought habitat(const fs::path& folder) {
    const View view = view_of(Place::room);
    save(folder / "rgb.png", view.colour);
    save_npy(folder / "depth.npy", view.farness, "(96, 128, 1)");
    return brought_of(folder, view.farness, view.colour);
}

/// Disparities in pixels, infinity where there is none; the distance is
/// baseline x focal length / (disparity + doffs).
Brought middlebury_2014(const fs::path& folder) {
    const View view = view_of(Place::room);
    const cv::Mat farness = with_hole(view.farness);
    cv::Mat disparity;
    cv::divide(0.193001 * 106.7, with_no_data_as(farness, 1.0), disparity);
    disparity -= 2.5;
    disparity.setTo(std::numeric_limits<double>::infinity(), ~(farness == farness));
    save_pfm(folder / "disp0.pfm", disparity);
    save_pfm(folder / "disp0-sd.pfm", cv::Mat(kView, CV_32FC1, cv::Scalar(0.2)));
    save(folder / "disp0-n.pgm", cv::Mat(kView, CV_8UC1, cv::Scalar(7)));
    save(folder / "im0.png", view.colour);
    save(folder / "im1.png", view_of(Place::room, 0.5).colour);
    return with_texts(brought_of(folder, farness, view.colour, Knows::metric),
                      {{"calib.txt",
                        "cam0=[106.7 0 63.5; 0 106.7 47.5; 0 0 1]\ndoffs=2.5\n"
                        "baseline=193.001\nwidth=128\nheight=96\nndisp=64\n"}});
}

Brought middlebury_2006(const fs::path& folder) {
    const View view = view_of(Place::room);
    const cv::Mat farness = with_hole(view.farness);
    cv::Mat levels;
    disparity_of(farness, 230.0).convertTo(levels, CV_8U);
    save(folder / "disp1.png", levels);
    save(folder / "view1.png", view.colour);
    return {folder / "disp1.png", {}, truth_of(farness, Knows::shape)};
}

/// Depths of a reconstruction, 0 where there is none.
Brought blended_mvs(const fs::path& folder) {
    const View view = view_of(Place::portrait);
    const cv::Mat farness = with_hole(view.farness);
    save_pfm(folder / "rendered_depth_maps/00000000.pfm", with_no_data_as(farness, 0.0));
    save(folder / "blended_images/00000000.jpg", view.colour);
    Brought brought = brought_of(folder / "blended_images", farness, view.colour, Knows::shape);
    brought.depth = folder / "rendered_depth_maps";
    return brought;
}

/// Metres along the ray; the sky is the largest number of half precision.
Brought airsim(const fs::path& folder) {
    const View view = view_of(Place::street);
    save_pfm(folder / "images/img_Drone1_DepthPerspective_1700000000.pfm",
             with_no_data_as(view.farness, 65504.0));
    Brought brought{
        folder / "images/img_Drone1_DepthPerspective_1700000000.pfm", {}, truth_of(view.farness)};
    brought.truth.sky = true;
    return brought;
}

/// HDF5, and MATLAB's container of it, whose own header is before it.
Brought hdf5(const fs::path& folder, const std::string& name, const std::string& before) {
    std::string bytes = before;
    if (!before.empty()) bytes.resize(512, ' ');
    save_text(folder / name, bytes + std::string("\x89HDF\r\n\x1a\n", 8) + std::string(4000, '\0'));
    Brought brought{folder / name, {}, {}};
    brought.truth.refused_as = before.empty() ? "HDF5" : "MATLAB";
    return brought;
}

// Inside the body.

Brought c3vd(const fs::path& folder) {
    const Brought brought = rows_in(folder, {.colour = "####_color.png",
                                             .depth = "####_depth.tiff",
                                             .levels_per_m = 655350.0,
                                             .place = Place::organ,
                                             .holes = false});
    for (int k = 0; k < kRowFrames; ++k) {
        save(folder / numbered_name("####_normals.tiff", k),
             cv::Mat(kView, CV_16UC3, cv::Scalar::all(40000)));
        save(folder / numbered_name("####_occlusion.png", k),
             cv::Mat(kView, CV_8UC1, cv::Scalar(255)));
    }
    return brought;
}

/// 8 bits, far is bright.
Brought endoslam(const fs::path& folder) {
    const Film film = film_of(Place::organ, kRowFrames);
    for (int k = 0; k < kRowFrames; ++k) {
        const auto at = static_cast<std::size_t>(k);
        save(folder / numbered_name("Frames/image_####.png", k), film.colour[at]);
        save(folder / numbered_name("Pixelwise Depths/aov_image_####.png", k),
             in_8_bits(film.farness[at] * 10.0));
    }
    return {folder, {}, truth_of(film)};
}

/// Points: x, y and the distance z in millimetres; not a number where there is none.
cv::Mat points_of(const cv::Mat& farness) {
    cv::Mat points(kView, CV_32FC3);
    for (int j = 0; j < kView.height; ++j)
        for (int i = 0; i < kView.width; ++i) {
            const float z = 1000.0F * farness.at<float>(j, i);
            points.at<cv::Vec3f>(j, i) = {z, z * (static_cast<float>(j) - 47.5F) / 106.7F,
                                          z * (static_cast<float>(i) - 63.5F) / 106.7F};
        }
    return points;
}

Brought scared(const fs::path& folder) {
    const View view = view_of(Place::organ);
    const cv::Mat farness = with_hole(view.farness);
    // OpenCV would keep the logarithms of colours.
    cv::imwrite((folder / "left_depth_map.tiff").string(), points_of(farness),
                {cv::IMWRITE_TIFF_COMPRESSION, 1});
    save(folder / "Left_Image.png", view.colour);
    return brought_of(folder, farness, view.colour, Knows::metric);
}

}  // namespace

Forms forms_of_datasets() {
    return {
        row_form("ScanNet", {.colour = "color/#.jpg", .depth = "depth/#.png"},
                 {{"intrinsic/intrinsic_depth.txt", kMatrix4}}),
        {"ScanNet++", scannet_plus_plus},
        row_form(
            "7-Scenes",
            {.colour = "frame-######.color.png", .depth = "frame-######.depth.png", .none = 65535}),
        row_form("tsdf-fusion",
                 {.colour = "frame-######.color.jpg", .depth = "frame-######.depth.png"},
                 {{"camera-intrinsics.txt", kMatrix3}}),
        row_form("Open3D", {.colour = "color/#####.jpg", .depth = "depth/#####.png"},
                 {{"camera_intrinsic.json",
                   R"({"width": 128, "height": 96, "depth_scale": 1000.0,
                       "intrinsic_matrix": [106.7, 0, 0, 0, 106.7, 0, 63.5, 47.5, 1]})"}}),
        row_form("NYUv2",
                 {.colour = "rgb_#####.jpg", .depth = "sync_depth_#####.png", .first = 45}),
        {"NYUv2, labelled (.mat)",
         [](const fs::path& folder) {
             return hdf5(folder, "nyu_depth_v2_labeled.mat",
                         "MATLAB 7.3 MAT-file, Platform: GLNXA64, HDF5 schema 1.00 .");
         }},
        {"Hypersim (.hdf5)",
         [](const fs::path& folder) { return hdf5(folder, "frame.0000.depth_meters.hdf5", ""); }},
        {"Replica", replica},
        {"SceneNet RGB-D", scenenet},
        {"ARKitScenes", arkit_scenes},
        {"TUM RGB-D", tum},
        {"ICL-NUIM", icl_nuim},
        row_form("rgb/ and depth/ of 5000 levels a metre", {.colour = "rgb/####.png",
                                                            .depth = "depth/####.png",
                                                            .levels_per_m = 5000.0,
                                                            .place = Place::corridor,
                                                            .knows = Knows::order,
                                                            .holes = false}),
        {"SUN RGB-D", sun_rgbd},
        {"SUN3D", sun3d},
        {"NYUv2, raw", nyu_raw},
        file_form("Taskonomy", "point_7_view_2_domain_depth_zbuffer.png", 512.0, 65535),
        file_form("DTU", "depths/scan9/depth_map_0007.pfm", 1000.0, 0),
        row_form("Matterport3D", {.colour = "undistorted_color_images/7812#_i0_0.jpg",
                                  .depth = "undistorted_depth_images/7812#_d0_0.png",
                                  .levels_per_m = 4000.0,
                                  .knows = Knows::metric}),
        row_form(
            "YCB-Video",
            {.colour = "######-color.jpg", .depth = "######-depth.png", .levels_per_m = 10000.0},
            {{"000000-box.txt", "002_master_chef_can 10 10 60 60\n"}}),
        row_form("BOP",
                 {.colour = "rgb/######.png", .depth = "depth/######.png", .levels_per_m = 10000.0},
                 {{"scene_camera.json",
                   R"({"0": {"cam_K": [106.7, 0, 63.5, 0, 106.7, 47.5, 0, 0, 1],
                       "depth_scale": 0.1}})"}}),
        {"KITTI depth completion", kitti_completion},
        {"KITTI depth completion, one file", kitti_file},
        {"KITTI stereo", kitti_stereo},
        {"Virtual KITTI 2", virtual_kitti},
        {"Cityscapes disparity", cityscapes},
        {"CARLA", carla},
        {"DIODE", diode},
        {"TartanAir", tartan_air},
        {"TartanAir V2", tartan_air_2},
        {"RLBench", rl_bench},
        {"NYU Hand", nyu_hand},
        {"Habitat", habitat},
        {"Middlebury 2014", middlebury_2014},
        {"Middlebury 2006", middlebury_2006},
        {"BlendedMVS", blended_mvs},
        {"AirSim", airsim},
        {"C3VD", c3vd},
        {"EndoSLAM", endoslam},
        // 20 cm x level / 256 / 255: visualize_3D_data.py of its authors.
        row_form("SimCol3D", {.colour = "FrameBuffer_####.png",
                              .depth = "Depth_####.png",
                              .levels_per_m = 326400.0,
                              .place = Place::organ,
                              .knows = Knows::order,
                              .holes = false}),
        row_form("Hamlyn", {.colour = "image01/##########.jpg",
                            .depth = "depth01/##########.png",
                            .place = Place::organ,
                            .size = 5.0}),  // it is in whole millimetres
        row_form("C3VD v2", {.colour = "rgb/####.png",
                             .depth = "depth/####_depth.tiff",
                             .levels_per_m = 655350.0,
                             .place = Place::organ,
                             .holes = false}),
        {"SCARED", scared}};
}

}  // namespace dibhr::test::zoo
