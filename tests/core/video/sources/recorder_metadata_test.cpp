// What Depthkit and Record3D write down of their videos is found and read.
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/video/sources/recorder_metadata.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// The size of the pictures that the asset speaks of.
cv::Size asset_size() {
    return {512, 848};
}

/// As Depthkit's plug-in for Unity writes it.
std::string asset(const std::string& more = {}) {
    return "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!114 &11400000\nMonoBehaviour:\n"
           "  m_Name: Take.Metadata\n  depthkitMetadata:\n    format: perpixel\n"
           "    boundsCenter: {x: 0, y: 0, z: 0.89}\n    perspectives:\n"
           "    - depthImageSize: {x: 512, y: 424}\n"
           "      depthPrincipalPoint: {x: 254.5, y: 205.25}\n"
           "      depthFocalLength: {x: 366.5, y: 366.25}\n"
           "      farClip: 1.25\n      nearClip: 0.5\n"
           "      crop: {x: 0, y: 0, z: 1, w: 1}\n" +
           more;
}

/// As Depthkit's exports have it beside them; of the older kind without the list of cameras.
std::string json(const std::string& near = "0.5", const std::string& crop = "0.25") {
    return R"({ "_versionMajor": 0, "format": "perpixel", "depthImageSize": {"x": 640, "y": 480},
        "depthPrincipalPoint": {"x": 319.5, "y": 239.5}, "depthFocalLength": {"x": 500, "y": 510},
        "farClip": 2.5, "nearClip": )" +
           near + R"(, "crop": {"x": )" + crop + R"(, "y": 0.0, "z": 0.5, "w": 1.0} })";
}

std::string record3d(const std::string& range = R"(, "rangeOfEncodedDepth": [0.25, 2.25])") {
    return R"({"intrinsicMatrix":[600,0,0,0,601,0,239.5,319.5,1])" + range + "}";
}

}  // namespace

TEST_CASE("Depthkit's asset beside a video says clips, camera and that hue below is depth",
          "[recorder]") {
    const TemporaryFolder folder;
    write_text(folder / "Take.Metadata.asset", asset());
    const auto form = form_by_recorder(folder / "Dk_Take.mov", asset_size());
    REQUIRE(form);
    CHECK(form->packing == DepthPacking::top_bottom);
    CHECK(form->hue == HueCode{{{0.5, 1.25}}});
    CHECK(form->finding.statement.intrinsics == Intrinsics{366.5, 366.25, 254.5, 205.25});
    CHECK(form->intrinsics_size == cv::Size(512, 424));
    CHECK(form->packing == DepthPacking::top_bottom);
    CHECK(form->coded.statement.code == DepthCode::hue);
    CHECK(form->finding.reason == "'Take.Metadata.asset'");
}

TEST_CASE("Depthkit's JSON is read, whether its camera stands alone or in a list", "[recorder]") {
    const TemporaryFolder folder;
    const std::string name = GENERATE("take_meta.txt", "take_metadata.json", "take.metadata.json",
                                      "take.txt", "Take.JSON");
    const bool listed = GENERATE(false, true);
    CAPTURE(name, listed);
    write_text(folder / name, listed ? R"({"perspectives": [)" + json() + "]}" : json());
    const auto form = form_by_recorder(folder / "take.mp4", {320, 960});
    REQUIRE(form);
    CHECK(form->hue->metres == DepthRange{0.5, 2.5});
    CHECK(form->finding.statement.intrinsics == Intrinsics{500.0, 510.0, 319.5 - 160.0, 239.5});
    CHECK(form->intrinsics_size == cv::Size(320, 480));
}

TEST_CASE("Record3D's metadata is found inside its video and beside it", "[recorder]") {
    const TemporaryFolder folder;
    const bool inside = GENERATE(false, true);
    const bool ranged = GENERATE(false, true);
    CAPTURE(inside, ranged);
    const std::string text = ranged ? record3d() : record3d("");
    const std::string comment = inside ? "-metadata comment='" + text + "' " : "";
    make_flat_clip(folder / "a.mp4", 3, 30, comment + kH264, "", 960, 640);
    if (!inside) write_text(folder / "metadata.json", text);
    const auto form = form_by_recorder(folder / "a.mp4", {960, 640});
    REQUIRE(form);
    CHECK(form->packing == DepthPacking::right_left);
    CHECK(form->hue == record3d_code(ranged ? DepthRange{0.25, 2.25} : DepthRange{0.0, 3.0}));
    CHECK(form->finding.statement.intrinsics == Intrinsics{600.0, 601.0, 239.5, 319.5});
    CHECK_FALSE(form->finding.reason.empty());
}

TEST_CASE("metadata of another video in the folder is not taken", "[recorder]") {
    const TemporaryFolder folder;
    SECTION("of other proportions") {
        write_text(folder / "Take.Metadata.asset", asset());
        CHECK_FALSE(form_by_recorder(folder / "color.mp4", {512, 424}));
    }
    SECTION("one of several, none of its name") {
        write_text(folder / "a_meta.txt", json());
        write_text(folder / "b_meta.txt", json());
        CHECK_FALSE(form_by_recorder(folder / "c.mp4", {320, 960}));
        CHECK(form_by_recorder(folder / "b.mp4", {320, 960}));
    }
    SECTION("a text of another kind with its name, beside the only one") {
        write_text(folder / "c.txt", "WEBVTT");
        write_text(folder / "a_meta.txt", json());
        const auto form = form_by_recorder(folder / "c.mp4", {320, 960});
        REQUIRE(form);
        CHECK(form->finding.reason == "'a_meta.txt'");
    }
    SECTION("of a camera that looks beside the picture") {
        write_text(folder / "metadata.json", record3d());
        CHECK_FALSE(form_by_recorder(folder / "c.mp4", {1920, 1080}));
    }
}

TEST_CASE("metadata that cannot be understood says nothing", "[recorder]") {
    const TemporaryFolder folder;
    const std::string text = GENERATE(
        std::string(), std::string("{"), std::string("null"), std::string("[1, 2]"),
        std::string(200000, '['), std::string(R"({"perspectives": []})"),
        std::string(R"({"perspectives": [3]})"), std::string(R"({"intrinsicMatrix": [1, 2]})"),
        std::string(R"({"intrinsicMatrix": ["a",0,0,0,1,0,0,0,1]})"), json("3.5"), json("-1"),
        json("1e999"), json("\"near\""), std::string("\0\xff\xfe{\"nearClip\"", 14));
    CAPTURE(text.substr(0, 60));
    write_text(folder / "a_metadata.json", text);
    CHECK_FALSE(form_by_recorder(folder / "a.mp4", {320, 960}));
    write_text(folder / "b.metadata.asset", text);
    CHECK_FALSE(form_by_recorder(folder / "b.mp4", {320, 960}));
}

TEST_CASE("metadata of a camera without pixels, or of endless ones, says nothing", "[recorder]") {
    const TemporaryFolder folder;
    const std::string side = GENERATE(std::string("2e-300"), std::string("1e-9"),
                                      std::string("2e7"), std::string("1e300"));
    CAPTURE(side);
    std::string text = asset();
    for (const std::string length : {"x: 512", "y: 424"})
        text.replace(text.find(length) + 3, 3, side);
    write_text(folder / "a.metadata.asset", text);
    CHECK_FALSE(form_by_recorder(folder / "a.mov", {512, 1024}));
}

TEST_CASE("lengths that no camera has are passed over, the rest of the metadata is not",
          "[recorder]") {
    const TemporaryFolder folder;
    const std::string length = GENERATE(std::string("0"), std::string("-366"),
                                        std::string("1e-300"), std::string("1e300"));
    CAPTURE(length);
    std::string text = asset();
    text.replace(text.find("366.5"), 5, length);
    write_text(folder / "a.metadata.asset", text);
    const auto form = form_by_recorder(folder / "a.mov", asset_size());
    REQUIRE(form);
    CHECK(form->hue == HueCode{{{0.5, 1.25}}});
    CHECK_FALSE(form->finding.statement.intrinsics);
}

TEST_CASE("several cameras in one video are not taken for one", "[recorder]") {
    const TemporaryFolder folder;
    write_text(folder / "a.metadata.asset",
               asset("    - depthImageSize: {x: 512, y: 424}\n      nearClip: 0.5\n"));
    write_text(folder / "b_meta.txt", R"({"perspectives": [)" + json() + "," + json() + "]}");
    CHECK_FALSE(form_by_recorder(folder / "a.mov", asset_size()));
    CHECK_FALSE(form_by_recorder(folder / "b.mov", {320, 960}));
}

TEST_CASE("a video without metadata, or that is not there, has no form", "[recorder]") {
    const TemporaryFolder folder;
    write_text(folder / "a.mp4", "{\"intrinsic");
    write_text(folder / "b.mp4", "{\"intrinsicMatrix\":[1}");
    CHECK_FALSE(form_by_recorder(folder / "a.mp4", asset_size()));
    CHECK_FALSE(form_by_recorder(folder / "b.mp4", asset_size()));
    CHECK_FALSE(form_by_recorder(folder / "absent.mp4", asset_size()));
    CHECK_FALSE(form_by_recorder(folder.path() / "no" / "absent.mp4", {0, 0}));
}
