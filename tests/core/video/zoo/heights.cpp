// Heights, which are near where they are high: terrain, height maps, tactile sensors.
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/zoo/zoo.hpp"

namespace dibhr::test::zoo {

namespace {

Truth heights(const cv::Mat& farness) {
    return truth_of(farness, Knows::shape, Measure::height);
}

/// Metres above the sea.
cv::Mat terrain_m(const cv::Mat& farness) {
    return 1000.0 - farness;
}

/// A file of the valley, 0 to 1 in whole levels of so many bits.
Form height_form(const std::string& file, int bits) {
    return {file, [=](const fs::path& folder) {
                const View view = view_of(Place::terrain);
                cv::Mat levels;
                nearness_of(view.farness)
                    .convertTo(levels, bits == 16 ? CV_16U : CV_8U, bits == 16 ? 65535.0 : 255.0);
                save(folder / file, levels);
                return Brought{folder / file, {}, heights(view.farness)};
            }};
}

Form height_numbers_form(const std::string& file) {
    return {file, [=](const fs::path& folder) {
                const View view = view_of(Place::terrain);
                save_npy(folder / file, terrain_m(view.farness));
                return Brought{folder / file, {}, heights(view.farness)};
            }};
}

/// A tag states the level of no data.
Brought geotiff(const fs::path& folder) {
    const cv::Mat farness = with_hole(view_of(Place::terrain).farness);
    save_tiff(folder / "dem.tif", with_no_data_as(terrain_m(farness), -9999.0), "-9999");
    return {folder / "dem.tif", {}, heights(farness)};
}

/// Nothing but the numbers says that the map is of heights.
Brought nameless_geotiff(const fs::path& folder) {
    const cv::Mat farness = with_hole(view_of(Place::terrain).farness);
    save_tiff(folder / "n46_e011.tif", with_no_data_as(terrain_m(farness), -9999.0), "-9999");
    return {folder / "n46_e011.tif", {}, heights(farness)};
}

/// Micrometres, as ImageJ saves them: imagej.net, TIFF of ImageJ.
Brought micrograph(const fs::path& folder) {
    const View view = view_of(Place::gel);
    save_tiff(folder / "topo_sample3.tif", (2.0 - view.farness) * 6.0 + 1.0, {},
              "ImageJ=1.53t\nunit=micron\nspacing=0.277\n");
    return {folder / "topo_sample3.tif", {}, heights(view.farness)};
}

/// (65536 R + 256 G + B) / 10 - 10000: docs.mapbox.com, terrain-RGB.
Brought terrain_rgb(const fs::path& folder) {
    const View view = view_of(Place::terrain);
    cv::Mat coded(kView, CV_8UC3);
    for (int j = 0; j < kView.height; ++j)
        for (int i = 0; i < kView.width; ++i) {
            const double metres = 1000.0 - static_cast<double>(view.farness.at<float>(j, i));
            const auto value = static_cast<std::uint32_t>((metres + 10000.0) * 10.0);
            coded.at<cv::Vec3b>(j, i) = {static_cast<std::uint8_t>(value & 255U),
                                         static_cast<std::uint8_t>((value >> 8U) & 255U),
                                         static_cast<std::uint8_t>(value >> 16U)};
        }
    save(folder / "terrain_rgb_12_2148_1434.png", coded);
    return {folder / "terrain_rgb_12_2148_1434.png", {}, heights(view.farness)};
}

/// A painted material: colour, displacement, and what is neither.
Brought material(const fs::path& folder) {
    const View view = view_of(Place::terrain);
    save(folder / "Rock_albedo.jpg", view.colour);
    save(folder / "Rock_displacement.jpg", in_8_bits(nearness_of(view.farness)));
    save(folder / "Rock_roughness.jpg", cv::Mat(kView, CV_8UC1, cv::Scalar(180)));
    save(folder / "Rock_normal.jpg", cv::Mat(kView, CV_8UC3, cv::Scalar(255, 128, 128)));
    Brought brought{folder / "Rock_albedo.jpg", {}, heights(view.farness)};
    brought.truth.colour = {view.colour};
    return brought;
}

/// Grain around the middle grey, as of leather.
Brought grain(const fs::path& folder) {
    const cv::Mat levels = rough(kView.width, kView.height, 77);
    save(folder / "leather_BUMP.png", levels);
    cv::Mat farness;
    levels.convertTo(farness, CV_32F, -1.0);
    return {folder / "leather_BUMP.png", {}, heights(farness)};
}

/// Millimetres of a tactile sensor.
Brought tactile_numbers(const fs::path& folder) {
    const View view = view_of(Place::gel);
    save_npy(folder / "digit_height_map.npy", 2.0 - view.farness);
    return {folder / "digit_height_map.npy", {}, heights(view.farness)};
}

/// GelSight's own form: a line, sizes, millimetres.
Brought gelsight(const fs::path& folder) {
    const View view = view_of(Place::gel);
    const cv::Mat metres = (2.0 - view.farness) * 0.001;
    std::string bytes = std::string("Binary TrueMap Data File v2.0\r\n") + '\0' + '\0';
    const auto append = [&bytes](auto number) {
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    append(static_cast<std::uint32_t>(kView.width));
    append(static_cast<std::uint32_t>(kView.height));
    for (const float of : {14.7F, 11.0F, 0.0F, 0.0F}) append(of);
    for (int j = 0; j < kView.height; ++j)
        for (int i = 0; i < kView.width; ++i) append(metres.at<float>(j, i));
    save_text(folder / "scan.tmd", bytes);
    Brought brought{folder / "scan.tmd", {}, heights(view.farness)};
    brought.truth.refused_as = ".tmd";
    return brought;
}

}  // namespace

Forms forms_of_heights() {
    return {height_form("heightmap8.png", 8),
            height_form("heightmap16.png", 16),
            height_form("displacement.jpg", 8),
            height_form("alps_bump.png", 8),
            height_numbers_form("heightmap.npy"),
            height_numbers_form("alps_height.npy"),
            {"GeoTIFF", geotiff},
            {"GeoTIFF without a word for height", nameless_geotiff},
            {"ImageJ, micrometres", micrograph},
            {"terrain-RGB", terrain_rgb},
            {"material", material},
            {"leather_BUMP.png", grain},
            {"DIGIT", tactile_numbers},
            {"GelSight (.tmd)", gelsight}};
}

}  // namespace dibhr::test::zoo
