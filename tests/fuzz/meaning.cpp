// What datasets and recorders write beside their pictures, or people do: which pictures belong
// together, what their levels mean, and through which cameras they were seen. Whatever it says,
// there are frames that can be touched, or one line.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "core/files/names.hpp"
#include "core/video/depth/colour_registration.hpp"
#include "core/video/formats/bags/ros_messages.hpp"
#include "core/video/formats/camera_files.hpp"
#include "core/video/sources/depth_finding.hpp"
#include "core/video/sources/layouts/layouts.hpp"
#include "core/video/sources/packed.hpp"
#include "core/video/sources/paired_media.hpp"
#include "core/video/sources/recorder_metadata.hpp"
#include "core/video/sources/sidecar.hpp"
#include "core/video/sources/sources.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/frames.hpp"

using namespace dibhr;

namespace {

namespace fs = std::filesystem;

const DepthRequest kAsFound{.find_out = true};

void write(const fs::path& file, std::string_view bytes) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
}

/// 12 x 8 levels of 16 bits, a slope with a step in it and a hole.
std::string depth_picture() {
    std::string bytes = "P5 12 8 65535\n";
    for (int k = 0; k < 12 * 8; ++k) {
        const int level = k % 12 == 5 ? 0 : k % 12 < 5 ? 600 + k : 3000 + 7 * k;
        bytes += {static_cast<char>(level / 256), static_cast<char>(level % 256)};
    }
    return bytes;
}

/// 12 x 8 real numbers, some of them none.
std::string real_picture() {
    const std::array<float, 6> numbers{0.5F, 0.75F, NAN, 1.5F, INFINITY, 0.0F};
    std::string bytes = "Pf\n12 8\n-1\n";
    for (std::size_t k = 0; k < 12 * 8; ++k) {
        const float number = numbers[k % numbers.size()] + 0.01F * static_cast<float>(k);
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    return bytes;
}

/// 12 x 8 pixels of all hues.
std::string colour_picture() {
    std::string bytes = "P6 12 8 255\n";
    for (int k = 0; k < 12 * 8; ++k)
        bytes += {static_cast<char>(255 - 2 * k), static_cast<char>(5 * k), '\0'};
    return bytes;
}

/// A pair of files, depth of real numbers, and names for patterns.
const test::TemporaryFolder& pictures() {
    static const auto folder = [] {
        auto made = std::make_unique<test::TemporaryFolder>();
        for (const char* const name : {"whole.pgm", "depth_01.pgm", "depth_2.pgm", "depth/1.pgm"})
            write(*made / name, depth_picture());
        write(*made / "whole.ppm", colour_picture());
        write(*made / "real.pfm", real_picture());
        return made;
    }();
    return *folder;
}

/// Beside a pair of files, and beside depth of real numbers.
void look_at_sidecar(const std::string& text) {
    const bool is_taken = test::is_taken([&text] {
        const DepthStatement said = statement_in(text, "a sidecar");
        test::require_rule(statement_in(toml_of(said), "its own") == said,
                           "what was understood comes back the same");
    });
    if (!is_taken) return;
    const test::TemporaryFolder& folder = pictures();
    write(folder / "whole.toml", text);
    write(folder / "real.toml", text);
    (void)test::is_taken([&folder] {
        test::require_frames(open_media(folder / "whole.ppm", folder / "whole.pgm", kAsFound));
    });
    (void)test::is_taken(
        [&folder] { test::require_frames(open_media({}, folder / "real.pfm", kAsFound)); });
}

/// Pictures as datasets lay them out, and that file with them.
void lay_out(const test::TemporaryFolder& folder, const char* name, const std::string& text) {
    write(folder / "depth/1.pgm", depth_picture());
    write(folder / "color/1.ppm", colour_picture());
    write(folder / name, text);
}

/// A folder with a camera's file; its pictures seen straight on, too.
void look_at_camera(const test::TemporaryFolder& folder) {
    for (const Geometry geometry : {Geometry::relief, Geometry::true_shape}) {
        DepthRequest request = kAsFound;
        request.command_line.geometry = geometry;
        (void)test::is_taken([&] { test::require_frames(open_media(folder.path(), {}, request)); });
    }
}

void look_at_matrix(const std::string& text) {
    const test::TemporaryFolder folder;
    lay_out(folder, "intrinsic/intrinsic_depth.txt", text);
    look_at_camera(folder);
}

void look_at_open3d(const std::string& text) {
    const test::TemporaryFolder folder;
    lay_out(folder, "camera_intrinsic.json", text);
    look_at_camera(folder);
}

/// As ARKitScenes has it.
void look_at_pincam(const std::string& text) {
    const test::TemporaryFolder folder;
    write(folder / "lowres_depth/1.pgm", depth_picture());
    write(folder / "lowres_wide/1.ppm", colour_picture());
    write(folder / "lowres_wide_intrinsics/1.pincam", text);
    look_at_camera(folder);
}

/// TUM's list of depth, or of both.
void look_at_list(const std::string& text) {
    for (const char* const name : {"depth.txt", "associations.txt"}) {
        const test::TemporaryFolder folder;
        lay_out(folder, name, text);
        (void)test::is_taken(
            [&] { test::require_frames(open_media(folder.path(), {}, kAsFound)); });
        (void)test::is_taken([&] { test::require_frames(open_depth(folder.path(), kAsFound)); });
    }
}

/// Stamps of pictures, as text and as JSON.
void look_at_stamps(const std::string& text) {
    for (const char* const name : {"depth/timestamps.txt", "frames.json"}) {
        const test::TemporaryFolder folder;
        for (const char* const picture : {"depth/1.pgm", "depth/2.pgm", "depth/3.pgm"})
            write(folder / picture, depth_picture());
        write(folder / name, text);
        (void)test::is_taken([&] { test::require_frames(open_depth(folder / "depth", kAsFound)); });
    }
}

void look_at_pattern(const std::string& text) {
    const fs::path place = pictures() / text;
    if (!names_pictures(place) || is_folder(place)) return;
    (void)test::is_taken([&place] { test::require_frames(open_depth(place, kAsFound)); });
}

void require_registered(const CameraPair& cameras) {
    cv::Mat depth_mm(6, 8, CV_32FC1, cv::Scalar(1000.0));
    depth_mm.at<float>(2, 3) = NAN;
    depth_mm.at<float>(4, 4) = 400.0F;
    const cv::Mat colour(9, 16, CV_8UC3, cv::Scalar(10, 20, 30));
    ColourRegistration registration(depth_mm.size(), cameras, 2000.0);
    const cv::Mat seen = registration.seen_from_depth(depth_mm, colour);
    test::require_rule(seen.type() == CV_8UC3 &&
                           (seen.size() == depth_mm.size() || seen.size() == depth_mm.size() * 2),
                       "the colour is seen as fine as the depth, or twice");
}

/// A ray and a pixel are numbers, or not known.
void require_camera(const CameraModel& camera) {
    test::require_rule(is_camera(camera.intrinsics()), "a camera is one");
    const Rays rays = rays_of({8, 6}, camera);
    for (const cv::Mat* const part : {&rays.right, &rays.down})
        test::require_rule(cv::countNonZero(cv::abs(*part) == INFINITY) == 0, "a ray is finite");
    for (const cv::Point2d ray : {cv::Point2d(0.0, 0.0), cv::Point2d(0.5, -0.25)}) {
        const cv::Point2d pixel = camera.pixel_of(ray);
        test::require_rule(!std::isinf(pixel.x) && !std::isinf(pixel.y), "a pixel is finite");
    }
}

void look_at_kinect(const std::string& text) {
    for (const cv::Size mode : {cv::Size(640, 576), cv::Size(512, 512)}) {
        if (const auto camera = azure_kinect_depth_camera(text, mode)) require_camera(*camera);
        const auto cameras = azure_kinect_cameras(text, mode);
        if (!cameras) continue;
        require_camera(cameras->colour);
        require_registered(*cameras);
    }
}

Bytes bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void look_at_message(const std::string& text) {
    const Bytes message = bytes_of(text);
    (void)ros_stamp_ns(message);
    for (const bool compressed : {false, true}) {
        const auto image = ros_image(message, compressed);
        if (!image) continue;
        (void)kind_of(*image);
        const cv::Mat picture = picture_of(*image);
        test::require_rule(picture.empty() || picture.depth() == CV_8U ||
                               picture.depth() == CV_16U || picture.depth() == CV_32F,
                           "a picture is of levels");
    }
    if (const auto found = ros_camera(message)) {
        require_camera(found->camera);
        if (!found->size.empty())
            require_registered({found->camera, found->camera, found->size, {}, "itself"});
    }
    if (const auto placement = ros_placement(message))
        require_registered({CameraModel({10.0, 10.0, 4.0, 3.0}),
                            CameraModel({20.0, 20.0, 8.0, 4.0}),
                            {16, 9},
                            *placement,
                            "a message"});
}

/// A packed picture of hues as that metadata says.
void look_at_packed(const fs::path& video) {
    static const test::InputFile picture("packed.ppm");
    static const std::string bytes = colour_picture();
    const auto form = form_by_recorder(video, {12, 8});
    if (!form) return;
    const auto& known = form->finding.statement.intrinsics;
    test::require_rule(!known || is_camera(*known), "a recorder's camera is one");
    static const fs::path packed =
        picture.with({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    (void)test::is_taken([&form] {
        Sources sources = open_packed(packed, *form);
        DepthScale scale = find_scale(sources, kAsFound).scale;
        test::require_frames(std::make_unique<PairedMedia>(
            std::move(sources.depth), std::move(sources.colour), std::move(scale)));
    });
}

void look_at_metadata(const char* name, const std::string& text) {
    static const test::TemporaryFolder folder;
    write(folder / name, text);
    look_at_packed(folder / "take.mp4");
    fs::remove(folder / name);
}

void look_at_asset(const std::string& text) {
    look_at_metadata("take.Metadata.asset", text);
}

void look_at_json(const std::string& text) {
    look_at_metadata("take_meta.txt", text);
}

void look_at_record3d(const std::string& text) {
    look_at_metadata("take.mp4", text);
}

using Look = void (*)(const std::string&);
constexpr std::array<std::pair<std::string_view, Look>, 12> kKinds{
    {{"sidecar", look_at_sidecar},
     {"matrix", look_at_matrix},
     {"open3d", look_at_open3d},
     {"pincam", look_at_pincam},
     {"list", look_at_list},
     {"stamps", look_at_stamps},
     {"pattern", look_at_pattern},
     {"kinect", look_at_kinect},
     {"message", look_at_message},
     {"asset", look_at_asset},
     {"json", look_at_json},
     {"record3d", look_at_record3d}}};

}  // namespace

/// A kind and the text of it, which begins in the second line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string input(data, data + size);
    const std::size_t line = std::min(input.find('\n'), input.size());
    for (const auto& [kind, look] : kKinds) {
        if (input.substr(0, line) == kind) look(input.substr(std::min(line + 1, input.size())));
    }
    return 0;
}
