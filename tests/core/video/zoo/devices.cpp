// What cameras, phones and their programs write.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/files/plain_text.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/zoo/zoo.hpp"

namespace dibhr::test::zoo {

namespace {

/// A film as frames at equal times.
Brought timed_film(const fs::path& place, const Film& film, Knows knows, double frames_per_s) {
    Brought brought{place, {}, truth_of(film, knows)};
    brought.truth.times_s = even_times(film.farness.size(), frames_per_s);
    brought.truth.colour_times_s = even_times(film.colour.size(), frames_per_s);
    return brought;
}

/// A file that only its maker's library reads: its beginning, and then zeros.
Form foreign_form(const std::string& name, const std::string& file, const std::string& begins,
                  const std::string& refused_as) {
    return {name, [=](const fs::path& folder) {
                save_text(folder / file, begins + std::string(4000, '\0'));
                Brought brought{folder / file, {}, {}};
                brought.truth.refused_as = refused_as;
                return brought;
            }};
}

cv::Mat in_mm(const cv::Mat& farness) {
    return in_16_bits(farness, 1000.0);
}

// Phones.

Brought stray_scanner(const fs::path& folder) {
    constexpr double kRate = 60.0;
    const Film film = film_of(Place::room, 24);
    std::string odometry = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";
    for (std::size_t k = 0; k < film.farness.size(); ++k) {
        const auto number = static_cast<int>(k);
        save(folder / numbered_name("depth/######.png", number), in_mm(film.farness[k]));
        save(folder / numbered_name("confidence/######.png", number),
             cv::Mat(kView, CV_8UC1, cv::Scalar(2)));
        odometry += number_text(1000.0 + number / kRate, 6) + ", " +
                    numbered_name("######", number) + ", 0, 0, 0, 0, 0, 0, 1\n";
    }
    save_video(folder / "rgb.mp4", {{film.colour, kRate, kGoodH264}});
    save_text(folder / "odometry.csv", odometry);
    save_text(folder / "camera_matrix.csv", "106.7, 0.0, 63.5\n0.0, 106.7, 47.5\n0.0, 0.0, 1.0\n");
    return timed_film(folder, film, Knows::metric, kRate);
}

Brought polycam(const fs::path& folder) {
    const Film film = film_of(Place::room, kRowFrames);
    for (std::size_t k = 0; k < film.farness.size(); ++k) {
        const std::string stamp =
            std::to_string(94562000000 + 250000 * static_cast<std::int64_t>(k));
        save(folder / ("keyframes/depth/" + stamp + ".png"), in_mm(film.farness[k]));
        save(folder / ("keyframes/images/" + stamp + ".jpg"), film.colour[k]);
        save(folder / ("keyframes/confidence/" + stamp + ".png"),
             cv::Mat(kView, CV_8UC1, cv::Scalar(255)));
        save_text(
            folder / ("keyframes/cameras/" + stamp + ".json"),
            R"({"fx": 106.7, "fy": 106.7, "cx": 63.5, "cy": 47.5, "width": 128, "height": 96})");
    }
    save_text(folder / "mesh_info.json", "{}");
    save(folder / "thumbnail.jpg", film.colour.front());
    return {folder, {}, truth_of(film, Knows::metric)};
}

Brought scanner_app(const fs::path& folder) {
    Brought brought =
        rows_in(folder, {.colour = "frame_#####.jpg", .depth = "depth_#####.png", .holes = false});
    for (int k = 0; k < kRowFrames; ++k) {
        save(folder / numbered_name("conf_#####.png", k), cv::Mat(kView, CV_8UC1, cv::Scalar(2)));
        save_text(folder / numbered_name("frame_#####.json", k),
                  R"({"time": )" + number_text(500.0 + 0.1 * k, 3) +
                      R"(, "intrinsics": [106.7, 0, 63.5, 0, 106.7, 47.5, 0, 0, 1]})");
    }
    brought.truth.times_s = even_times(kRowFrames, 10.0);
    brought.truth.colour_times_s = brought.truth.times_s;
    save(folder / "thumb_00000.jpg", brought.truth.colour.front());
    return brought;
}

Brought record3d_pictures(const fs::path& folder) {
    const Film film = film_of(Place::room, kRowFrames);
    for (std::size_t k = 0; k < film.farness.size(); ++k) {
        const auto number = static_cast<int>(k);
        save_exr(folder / numbered_name("depth/#.exr", number), {{"R", film.farness[k]}});
        save(folder / numbered_name("rgb/#.jpg", number), film.colour[k]);
    }
    save_text(folder / "metadata.json", R"({"w": 128, "h": 96, "fps": 30})");
    return {folder, {}, truth_of(film)};
}

/// Hues of 3 m at the left, and the metadata in the file.
Brought record3d_video(const fs::path& folder) {
    const Film film = film_of(Place::portrait, 12);
    Pictures packed;
    for (std::size_t k = 0; k < film.farness.size(); ++k)
        packed.push_back(beside(painted(film.farness[k] / 3.0, as_hue), film.colour[k]));
    save_video(folder / "record3d.mp4",
               {{packed, 30.0, "-c:v libx264 -crf:v 6 -pix_fmt:v yuv444p"}},
               R"(-metadata comment='{"intrinsicMatrix":[106.7,0,0,0,106.7,0,63.5,47.5,1]}')");
    return timed_film(folder / "record3d.mp4", film, Knows::metric, 30.0);
}

Brought record3d_archive(const fs::path& folder) {
    zip_of("rgbd/0.depth", "bvx2" + std::string(2000, 'x'))(folder / "scan.r3d");
    Brought brought{folder / "scan.r3d", {}, {}};
    brought.truth.refused_as = "Record3D";
    return brought;
}

Brought iphone_heic(const fs::path& folder) {
    const View view = view_of(Place::portrait);
    cv::Mat levels;
    disparity_of(view.farness, 250.0).convertTo(levels, CV_8U);
    save_heic(folder / "IMG_0041.heic", view.colour, levels);
    return brought_of(folder / "IMG_0041.heic", view.farness, view.colour);
}

Brought iphone_jpeg(const fs::path& folder) {
    const View view = view_of(Place::portrait);
    cv::Mat levels;
    disparity_of(view.farness, 250.0).convertTo(levels, CV_8U);
    save_multi_picture(folder / "IMG_0042.jpg", view.colour, levels);
    return brought_of(folder / "IMG_0042.jpg", view.farness, view.colour);
}

/// Levels linear in one over the distance, between two that the photo states; 0 is near.
Brought android_jpeg(const fs::path& folder) {
    const View view = view_of(Place::portrait);
    constexpr double kNear_m = 0.5;
    constexpr double kFar_m = 3.5;
    cv::Mat inverse;
    cv::divide(1.0, view.farness, inverse);
    cv::Mat levels;
    const double span = 1.0 / kNear_m - 1.0 / kFar_m;
    inverse.convertTo(levels, CV_8U, -255.0 / span, 255.0 / kNear_m / span);
    save_gdepth(folder / "PXL_0043.jpg", view.colour, levels, kNear_m, kFar_m);
    return brought_of(folder / "PXL_0043.jpg", view.farness, view.colour);
}

/// Millimetres below a confidence in three bits; `name` may say so.
Form android_depth16(const std::string& name) {
    return {"Android DEPTH16, " + name, [=](const fs::path& folder) {
                const cv::Mat farness = with_hole(view_of(Place::room).farness);
                save(folder / name, below_confidence(in_mm(farness)));
                return Brought{folder / name, {}, truth_of(farness, Knows::metric)};
            }};
}

// Depth cameras.

/// 11 bits of disparity, 2047 for none: openkinect.org, imaging information.
Brought kinect_raw(const fs::path& folder) {
    const cv::Mat farness = with_hole(view_of(Place::room).farness);
    cv::Mat inverse;
    cv::divide(1.0, with_no_data_as(farness, 1.0), inverse);
    cv::Mat raw;
    inverse.convertTo(raw, CV_16U, -1.0 / 0.0030711016, 3.3309495161 / 0.0030711016);
    raw.setTo(2047, ~(farness == farness));
    save(folder / "depth_raw.png", raw);
    return {folder / "depth_raw.png", {}, truth_of(farness)};
}

/// Most of the pictures is without data.
Brought kinect_v2(const fs::path& folder) {
    const View view = view_of(Place::room);
    cv::Mat farness = with_hole(view.farness);
    farness(cv::Rect(0, 0, 20, kView.height)).setTo(std::nan(""));
    farness(cv::Rect(kView.width - 40, 0, 40, 60)).setTo(std::nan(""));
    save(folder / "kinect2_depth.png", in_mm(farness));
    save(folder / "kinect2_color.png", view.colour);
    return brought_of(folder, farness, view.colour, Knows::metric);
}

/// A picture painted for the eye, and the numbers beside it.
Brought realsense_snapshot(const fs::path& folder) {
    const View view = view_of(Place::room);
    const cv::Mat farness = with_hole(view.farness);
    cv::Mat jet;
    cv::applyColorMap(in_8_bits(nearness_of(farness)), jet, cv::COLORMAP_JET);
    save(folder / "snap_Depth.png", jet);
    save(folder / "snap_Color.png", view.colour);
    save_text(folder / "snap_Depth.raw", bytes_of(in_mm(farness)));
    save_text(folder / "snap_Depth_metadata.csv",
              "Stream,Depth\nFormat,Z16\nResolution x,128\nResolution y,96\nBytes per pix,2\n"
              "Depth units,0.001\n");
    return brought_of(folder, farness, view.colour, Knows::metric);
}

/// Hues from 0.3 to 5.2 m, black for none.
Brought realsense_hues(const fs::path& folder) {
    const cv::Mat farness = with_hole(view_of(Place::room).farness);
    save(folder / "frame_depth.png", painted((farness - 0.3) / 4.9, as_hue));
    return {folder / "frame_depth.png", {}, truth_of(farness)};
}

std::vector<BagMessage> bag_messages(const Film& film) {
    std::vector<BagMessage> messages;
    double at_s = 1700000000.0;
    for (std::size_t k = 0; k < film.farness.size(); ++k, at_s += k % 2 == 0 ? 0.1 : 0.05) {
        messages.push_back(
            image_message("/camera/depth/image_rect_raw", at_s, "16UC1", in_mm(film.farness[k])));
        messages.push_back(
            image_message("/camera/color/image_raw", at_s + 0.01, "bgr8", film.colour[k]));
    }
    return messages;
}

Brought ros_recording(const fs::path& file) {
    const Film film = film_of(Place::room, 10);
    const std::vector<BagMessage> messages = bag_messages(film);
    save_bag(file, messages);
    Brought brought{file, {}, truth_of(film, Knows::metric)};
    for (std::size_t k = 0; k < messages.size(); ++k) {
        std::vector<double>& times_s =
            k % 2 == 0 ? brought.truth.times_s : brought.truth.colour_times_s;
        times_s.push_back(messages[k].time_s - messages.front().time_s);
    }
    return brought;
}

Brought azure_kinect(const fs::path& folder) {
    const Film film = film_of(Place::room, 12);
    save_video(folder / "take.mkv",
               {{film.colour, 15.0, "-c:v mjpeg -q:v 2 -pix_fmt:v yuvj422p"},
                {each(film.farness, in_mm), 15.0, kGrey16}},
               "-metadata:s:v:0 title=COLOR -metadata:s:v:1 title=DEPTH "
               "-metadata:s:v:1 K4A_DEPTH_MODE=NFOV_UNBINNED");
    return timed_film(folder / "take.mkv", film, Knows::metric, 15.0);
}

/// Colour above, hues below, between two clips that a text beside it states.
Brought depthkit(const fs::path& folder, const std::string& metadata) {
    const Film film = film_of(Place::portrait, 12);
    Pictures packed;
    for (std::size_t k = 0; k < film.farness.size(); ++k)
        packed.push_back(above(film.colour[k], painted((film.farness[k] - 0.5) / 3.0, as_hue)));
    save_video(folder / "take.mp4", {{packed, 30.0, "-c:v libx264 -crf:v 6 -pix_fmt:v yuv444p"}});
    save_text(folder / metadata,
              R"({"_versionMajor": 0, "format": "perpixel", "depthImageSize": {"x": 128, "y": 96},
                  "depthPrincipalPoint": {"x": 63.5, "y": 47.5},
                  "depthFocalLength": {"x": 106.7, "y": 106.7}, "farClip": 3.5, "nearClip": 0.5,
                  "crop": {"x": 0, "y": 0, "z": 1, "w": 1}})");
    return timed_film(folder / "take.mp4", film, Knows::metric, 30.0);
}

/// A row a laser, in units of 4 mm, as Ouster's driver writes range images.
Brought spinning_lidar(const fs::path& folder) {
    const View view = view_of(Place::street, 0.3, {512, 64});
    save(folder / "range.png", in_16_bits(view.farness, 250.0));
    Brought brought{folder / "range.png", {}, truth_of(view.farness, Knows::metric)};
    brought.truth.sky = true;
    return brought;
}

/// A thumbnail beside the recording.
Brought with_thumbnail(const fs::path& folder) {
    Brought brought = azure_kinect(folder);
    save(folder / "thumbnail.png", brought.truth.colour.front());
    brought.place = folder;
    return brought;
}

Form rows_of_camera(const std::string& name, const Rows& rows) {
    return {name, [=](const fs::path& folder) { return rows_in(folder, rows); }};
}

}  // namespace

Forms forms_of_devices() {
    return {
        {"Stray Scanner", stray_scanner},
        {"Polycam", polycam},
        {"3D scanner app", scanner_app},
        {"Record3D, EXR and JPEG", record3d_pictures},
        {"Record3D, video", record3d_video},
        {"Record3D, archive (.r3d)", record3d_archive},
        {"iPhone portrait, HEIC", iphone_heic},
        {"iPhone portrait, JPEG", iphone_jpeg},
        {"Android portrait, GDepth", android_jpeg},
        android_depth16("depth16_000123.png"),
        android_depth16("scan_depth.png"),
        {"Kinect v1, raw disparity", kinect_raw},
        {"Kinect v2", kinect_v2},
        {"RealSense, snapshot", realsense_snapshot},
        {"RealSense, hues", realsense_hues},
        foreign_form("RealSense, bag of ROS 1", "take.bag", "#ROSBAG V2.0\n", "ROS 1"),
        foreign_form("ZED, .svo", "take.svo", "SVO2", "ZED"),
        rows_of_camera("ZED, pictures", {.colour = "left######.png", .depth = "depth######.png"}),
        rows_of_camera("Orbbec", {.colour = "Color/Color_#.png", .depth = "Depth/Depth_#.png"}),
        {"ROS 2 bag, SQLite",
         [](const fs::path& folder) { return ros_recording(folder / "walk.db3"); }},
        {"ROS 2 bag, MCAP",
         [](const fs::path& folder) { return ros_recording(folder / "walk.mcap"); }},
        {"Azure Kinect", azure_kinect},
        {"recording beside its thumbnail", with_thumbnail},
        {"Depthkit", [](const fs::path& folder) { return depthkit(folder, "take_meta.txt"); }},
        {"Depthkit, text of the same name",
         [](const fs::path& folder) { return depthkit(folder, "take.txt"); }},
        {"spinning LiDAR, 4 mm", spinning_lidar}};
}

}  // namespace dibhr::test::zoo
