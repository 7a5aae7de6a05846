// Files of every form of still picture that are cut off, lie or hold no numbers: a picture, or one
// plain line.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

cv::Mat slope(float begin, float step) {
    cv::Mat values(24, 32, CV_32FC1);
    for (int j = 0; j < values.rows; ++j)
        for (int i = 0; i < values.cols; ++i)
            values.at<float>(j, i) = begin + step * static_cast<float>(32 * j + i);
    return values;
}

std::string data_of(const cv::Mat& values) {
    return {values.ptr<char>(), values.total() * values.elemSize()};
}

void write_exr(const cv::Mat& values, const fs::path& file) {
    Imf::Header header(values.cols, values.rows);
    header.channels().insert("Z", Imf::FLOAT);
    Imf::FrameBuffer buffer;
    buffer.insert(
        "Z", Imf::Slice::Make(Imf::FLOAT, values.data, header.dataWindow(), 4, values.step[0]));
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(values.rows);
}

/// The values in each form but HEIC, which holds no real numbers, as files in the folder.
std::vector<fs::path> in_all_forms(const cv::Mat& values, const TemporaryFolder& folder) {
    const std::string array = npy("<f4", "(24, 32)", data_of(values));
    write_exr(values, folder / "a.exr");
    write_text(folder / "a.pfm", pfm(values, "-1", true));
    write_text(folder / "a.npy", array);
    write_zip(folder / "stored.npz", {{"depth.npy", array}}, false);
    write_zip(folder / "deflated.npz", {{"depth.npy", array}}, true);
    write_text(folder / "a.tiff", tiff(32, 24, 32, 3, true, data_of(values)));
    return {folder / "a.exr",      folder / "a.pfm",        folder / "a.npy",
            folder / "stored.npz", folder / "deflated.npz", folder / "a.tiff"};
}

/// Opens the file in every way. A refusal is one line that names the file; whatever else is thrown
/// fails the test.
void require_picture_or_line(const fs::path& file) {
    CAPTURE(file);
    for (const auto role : {PictureRole::depth, PictureRole::colour}) {
        const std::string said = refusal([&] {
            const auto source = open_picture_source(file, role);
            while (const auto taken = source->next()) {
                if (taken->picture.size() !=
                    cv::Size(source->facts().columns, source->facts().rows))
                    throw std::logic_error("a picture of another size than was told");
            }
        });
        REQUIRE(std::count(said.begin(), said.end(), '\n') == 0);
        REQUIRE((said.empty() || said.find(file.filename().string()) != std::string::npos));
        REQUIRE((said.empty() || said.find(": ") != std::string::npos));
    }
    (void)refusal([&] { (void)describe_media(file); });
    (void)refusal([&] { (void)read_bump_map(file); });
}

/// Each file cut off after every 64th byte.
void require_sound_when_cut(const fs::path& file, const TemporaryFolder& folder) {
    const std::string whole = read_text(file);
    const fs::path part = folder / ("part" + file.extension().string());
    for (std::size_t bytes = 0; bytes < whole.size(); bytes += 64) {
        write_text(part, whole.substr(0, bytes));
        require_picture_or_line(part);
    }
}

}  // namespace

TEST_CASE("a picture cut off anywhere is refused in one line or shown", "[malformed]") {
    const TemporaryFolder folder;
    for (const fs::path& file : in_all_forms(slope(0.5F, 0.001F), folder))
        require_sound_when_cut(file, folder);
}

TEST_CASE("a photo cut off anywhere is refused in one line or shown", "[malformed][heif]") {
    const TemporaryFolder folder;
    write_photo({.colour = "color=red:s=64x48", .depth = "color=gray:s=32x24"}, folder / "a.heic");
    require_sound_when_cut(folder / "a.heic", folder);
}

TEST_CASE("arrays, float maps and EXR files that lost their last byte are refused", "[malformed]") {
    const TemporaryFolder folder;
    for (const fs::path& file : in_all_forms(slope(0.5F, 0.001F), folder)) {
        if (file.extension() == ".tiff") continue;  // its last bytes mean nothing
        CAPTURE(file);
        fs::resize_file(file, fs::file_size(file) - 1);
        CHECK_FALSE(refusal([&] { (void)read_still(file, PictureRole::depth); }).empty());
    }
}

TEST_CASE("pictures without one number are pictures without data", "[malformed]") {
    const TemporaryFolder folder;
    const float nothing =
        GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                 -std::numeric_limits<float>::infinity());
    const cv::Mat values(24, 32, CV_32FC1, cv::Scalar::all(nothing));
    for (const fs::path& file : in_all_forms(values, folder)) {
        CAPTURE(file, nothing);
        const cv::Mat picture = read_still(file, PictureRole::depth).picture;
        REQUIRE(picture.size() == cv::Size(32, 24));
        CHECK(std::none_of(picture.begin<float>(), picture.end<float>(),
                           [](float level) { return std::isfinite(level); }));
        require_picture_or_line(file);
    }
}

TEST_CASE("a header of 100 megapixels or more without their data is refused", "[malformed]") {
    const TemporaryFolder folder;
    const std::uint32_t side = GENERATE(10000U, 40000U, 2000000000U);
    const std::string text = std::to_string(side);
    CAPTURE(side);
    const auto refused = [&](const std::string& name, const std::string& bytes) {
        CAPTURE(name);
        write_text(folder / name, bytes);
        CHECK_FALSE(refusal([&] { (void)read_still(folder / name, PictureRole::depth); }).empty());
        require_picture_or_line(folder / name);
    };
    refused("a.pfm", "Pf\n" + text + " " + text + "\n-1\n" + std::string(64, '\0'));
    refused("a.npy", npy("<f4", "(" + text + ", " + text + ")", std::string(64, '\0')));
    refused("a.tiff", tiff(static_cast<int>(side), static_cast<int>(side), 32, 3, true, "none"));
    write_exr(slope(1, 1), folder / "small.exr");
    std::string exr = read_text(folder / "small.exr");
    std::string corner;
    append_bytes(corner, side - 1);
    for (const std::string window : {"dataWindow", "displayWindow"}) {
        const std::size_t at = exr.find(window) + window.size() + 1 + 6 + 4 + 8;  // type, size, min
        exr.replace(at, 4, corner).replace(at + 4, 4, corner);
    }
    refused("a.exr", exr);
}

TEST_CASE("a photo that claims another size is refused or shown", "[malformed][heif]") {
    const TemporaryFolder folder;
    write_photo({.depth = "color=gray:s=32x24"}, folder / "a.heic");
    std::string photo = read_text(folder / "a.heic");
    const std::string side = GENERATE(std::string("\0\0\x27\x10", 4),
                                      std::string("\x7f\xff\xff\xff"), std::string(4, '\0'));
    for (std::size_t at = photo.find("ispe"); at != std::string::npos;
         at = photo.find("ispe", at + 1))
        photo.replace(at + 8, 4, side).replace(at + 12, 4, side);
    write_text(folder / "lie.heic", photo);
    (void)refusal([&] { (void)read_still(folder / "lie.heic", PictureRole::depth); });
    (void)refusal([&] { (void)read_still(folder / "lie.heic", PictureRole::colour); });
    SUCCEED();
}
