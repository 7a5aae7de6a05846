// numpy's files: which array is meant, its shape, type and order, and when its frames are shown.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

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
using Catch::Matchers::WithinAbs;

namespace {

namespace fs = std::filesystem;

template <typename Number>
std::string data_of(const cv::Mat& values, bool little = true) {
    std::string bytes;
    for (int j = 0; j < values.rows; ++j)
        for (int i = 0; i < values.cols; ++i)
            append_bytes(bytes, static_cast<Number>(values.at<float>(j, i)), little);
    return bytes;
}

/// Half precision of a number that has one: 1 to 16, of 10 bits.
std::string half_data_of(const cv::Mat& values, bool little) {
    std::string bytes;
    for (int j = 0; j < values.rows; ++j)
        for (int i = 0; i < values.cols; ++i) {
            int exponent = 0;
            const float mantissa = std::frexp(values.at<float>(j, i), &exponent);
            const auto fraction = static_cast<int>((mantissa * 2.0F - 1.0F) * 1024.0F);
            append_bytes(bytes, static_cast<std::uint16_t>((exponent + 14) << 10 | fraction),
                         little);
        }
    return bytes;
}

int different(cv::Mat a, const cv::Mat& b) {
    REQUIRE(a.size() == b.size());
    a.convertTo(a, CV_32F);
    return cv::countNonZero(a != b);
}

cv::Mat small(float first) {
    cv::Mat values(3, 4, CV_32FC1);
    for (int k = 0; k < 12; ++k) values.at<float>(k / 4, k % 4) = first + static_cast<float>(k);
    return values;
}

std::string small_npy(float first) {
    return npy("<f4", "(3, 4)", data_of<float>(small(first)));
}

std::string numbers(const std::string& shape, std::initializer_list<double> values) {
    std::string bytes;
    for (const double value : values) append_bytes(bytes, value);
    return npy("<f8", shape, bytes);
}

std::string scalar(double value) {
    return numbers("()", {value});
}

constexpr int kSideColumns = 24;
constexpr int kSideRows = 20;

/// As large as the smallest picture, `first` at its corner.
cv::Mat plane(float first) {
    cv::Mat values(kSideRows, kSideColumns, CV_32FC1);
    for (int j = 0; j < kSideRows; ++j)
        for (int i = 0; i < kSideColumns; ++i)
            values.at<float>(j, i) = first + 0.01F * static_cast<float>(2 * j + i);
    return values;
}

std::string plane_npy(float first) {
    return npy("<f4", "(20, 24)", data_of<float>(plane(first)));
}

/// Bytes of colours of that size.
std::string colours_npy() {
    return npy("|u1", "(20, 24, 3)", std::string(3 * kSideRows * kSideColumns, '\x55'));
}

/// Planes as one array whose last axis counts them.
std::string stacked(const std::vector<cv::Mat>& planes, bool fortran) {
    std::string data;
    const auto count = static_cast<int>(planes.size());
    const auto append = [&](int k, int j, int i) {
        append_bytes(data, planes[static_cast<std::size_t>(k)].at<float>(j, i));
    };
    if (fortran)
        for (int k = 0; k < count; ++k)
            for (int i = 0; i < kSideColumns; ++i)
                for (int j = 0; j < kSideRows; ++j) append(k, j, i);
    else
        for (int j = 0; j < kSideRows; ++j)
            for (int i = 0; i < kSideColumns; ++i)
                for (int k = 0; k < count; ++k) append(k, j, i);
    return npy("<f4", "(20, 24, " + std::to_string(count) + ")", data, fortran);
}

/// What the command in a refusal, run in the folder, saves as depth.npy.
cv::Mat saved_by_command(const std::string& refused, const fs::path& folder) {
    const std::string command = refused.substr(refused.find("python3 -c"));
    REQUIRE(std::system(("cd '" + folder.string() + "' && /usr/bin/" + command).c_str()) == 0);
    return read_still(folder / "depth.npy", PictureRole::depth).picture;
}

std::unique_ptr<PictureSource> depth_of_file(const fs::path& file) {
    return open_picture_source(file, PictureRole::depth);
}

std::string refusal_of(const fs::path& file, PictureRole role = PictureRole::depth) {
    return refusal([&] { (void)open_picture_source(file, role); });
}

}  // namespace

TEST_CASE("every level of a .npy array is kept, whatever its type and byte order", "[numpy]") {
    const TemporaryFolder folder;
    const bool little = GENERATE(true, false);
    const std::string order = little ? "<" : ">";
    const std::string shape = "(240, 320)";
    const auto read = [&](const std::string& type, const std::string& data) {
        write_text(folder / "a.npy", npy(order + type, shape, data));
        return read_still(folder / "a.npy", PictureRole::depth);
    };
    const cv::Mat levels = scene_levels();
    CHECK(different(read("f2", half_data_of(scene(), little)).picture, scene()) == 0);
    CHECK(different(read("f4", data_of<float>(scene(), little)).picture, scene()) == 0);
    CHECK(different(read("f8", data_of<double>(scene(), little)).picture, scene()) == 0);
    CHECK(different(read("u4", data_of<std::uint32_t>(levels, little)).picture, levels) == 0);
    CHECK(different(read("i2", data_of<std::int16_t>(levels, little)).picture, levels) == 0);
    CHECK(different(read("i4", data_of<std::int32_t>(levels, little)).picture, levels) == 0);
    CHECK(different(read("i8", data_of<std::int64_t>(levels, little)).picture, levels) == 0);
    const StillPicture whole = read("u2", data_of<std::uint16_t>(levels, little));
    CHECK(whole.bits == 16);
    CHECK(whole.codec == "NPY");
    CHECK(different(whole.picture, levels) == 0);
    cv::Mat bytes = levels / 16;
    for (float& level : cv::Mat_<float>(bytes)) level = std::floor(level);
    const StillPicture coarse = read("u1", data_of<std::uint8_t>(bytes, little));
    CHECK(coarse.bits == 8);
    CHECK(different(coarse.picture, bytes) == 0);
}

TEST_CASE("whole numbers beyond 31 bits, and those below 0, keep their value", "[numpy]") {
    const TemporaryFolder folder;
    std::string large;
    std::string negative;
    for (int k = 0; k < 4; ++k) {
        append_bytes(large, std::uint32_t{0x80000000U});
        append_bytes(negative, std::int16_t{-5});
    }
    write_text(folder / "large.npy", npy("<u4", "(2, 2)", large));
    write_text(folder / "negative.npy", npy("<i2", "(2, 2)", negative));
    CHECK(read_still(folder / "large.npy", PictureRole::depth).picture.at<float>(1, 1) ==
          2147483648.0F);
    CHECK(read_still(folder / "negative.npy", PictureRole::depth).picture.at<float>(1, 1) == -5.0F);
}

TEST_CASE("shapes with sides of one are pictures like others", "[numpy]") {
    const TemporaryFolder folder;
    const std::string shape =
        GENERATE("(3, 4)", "(1, 3, 4)", "(3, 4, 1)", "(1, 3, 4, 1)", "(1, 1, 3, 4)", "(3L, 4L)");
    CAPTURE(shape);
    write_text(folder / "a.npy", npy("<f4", shape, data_of<float>(small(5))));
    const auto source = depth_of_file(folder / "a.npy");
    CHECK(source->facts().still);
    CHECK(source->facts().frames == 1);
    CHECK(different(source->next()->picture, small(5)) == 0);
    CHECK_FALSE(source->next());
}

TEST_CASE("more than one picture is a video of 30 a second, read frame by frame", "[numpy]") {
    const TemporaryFolder folder;
    std::string data;
    for (int k = 0; k < 5; ++k) data += data_of<float>(small(100.0F * static_cast<float>(k)));
    const std::string array =
        npy("<f4", GENERATE("(5, 3, 4)", "(5, 3, 4, 1)", "(5, 1, 3, 4)"), data);
    const bool packed = GENERATE(false, true);
    const fs::path file = folder / (packed ? "a.npz" : "a.npy");
    if (packed)
        write_zip(file, {{"arr_0.npy", array}}, GENERATE(false, true));
    else
        write_text(file, array);
    const auto source = depth_of_file(file);
    CHECK_FALSE(source->facts().still);
    CHECK(source->facts().frames == 5);
    CHECK(source->facts().frames_exact);
    CHECK_THAT(source->facts().frames_per_s, WithinAbs(30.0, 1e-9));
    CHECK_THAT(source->facts().duration_s, WithinAbs(5.0 / 30.0, 1e-9));
    for (int k = 0; k < 5; ++k) {
        const auto taken = source->next();
        REQUIRE(taken);
        CHECK(taken->index == k);
        CHECK_THAT(taken->time_s, WithinAbs(k / 30.0, 1e-9));
        CHECK(different(taken->picture, small(100.0F * static_cast<float>(k))) == 0);
    }
    CHECK_FALSE(source->next());
    source->seek(1.5 / 30.0);
    CHECK(source->next()->index == 1);
    source->seek(-1.0);
    CHECK(different(source->next()->picture, small(0)) == 0);
    source->seek(9.0);
    CHECK(different(source->next()->picture, small(400)) == 0);
}

TEST_CASE("arrays in Fortran's order are the same pictures", "[numpy]") {
    const TemporaryFolder folder;
    std::string data;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 2; ++k)
                append_bytes(data, small(100.0F * static_cast<float>(k)).at<float>(j, i), false);
    write_text(folder / "a.npy", npy(">f4", "(2, 3, 4)", data, true));
    const auto source = depth_of_file(folder / "a.npy");
    CHECK(different(source->next()->picture, small(0)) == 0);
    CHECK(different(source->next()->picture, small(100)) == 0);
}

TEST_CASE("of a .npz the array whose name says depth is taken, else its only one", "[numpy]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "a.npz";
    const auto [name, deflated] =
        GENERATE(table<std::string, bool>({{"depths", true}, {"depth", false}, {"disp", true}}));
    write_zip(file, {{"other.npy", small_npy(0)}, {name + ".npy", small_npy(7)}}, deflated);
    CHECK(different(depth_of_file(file)->next()->picture, small(7)) == 0);
    write_zip(file, {{"arr_0.npy", small_npy(9)}, {"fps.npy", scalar(30)}}, deflated);
    CHECK(different(depth_of_file(file)->next()->picture, small(9)) == 0);
    write_zip(file, {{"a.npy", small_npy(9)}, {"b.npy", small_npy(8)}}, deflated);
    CHECK(contains(refusal_of(file), "none of them called depths"));
}

TEST_CASE("frames may be counted by a last axis that is too short for a picture", "[numpy]") {
    const TemporaryFolder folder;
    std::vector<cv::Mat> planes;
    for (int k = 0; k < 5; ++k) planes.push_back(plane(1.0F + 0.02F * static_cast<float>(k)));
    write_text(folder / "a.npy", stacked(planes, GENERATE(false, true)));
    const auto source = depth_of_file(folder / "a.npy");
    CHECK(source->facts().frames == 5);
    for (const cv::Mat& expected : planes) CHECK(different(source->next()->picture, expected) == 0);
    source->seek(0.0);
    CHECK(different(source->next()->picture, planes.front()) == 0);
}

TEST_CASE("different numbers of each pixel are refused with the way to save one of them",
          "[numpy]") {
    const TemporaryFolder folder;
    const cv::Mat confidence(kSideRows, kSideColumns, CV_32FC1, cv::Scalar(0.5));
    cv::Mat intensity = plane(1.0F);
    cv::flip(intensity, intensity, -1);
    const cv::Mat& other = GENERATE(0, 1) == 0 ? confidence : intensity;
    const std::string array = stacked({plane(1.0F), other}, GENERATE(false, true));
    const bool packed = GENERATE(false, true);
    const fs::path file = folder / (packed ? "a.npz" : "a.npy");
    if (packed)
        write_zip(file, {{"depth.npy", array}}, true);
    else
        write_text(file, array);
    const std::string refused = refusal_of(file);
    CHECK(contains(refused, "2 different numbers of each pixel, in the shape [20, 24, 2]"));
    CHECK(different(saved_by_command(refused, folder.path()), plane(1.0F)) == 0);
}

TEST_CASE("the matrix of a camera or a pose is no picture", "[numpy]") {
    const TemporaryFolder folder;
    write_text(folder / "a.npy",
               GENERATE(numbers("(3, 3)", {500, 0, 2, 0, 510, 1.5, 0, 0, 1}),
                        numbers("(1, 3, 3)", {500, 0, 2, 0, 510, 1.5, 0, 0, 1}),
                        numbers("(4, 4)", {1, 0, 0, 2, 0, 1, 0, 3, 0, 0, 1, 4, 0, 0, 0, 1})));
    CHECK(contains(refusal_of(folder / "a.npy"), "the matrix of a camera or a pose"));
}

TEST_CASE("an array of 0 and 1 alone is a mask, and is refused as depth", "[numpy]") {
    const TemporaryFolder folder;
    cv::Mat mask(kSideRows, kSideColumns, CV_32FC1, cv::Scalar(1.0));
    write_text(folder / "a.npy", npy("<f4", "(20, 24)", data_of<float>(mask)));
    CHECK(refusal_of(folder / "a.npy").empty());
    mask.row(3) = cv::Scalar(0.0);
    write_text(folder / "a.npy", npy("<f4", "(20, 24)", data_of<float>(mask)));
    CHECK(contains(refusal_of(folder / "a.npy"), "as a mask does"));
    write_text(folder / "a.npy", npy("|u1", "(20, 24)", data_of<std::uint8_t>(mask)));
    CHECK(contains(refusal_of(folder / "a.npy"), "as a mask does"));
}

TEST_CASE("of arrays without the usual names the one whose name says depth is taken", "[numpy]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "a.npz";
    const std::string name = GENERATE("depth_map", "pred", "z", "depth_mm", "rangeDepth", "arr_1",
                                      "inverse_depth", "distance");
    CAPTURE(name);
    write_zip(file,
              {{"a_normals.npy", plane_npy(5)},
               {"valid_mask.npy", plane_npy(6)},
               {"arr_0.npy", colours_npy()},
               {"focal.npy", scalar(133)},
               {"flags.npy", npy("|b1", "(20, 24)", std::string(kSideRows * kSideColumns, '\1'))},
               {name + ".npy", plane_npy(7)}},
              true);
    CHECK(different(depth_of_file(file)->next()->picture, plane(7)) == 0);
    CHECK(open_media(file)->description().colour_path == file);
}

TEST_CASE("of several arrays that say depth none is taken, and the refusal names them", "[numpy]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "a.npz";
    const auto [first, second] =
        GENERATE(table<std::string, std::string>({{"depth_gt", "depth_pred"}, {"arr_0", "arr_1"}}));
    write_zip(file, {{first + ".npy", plane_npy(1)}, {second + ".npy", plane_npy(2)}}, true);
    const std::string refused = refusal_of(file);
    CHECK(contains(refused, "2 arrays that may be the depth, '" + first + "', '" + second + "'"));
    CHECK(different(saved_by_command(refused, folder.path()), plane(1)) == 0);
}

TEST_CASE("the name of an array says its unit, and a number beside it what a level is", "[numpy]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "a.npz";
    struct Case {
        std::string name;
        DepthUnit unit;
        std::optional<double> scale;
    };
    const Case named =
        GENERATE(Case{"depth_mm", DepthUnit::mm, 1.0}, Case{"depth_cm", DepthUnit::mm, 10.0},
                 Case{"depth_m", DepthUnit::m, 1.0}, Case{"depth_metres", DepthUnit::m, 1.0},
                 Case{"inv_depth", DepthUnit::disparity, std::nullopt},
                 Case{"disp_map", DepthUnit::disparity, std::nullopt});
    write_zip(file, {{named.name + ".npy", plane_npy(1)}}, true);
    const SourceFacts by_name = depth_of_file(file)->facts();
    CHECK(stated_by(by_name).unit == named.unit);
    CHECK(stated_by(by_name).scale == named.scale);

    const auto [stated, level_mm] = GENERATE(table<double, double>(
        {{0.00025, 0.25}, {0.001, 1.0}, {0.1, 0.1}, {1.0, 1.0}, {1000.0, 1.0}, {5000.0, 0.2}}));
    const std::string levels =
        npy("<u2", "(20, 24)", data_of<std::uint16_t>(cv::Mat(plane(1) * 1000.0)));
    write_zip(file, {{"depth.npy", levels}, {"depth_scale.npy", scalar(stated)}}, true);
    const SourceFacts scaled = depth_of_file(file)->facts();
    CHECK(stated_by(scaled).unit == DepthUnit::mm);
    CHECK_THAT(stated_by(scaled).scale.value_or(0.0), WithinAbs(level_mm, 1e-12));
    // Real numbers may be metres, of which 1 says nothing.
    write_zip(file, {{"depth.npy", plane_npy(1)}, {"depth_scale.npy", scalar(1.0)}}, true);
    CHECK(stated_by(depth_of_file(file)->facts()) == DepthStatement{});
}

TEST_CASE("a .npz says when its frames are, how near is high, and what the camera was", "[numpy]") {
    const TemporaryFolder folder;
    const std::string frames =
        npy("<f4", "(3, 3, 4)",
            data_of<float>(small(0)) + data_of<float>(small(1)) + data_of<float>(small(2)));
    write_zip(folder / "fps.npz", {{"depth.npy", frames}, {"fps.npy", scalar(10)}}, true);
    const auto steady = depth_of_file(folder / "fps.npz");
    CHECK_THAT(steady->facts().frames_per_s, WithinAbs(10.0, 1e-9));
    CHECK(stated_by(steady->facts()) == DepthStatement{});
    write_zip(folder / "times.npz",
              {{"disparity.npy", frames},
               {"timestamps.npy", numbers("(3,)", {2.0, 2.5, 4.0})},
               {"K.npy", numbers("(3, 3)", {500, 0, 2, 0, 510, 1.5, 0, 0, 1})}},
              true);
    const auto source = depth_of_file(folder / "times.npz");
    CHECK(stated_by(source->facts()).unit == DepthUnit::disparity);
    CHECK(stated_by(source->facts()).intrinsics == Intrinsics{500, 510, 2, 1.5});
    CHECK(origins_of(source->facts().findings) == "array 'disparity', array 'K'");
    CHECK(source->facts().start_s == 2.0);
    CHECK(source->next()->time_s == 0.0);
    CHECK(source->next()->time_s == 0.5);
    CHECK(source->next()->time_s == 2.0);
}

TEST_CASE("times that do not rise, and rates that are none, are passed over", "[numpy]") {
    const TemporaryFolder folder;
    const std::string frames =
        npy("<f4", "(2, 3, 4)", data_of<float>(small(0)) + data_of<float>(small(1)));
    const std::string times = GENERATE(numbers("(2,)", {1, 1}), numbers("(2,)", {0, NAN}),
                                       numbers("(3,)", {0, 1, 2}), std::string("none"));
    const double rate = GENERATE(0.0, -5.0, static_cast<double>(INFINITY));
    write_zip(folder / "a.npz",
              {{"depth.npy", frames}, {"times.npy", times}, {"fps.npy", scalar(rate)}}, true);
    CHECK_THAT(depth_of_file(folder / "a.npz")->facts().frames_per_s, WithinAbs(30.0, 1e-9));
}

TEST_CASE("arrays of bytes are colours, and one .npz opens as colour and depth", "[numpy]") {
    const TemporaryFolder folder;
    std::string rgb;
    for (int k = 0; k < 12; ++k) rgb += std::string("\1\2\3", 3);
    const std::string colours = npy("|u1", "(3, 4, 3)", rgb);
    write_zip(folder / "both.npz", {{"images.npy", colours}, {"depths.npy", small_npy(1)}}, true);
    const auto frame = open_media(folder / "both.npz")->next();
    REQUIRE(frame);
    CHECK(frame->colour.rgb[0] == 1);
    CHECK(frame->colour.rgb[1] == 2);
    CHECK(frame->colour.rgb[2] == 3);
    CHECK(frame->depth.columns == 4);
    write_text(folder / "colours.npy", colours);
    CHECK(read_still(folder / "colours.npy", PictureRole::colour).picture.at<cv::Vec3b>(2, 3) ==
          cv::Vec3b(3, 2, 1));
    write_text(folder / "depth.npy", small_npy(1));
    CHECK(contains(refusal_of(folder / "depth.npy", PictureRole::colour), "no colours"));
}

TEST_CASE("colours of networks are real numbers, whose channels may come first", "[numpy]") {
    const TemporaryFolder folder;
    const float black = GENERATE(0.0F, -1.0F);
    std::string planes;
    for (const float part : {0.0F, 0.4F, 1.0F})
        for (int k = 0; k < 12; ++k) append_bytes(planes, black + part * (1.0F - black));
    write_text(folder / "a.npy", npy("<f4", "(1, 3, 3, 4)", planes));
    const auto colours_of = [&folder] {
        return read_still(folder / "a.npy", PictureRole::colour).picture.at<cv::Vec3b>(2, 3);
    };
    CHECK(colours_of() == cv::Vec3b(255, 102, 0));
    write_text(folder / "a.npy", npy("<f4", "(3, 4, 3)", planes));
    CHECK(colours_of() == cv::Vec3b(255, 255, 255));
    write_text(folder / "a.npy", npy("<f4", "(3, 4, 3)", std::string(36 * 4, '\x44')));
    CHECK(contains(refusal_of(folder / "a.npy", PictureRole::colour), "points or normals"));
}

TEST_CASE("what is no array of pictures is refused with its shape", "[numpy]") {
    const TemporaryFolder folder;
    const std::string shape = GENERATE("(12,)", "()", "(2, 1, 2, 3, 1, 1)", "(0, 3, 4)", "(3, 0)");
    CAPTURE(shape);
    write_text(folder / "a.npy", npy("<f4", shape, data_of<float>(small(0))));
    CHECK(contains(refusal_of(folder / "a.npy"), "save depth as"));
    const std::string type = GENERATE("|O", "<U3", "<c8", "|b1", "<f16", "V");
    write_text(folder / "a.npy", npy(type, "(3, 4)", data_of<float>(small(0))));
    CHECK(contains(refusal_of(folder / "a.npy"), "plain numbers"));
}

TEST_CASE("a mask and Python objects in a .npy are refused as what they are", "[numpy]") {
    const TemporaryFolder folder;
    write_text(folder / "a.npy", npy("|b1", "(3, 4)", std::string(12, '\1')));
    CHECK(contains(refusal_of(folder / "a.npy"), "true and false, as a mask does"));
    write_text(folder / "b.npy", npy("|O", "()", "pickled"));
    CHECK(contains(refusal_of(folder / "b.npy"), "numpy.load('b.npy', allow_pickle=True).item()"));
}

TEST_CASE("a header that claims more than the file holds is refused before memory is taken",
          "[numpy]") {
    const TemporaryFolder folder;
    const std::string shape =
        GENERATE("(10000, 10000)", "(1000000, 3, 4)", "(4294967296, 4294967296)",
                 "(9223372036854775807, 9223372036854775807, 3)", "(99999999999999999999, 2)");
    CAPTURE(shape);
    const std::string lie = npy("<f4", shape, data_of<float>(small(0)));
    write_text(folder / "a.npy", lie);
    CHECK_FALSE(refusal_of(folder / "a.npy").empty());
    write_zip(folder / "a.npz", {{"depth.npy", lie}}, true);
    CHECK_FALSE(refusal_of(folder / "a.npz").empty());
}

TEST_CASE("what numpy itself writes is read", "[numpy]") {
    const TemporaryFolder folder;
    const std::string program =
        "import numpy as np; d = np.arange(24, dtype=np.float16).reshape(2, 3, 4); "
        "np.save('" +
        (folder / "a.npy").string() +
        "', np.asfortranarray(d)); "
        "np.savez_compressed('" +
        (folder / "b.npz").string() +
        "', depths=d, fps=24); "
        "np.savez('" +
        (folder / "c.npz").string() + "', d)";
    REQUIRE(std::system(("/usr/bin/python3 -c \"" + program + "\"").c_str()) == 0);
    const std::string name = GENERATE("a.npy", "b.npz", "c.npz");
    const auto source = depth_of_file(folder / name);
    CHECK(different(source->next()->picture, small(0)) == 0);
    CHECK(different(source->next()->picture, small(12)) == 0);
    CHECK_THAT(source->facts().frames_per_s, WithinAbs(name == "b.npz" ? 24.0 : 30.0, 1e-9));
}

TEST_CASE("a list of points is no picture", "[numpy]") {
    const TemporaryFolder folder;
    const cv::Mat points(3000, 4, CV_32F, cv::Scalar(2.0));
    write_text(folder / "points.npy", npy("<f4", "(3000, 4)", data_of<float>(points)));
    const std::string said = refusal_of(folder / "points.npy");
    CHECK(contains(said, "a list of points or poses"));
    CHECK(contains(said, "numpy.load('points.npy')"));
}
