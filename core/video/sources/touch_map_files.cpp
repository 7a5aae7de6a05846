// Touch maps read from pictures of any kind, and written as PNG with their limits as TOML.
#include "core/video/sources/touch_map_files.hpp"

#include <toml++/toml.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/modules/picture_codecs.hpp"
#include "core/video/sources/beside_recording.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kMostMapPixels = std::int64_t{1} << 26;  ///< more than any depth image has

std::string ending_of(TouchMapKind kind) {
    return std::string("_") + name_of(kind) + ".png";
}

fs::path limits_file(const fs::path& depth) {
    return beside_recording(depth, "_maps.toml");
}

using AllLimits = std::map<TouchMapKind, MapLimits>;

AllLimits limits_in(const fs::path& file) try {
    AllLimits limits{};
    for (const TouchMapKind kind : all_touch_map_kinds()) limits[kind] = standard_limits(kind);
    if (!is_file(file)) return limits;
    std::ifstream stream(file);
    const toml::table said = toml::parse(stream, file.string());
    for (const TouchMapKind kind : all_touch_map_kinds()) {
        MapLimits& each = limits[kind];
        const auto table = said[name_of(kind)];
        each.lowest = table["lowest"].value_or(each.lowest);
        each.highest = table["highest"].value_or(each.highest);
        const bool fits = std::isfinite(each.lowest) && std::isfinite(each.highest) &&
                          each.lowest < each.highest &&
                          (kind == TouchMapKind::height || each.lowest >= 0.0);
        if (fits) continue;
        throw InputError(shown(file) + ": the " + name_of(kind) +
                         " map's lowest value must be below its highest" +
                         (kind == TouchMapKind::height ? "" : " and 0 or more") + "; correct it");
    }
    return limits;
} catch (const toml::parse_error& error) {
    throw InputError(shown(file) + ": line " + std::to_string(error.source().begin.line) +
                     " cannot be understood (" + one_line(error.description(), 200) +
                     "); correct or remove it");
}

/// Of one or four channels of 16 bits.
TouchMap map_of(const cv::Mat& level, const cv::Mat& cover, const MapLimits& limits) {
    TouchMap map{level.cols, level.rows, limits, {}};
    map.pixels.reserve(level.total());
    for (int j = 0; j < level.rows; ++j) {
        for (int i = 0; i < level.cols; ++i)
            map.pixels.push_back({level.at<std::uint16_t>(j, i), cover.at<std::uint16_t>(j, i)});
    }
    return map;
}

/// 8 bits as 16, where 255 is 65535.
cv::Mat in_16_bits(const cv::Mat& picture) {
    constexpr double kStep = 257.0;
    cv::Mat wide;
    picture.convertTo(wide, CV_16U, picture.depth() == CV_8U ? kStep : 1.0);
    return wide;
}

TouchMap map_of(const cv::Mat& picture, const MapLimits& limits) {
    const cv::Mat wide = in_16_bits(picture);
    cv::Mat cover(wide.size(), CV_16U, cv::Scalar(TouchMap::kWhole));
    if (wide.channels() == 4) cv::extractChannel(wide, cover, 3);
    return map_of(grey_of(wide), cover, limits);
}

bool has_levels(const cv::Mat& picture) {
    return !picture.empty() && (picture.depth() == CV_8U || picture.depth() == CV_16U);
}

TouchMap read_map(const fs::path& file, const MapLimits& limits) {
    const cv::Mat picture = read_still(file, PictureRole::depth).picture;
    if (!has_levels(picture))
        throw InputError(shown(file) +
                         ": a touch map has 8 or 16 bits a pixel; save it as such a PNG");
    return map_of(picture, limits);
}

void remove_map(const fs::path& file) {
    std::error_code failed;
    fs::remove(file, failed);
    if (failed)
        throw InputError(shown(file) + ": cannot be removed (" + failed.message() +
                         "); remove it yourself");
}

void write_limits(const TouchMaps& maps, const fs::path& file) {
    std::ostringstream text;
    text << "# What the lowest and the highest level of each map beside this file mean.\n";
    for (const TouchMapKind kind : all_touch_map_kinds()) {
        const MapLimits& limits =
            maps.of(kind).empty() ? standard_limits(kind) : maps.of(kind).limits;
        const std::string unit = unit_of(kind);
        text << "\n[" << name_of(kind) << "]" << (unit.empty() ? "" : "  # ") << unit
             << "\nlowest = " << number_text(limits.lowest)
             << "\nhighest = " << number_text(limits.highest) << "\n";
    }
    write_file(file, text.str());
}

}  // namespace

fs::path touch_map_file(const fs::path& depth, TouchMapKind kind) {
    return beside_recording(depth, ending_of(kind));
}

bool names_touch_map(const fs::path& file) {
    const std::string name = lower_case(file.filename().string());
    if (name.ends_with("_regions.png")) return is_file(fs::path(file).replace_extension(".toml"));
    for (const TouchMapKind kind : all_touch_map_kinds()) {
        const std::string ending = ending_of(kind);
        if (!name.ends_with(ending) || name.size() == ending.size()) continue;
        if (kind != TouchMapKind::height) return true;
        const std::string stem = file.filename().string();
        return is_file(file.parent_path() /
                       (stem.substr(0, stem.size() - ending.size()) + "_maps.toml"));
    }
    return false;
}

std::shared_ptr<const TouchMaps> read_touch_maps(const fs::path& depth, int columns, int rows) {
    if (depth.empty()) return nullptr;
    std::optional<AllLimits> limits;
    auto maps = std::make_shared<TouchMaps>();
    for (const TouchMapKind kind : all_touch_map_kinds()) {
        const fs::path file = touch_map_file(depth, kind);
        std::error_code same;
        if (!is_file(file) || fs::equivalent(file, depth, same)) continue;
        if (!limits) limits = limits_in(limits_file(depth));
        maps->of(kind) = read_map(file, limits->at(kind));
    }
    if (maps->empty()) return nullptr;
    lay_heights(*maps, columns, rows);
    return maps;
}

void write_touch_maps(const TouchMaps& maps, const fs::path& depth) {
    bool writes = false;
    for (const TouchMapKind kind : all_touch_map_kinds()) {
        const TouchMap& map = maps.of(kind);
        const fs::path file = touch_map_file(depth, kind);
        if (!map.covers_anything()) {
            remove_map(file);
            continue;
        }
        writes = true;
        write_file(file, png_of(map));
    }
    if (writes)
        write_limits(maps, limits_file(depth));
    else
        remove_map(limits_file(depth));
}

std::string png_of(const TouchMap& map) {
    if (map.empty()) throw InputError("A touch map cannot be written: it has no pixels");
    set_up_libraries();
    cv::Mat picture(map.rows, map.columns, CV_16UC4);
    for (int j = 0; j < map.rows; ++j) {
        for (int i = 0; i < map.columns; ++i) {
            const TouchMap::Pixel& pixel = map.at(i, j);
            picture.at<cv::Vec4w>(j, i) = {pixel.level, pixel.level, pixel.level, pixel.cover};
        }
    }
    return encoded_png(picture);
}

TouchMap touch_map_in(const std::string& png, const MapLimits& limits, const std::string& name) {
    std::istringstream stream(png);
    const auto claimed = claimed_size(stream);
    const bool fits = claimed && claimed->columns > 0 && claimed->rows > 0 &&
                      claimed->columns <= kMostMapPixels / claimed->rows;
    cv::Mat picture;
    if (fits) {
        set_up_libraries();
        const std::vector<std::uint8_t> bytes(png.begin(), png.end());
        picture = picture_codecs().decode(cv::Mat(bytes), cv::IMREAD_UNCHANGED);
    }
    if (!has_levels(picture)) throw InputError(name + ": holds a touch map that cannot be read");
    return map_of(picture, limits);
}

}  // namespace dibhr
