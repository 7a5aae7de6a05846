// Portrait photos: a colour picture and the depth beside it in one HEIC file.
#include <libheif/heif.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/core/video/stated.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

const std::string kRamp = "color=black:s=32x24,format=gray,geq=lum='X*4+Y'";

/// Distributions leave the decoder out; then the line says which package has it.
bool is_decoded(const std::filesystem::path& photo) {
    if (heif_have_decoder_for_format(heif_compression_HEVC) != 0) return true;
    CHECK(contains(refusal([&] { (void)read_still(photo, PictureRole::colour); }),
                   "libheif-plugin-libde265"));
    WARN("HEIC pictures are not tested: libheif has no decoder here");
    return false;
}

}  // namespace

TEST_CASE("a portrait photo opens as colour and depth, and keeps the depth's levels", "[heif]") {
    const TemporaryFolder folder;
    write_photo({.colour = "color=red:s=64x48", .depth = kRamp}, folder / "portrait.heic");
    CHECK(heif_has_depth(folder / "portrait.heic"));
    if (!is_decoded(folder / "portrait.heic")) return;
    const StillPicture depth = read_still(folder / "portrait.heic", PictureRole::depth);
    CHECK(depth.bits == 8);
    CHECK(depth.codec == "HEIC");
    CHECK(stated_by(depth).unit == DepthUnit::disparity);
    CHECK_FALSE(origins_of(depth.findings).empty());
    REQUIRE(depth.picture.size() == cv::Size(32, 24));
    for (int j = 0; j < 24; ++j)
        for (int i = 0; i < 32; ++i) REQUIRE(depth.picture.at<std::uint8_t>(j, i) == 4 * i + j);
    const auto frame = open_media(folder / "portrait.heic")->next();
    REQUIRE(frame);
    CHECK(frame->colour.columns == 64);
    CHECK(frame->depth.columns == 32);
    CHECK(frame->colour.rgb[0] > 200);
    CHECK(frame->colour.rgb[2] < 50);
}

TEST_CASE("the photo says what its levels of depth are", "[heif]") {
    const TemporaryFolder folder;
    write_photo({.depth = kRamp, .depth_information = disparity_information()},
                folder / "portrait.heic");
    if (!is_decoded(folder / "portrait.heic")) return;
    const StillPicture depth = read_still(folder / "portrait.heic", PictureRole::depth);
    CHECK(stated_by(depth).unit == DepthUnit::disparity);
    REQUIRE(stated_by(depth).scale);
    CHECK(*stated_by(depth).scale == 1.0 / 255.0);
}

TEST_CASE("a turned photo is upright in colour and in depth", "[heif]") {
    const TemporaryFolder folder;
    write_photo({.colour = "color=red:s=64x48", .depth = kRamp, .quarter_turns = 1},
                folder / "turned.heic");
    if (!is_decoded(folder / "turned.heic")) return;
    CHECK(read_still(folder / "turned.heic", PictureRole::colour).picture.size() ==
          cv::Size(48, 64));
    const cv::Mat depth = read_still(folder / "turned.heic", PictureRole::depth).picture;
    REQUIRE(depth.size() == cv::Size(24, 32));
    CHECK(depth.at<std::uint8_t>(31, 0) == 0);  // the upper left corner is the lower left one
    CHECK(depth.at<std::uint8_t>(0, 0) == 4 * 31);
    CHECK(depth.at<std::uint8_t>(31, 23) == 23);
}

TEST_CASE("a photo without depth is colour, and refused as depth", "[heif]") {
    const TemporaryFolder folder;
    write_photo({}, folder / "plain.heic");
    CHECK_FALSE(heif_has_depth(folder / "plain.heic"));
    if (!is_decoded(folder / "plain.heic")) return;
    CHECK(read_still(folder / "plain.heic", PictureRole::colour).picture.type() == CV_8UC3);
    CHECK(
        contains(refusal([&] { (void)open_depth(folder / "plain.heic"); }), "photo without depth"));
}
