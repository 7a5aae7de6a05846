// What words in names say about depth.
#include "core/video/depth/depth_words.hpp"

#include <algorithm>
#include <string>

#include "core/video/depth/picture_levels.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

Findings rows_in(const std::string& name, int bits = kRealBits) {
    return findings_in_name(name, bits, "its name");
}

/// Of the only row.
DepthStatement stated_in(const std::string& name, int bits = kRealBits) {
    const Findings rows = rows_in(name, bits);
    REQUIRE(rows.size() == 1);
    CHECK(rows.front().evidence == Evidence::name);
    CHECK(rows.front().sureness >= kSureEnough);
    return rows.front().statement;
}

DepthStatement distance(DepthUnit unit, double scale) {
    return {.near = NearLevels::dark, .unit = unit, .scale = scale};
}

}  // namespace

TEST_CASE("a unit beside a word for distances is that of the numbers", "[words]") {
    const std::string in_mm = GENERATE("depth_mm", "depthMM", "mm_depth", "depth_map_mm", "z_mm",
                                       "depth_in_millimeters", "scan in millimetres");
    const std::string in_cm = GENERATE("depth_cm", "DepthCm", "distance_cm", "depth centimeters");
    const std::string in_m =
        GENERATE("depth_m", "depthInMeters", "depth_in_meters", "tiefe_m", "range_m");
    CAPTURE(in_mm, in_cm, in_m);
    CHECK(stated_in(in_mm) == distance(DepthUnit::mm, 1.0));
    CHECK(stated_in(in_cm) == distance(DepthUnit::mm, 10.0));
    CHECK(stated_in(in_m) == distance(DepthUnit::m, 1.0));
    CHECK(stated_in("depth_cm", 16) == distance(DepthUnit::mm, 10.0));
    CHECK(rows_in("depth_cm", 8).empty());
}

TEST_CASE("sizes, single letters and other words are no units", "[words]") {
    const std::string name = GENERATE("depth_500mm", "table_2m", "shot_10_metres", "a_m", "m", "mm",
                                      "cm_b", "programme", "rgb_m");
    CAPTURE(name);
    const Findings rows = rows_in(name);
    CHECK(std::none_of(rows.begin(), rows.end(),
                       [](const Finding& row) { return row.statement.scale.has_value(); }));
}

TEST_CASE("inverse depth is disparity, and heights stay heights with their unit", "[words]") {
    const std::string inverse = GENERATE("inv_depth", "inverse depth", "idepth", "invDepth_03",
                                         "disp", "left_disparity", "depth_from_disparity");
    CAPTURE(inverse);
    CHECK(stated_in(inverse) ==
          DepthStatement{.near = NearLevels::bright, .unit = DepthUnit::disparity});
    const std::string height =
        GENERATE("height_m", "heightmap", "elevation_in_meters", "dem_03", "leather_BUMP",
                 "LeatherBump01", "bumpMap", "DisplacementMap", "rock_HEIGHT_4k");
    CAPTURE(height);
    CHECK(stated_in(height, 16) ==
          DepthStatement{.near = NearLevels::bright, .unit = DepthUnit::levels});
    CHECK(stated_in("nearness") == DepthStatement{.near = NearLevels::bright});
    const std::string texture = GENERATE("rock_wall_disp_4k", "bark-disp-16k", "tiles_1k_disp");
    CAPTURE(texture);
    CHECK(stated_in(texture, 16) ==
          DepthStatement{.near = NearLevels::bright, .unit = DepthUnit::levels});
    CHECK(stated_in("disp_k_4") ==
          DepthStatement{.near = NearLevels::bright, .unit = DepthUnit::disparity});
}

TEST_CASE("a word for depth is a weak hint at distances, unless it is relative", "[words]") {
    const std::string weak =
        GENERATE("depth", "depth_0001", "SceneDepth", "Tiefe", "profondeur", "深度");
    CAPTURE(weak);
    const Findings rows = rows_in(weak, 16);
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].statement == DepthStatement{.near = NearLevels::dark});
    CHECK(rows[0].sureness < kSureEnough);
    CHECK(rows[1].statement == DepthStatement{.unit = DepthUnit::levels});
    CHECK(rows[1].sureness < 0.5);
    CHECK(rows_in(weak, 8).empty());
    const std::string none = GENERATE("rel_depth", "depth_normalized", "depth_anything", "zbuffer",
                                      "midas_depth", "indepth", "photo");
    CAPTURE(none);
    CHECK(rows_in(none).empty());
}

TEST_CASE("a logarithm of depth is near where dark, and no distance", "[words]") {
    for (const char* const name : {"log_depth", "logDepth_03", "log_z"})
        CHECK(stated_in(name) ==
              DepthStatement{.near = NearLevels::dark, .unit = DepthUnit::levels});
    CHECK(rows_in("log_depth", 8).empty());
    CHECK(rows_in("depth_log").empty());
}

TEST_CASE("the last telling word of a name may be that of another quantity", "[words]") {
    const std::string other = GENERATE("sst", "wind_speed", "LST_celsius", "population_density",
                                       "ndvi_field7", "slope_deg", "dem_aspect", "depth_velocity");
    CAPTURE(other);
    const Findings rows = quantities_in_name(other, "its name");
    REQUIRE(rows.size() == 1);
    CHECK(rows.front().about == kNoDepth);
    CHECK(rows.front().statement == DepthStatement{});
    const std::string depth =
        GENERATE("slope_depth", "wind_tunnel_height", "aspects", "scan", "ski_mask", "");
    CAPTURE(depth);
    CHECK(quantities_in_name(depth, "its name").empty());
}

TEST_CASE("what a laser saw is in metres, as real numbers", "[words]") {
    const Findings rows = rows_in("lidar_depth");
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].sureness >= kSureEnough);
    CHECK(rows[2].statement == DepthStatement{.unit = DepthUnit::m, .scale = 1.0});
    CHECK(rows_in("lidar_depth", 16).size() == 2);
    CHECK(contains(rows[0].reason, "'lidar' in its name"));
}

TEST_CASE("one list says what is neither colour nor depth, for files and arrays", "[words]") {
    for (const char* const word : {"mask", "confidence", "normal", "ir", "labels", "flow"})
        CHECK((other_content_of(word) != nullptr && !other_content_of(word)->shows_depth));
    CHECK(other_content_of("preview")->shows_depth);
    CHECK(other_content_of("intensity")->shows_scene);
    CHECK(other_content_of("ndvi")->is_quantity);
    for (const char* const word : {"", "depth", "rgb", "mas", "masked"})
        CHECK(other_content_of(word) == nullptr);
}
