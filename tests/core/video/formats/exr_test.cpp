// OpenEXR pictures: which channel is depth, what its numbers are, and where there is none.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
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

namespace {

namespace fs = std::filesystem;

/// Channels by name, all of one size; they go by 32-bit floats into the file's own type.
using Channels = std::map<std::string, cv::Mat>;

Imf::Header header_of(const Channels& channels, Imf::PixelType type = Imf::FLOAT,
                      Imf::Compression compression = Imf::ZIP_COMPRESSION) {
    const cv::Mat& first = channels.begin()->second;
    Imf::Header header(first.cols, first.rows);
    header.compression() = compression;
    for (const auto& channel : channels) header.channels().insert(channel.first, type);
    return header;
}

/// In the channels' own type; they live as long as the buffer.
struct Buffered {
    std::vector<cv::Mat> kept{};
    std::vector<std::vector<Imath::half>> halves{};
    Imf::FrameBuffer buffer{};
};

Buffered buffered(const Channels& channels, const Imf::Header& header) {
    Buffered all;
    all.kept.reserve(channels.size());
    all.halves.reserve(channels.size());
    for (const auto& channel : channels) {
        const Imf::PixelType type = header.channels()[channel.first].type;
        cv::Mat own = channel.second.clone();
        if (type == Imf::UINT) own.convertTo(own, CV_32S);
        all.kept.push_back(own);
        void* data = all.kept.back().data;
        std::size_t bytes = 4;
        if (type == Imf::HALF) {
            all.halves.emplace_back(own.begin<float>(), own.end<float>());
            data = all.halves.back().data();
            bytes = 2;
        }
        all.buffer.insert(channel.first,
                          Imf::Slice::Make(type, data, header.dataWindow(), bytes,
                                           bytes * static_cast<std::size_t>(own.cols)));
    }
    return all;
}

void write_exr(const Channels& channels, const Imf::Header& header, const fs::path& file) {
    const Buffered all = buffered(channels, header);
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(all.buffer);
    out.writePixels(channels.begin()->second.rows);
}

void write_exr(const Channels& channels, const fs::path& file) {
    write_exr(channels, header_of(channels), file);
}

cv::Mat flat(float value) {
    return {6, 8, CV_32FC1, cv::Scalar::all(value)};
}

cv::Mat depth_in(const fs::path& file) {
    return read_still(file, PictureRole::depth).picture;
}

int different(const cv::Mat& a, const cv::Mat& b) {
    REQUIRE(a.size() == b.size());
    REQUIRE(a.type() == b.type());
    return cv::countNonZero(a.reshape(1) != b.reshape(1));
}

}  // namespace

TEST_CASE("every level of an EXR file is kept, however it is packed", "[exr]") {
    const TemporaryFolder folder;
    const auto type = GENERATE(Imf::FLOAT, Imf::HALF);
    const auto compression =
        GENERATE(Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                 Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::DWAB_COMPRESSION);
    CAPTURE(type, compression);
    const Channels channels{{"Z", scene()}};
    write_exr(channels, header_of(channels, type, compression), folder / "z.exr");
    const StillPicture still = read_still(folder / "z.exr", PictureRole::depth);
    CHECK(still.bits == kRealBits);
    CHECK(still.codec == "EXR");
    CHECK(stated_by(still).unit == DepthUnit::m);
    CHECK(origins_of(still.findings) == "EXR channel Z");
    CHECK(different(still.picture, scene()) == 0);
}

TEST_CASE("whole numbers and tiles in EXR files are read", "[exr]") {
    const TemporaryFolder folder;
    cv::Mat levels(kSceneRows, kSceneColumns, CV_32FC1);
    for (int j = 0; j < levels.rows; ++j)
        for (int i = 0; i < levels.cols; ++i)
            levels.at<float>(j, i) = static_cast<float>(scene_level(i, j));
    const Channels channels{{"Z", levels}};
    write_exr(channels, header_of(channels, Imf::UINT), folder / "uint.exr");
    CHECK(different(depth_in(folder / "uint.exr"), levels) == 0);
    Imf::Header header = header_of(channels);
    header.setTileDescription({32, 16, Imf::MIPMAP_LEVELS});
    const Buffered all = buffered(channels, header);
    {
        Imf::TiledOutputFile out((folder / "tiles.exr").c_str(), header);
        out.setFrameBuffer(all.buffer);
        out.writeTiles(0, out.numXTiles(0) - 1, 0, out.numYTiles(0) - 1, 0);
        for (int level = 1; level < out.numLevels(); ++level) {
            const cv::Mat nothing(out.levelHeight(level), out.levelWidth(level), CV_32FC1,
                                  cv::Scalar::all(0));
            Imf::FrameBuffer buffer;
            buffer.insert("Z", Imf::Slice::Make(Imf::FLOAT, nothing.data,
                                                out.dataWindowForLevel(level), 4, nothing.step[0]));
            out.setFrameBuffer(buffer);
            out.writeTiles(0, out.numXTiles(level) - 1, 0, out.numYTiles(level) - 1, level);
        }
    }
    CHECK(different(depth_in(folder / "tiles.exr"), levels) == 0);
}

TEST_CASE("the display window is the picture, and outside the data window is no data", "[exr]") {
    const TemporaryFolder folder;
    const Channels channels{{"Z", scene()}};
    Imf::Header header = header_of(channels);
    header.dataWindow() = {{-20, 30}, {kSceneColumns - 21, kSceneRows + 29}};
    header.displayWindow() = {{0, 0}, {399, 199}};
    write_exr(channels, header, folder / "windows.exr");
    const cv::Mat depth = depth_in(folder / "windows.exr");
    REQUIRE(depth.size() == cv::Size(400, 200));
    int wrong = 0;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 400; ++x) {
            const float value = depth.at<float>(y, x);
            const bool inside = x + 20 < kSceneColumns && y >= 30;
            wrong +=
                inside ? value != scene_depth(scene_level(x + 20, y - 30)) : !std::isnan(value);
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("windows that do not meet hold no data", "[exr]") {
    const TemporaryFolder folder;
    const Channels channels{{"Z", flat(2)}};
    Imf::Header header = header_of(channels);
    header.dataWindow() = {{100, 100}, {107, 105}};
    write_exr(channels, header, folder / "apart.exr");
    const cv::Mat depth = depth_in(folder / "apart.exr");
    CHECK(depth.size() == cv::Size(8, 6));
    CHECK(cv::countNonZero(depth == depth) == 0);
}

TEST_CASE("depth is the channel that names it, not a coordinate of something else", "[exr]") {
    const TemporaryFolder folder;
    const auto [names, wanted, from] = GENERATE(table<std::vector<std::string>, int, std::string>({
        {{"A", "Z"}, 1, "EXR channel Z"},
        {{"B", "G", "R", "Z"}, 3, "EXR channel Z"},
        {{"Normal.X", "Normal.Y", "Normal.Z", "View.Depth.Z"}, 3, "EXR channel View.Depth.Z"},
        {{"Alpha.Z", "depth.Z"}, 1, "EXR channel depth.Z"},
        {{"Depth.V", "UV.U", "UV.V"}, 0, ""},
        {{"V"}, 0, ""},
        {{"Y"}, 0, ""},
        {{"R"}, 0, ""},
    }));
    CAPTURE(names);
    Channels channels;
    for (std::size_t k = 0; k < names.size(); ++k)
        channels[names[k]] = flat(static_cast<float>(k) + 1);
    write_exr(channels, folder / "named.exr");
    const StillPicture still = read_still(folder / "named.exr", PictureRole::depth);
    CHECK(different(still.picture, flat(static_cast<float>(wanted) + 1)) == 0);
    CHECK(origins_of(still.findings) == from);
    CHECK(stated_by(still).unit.has_value() == !from.empty());
}

TEST_CASE("colours alone are depth where they are grey, and stay colours where not", "[exr]") {
    const TemporaryFolder folder;
    write_exr({{"R", flat(3)}, {"G", flat(3)}, {"B", flat(3)}}, folder / "grey.exr");
    CHECK(different(depth_in(folder / "grey.exr"), flat(3)) == 0);
    write_exr({{"R", flat(1)}, {"G", flat(2)}, {"B", flat(3)}}, folder / "colours.exr");
    const cv::Mat colours = depth_in(folder / "colours.exr");
    REQUIRE(colours.type() == CV_32FC3);
    CHECK(colours.at<cv::Vec3f>(5, 7) == cv::Vec3f(3, 2, 1));
}

TEST_CASE("the only channel of colours that is not empty is depth", "[exr]") {
    const TemporaryFolder folder;
    write_exr({{"R", flat(3)}, {"G", flat(0)}, {"B", flat(0)}}, folder / "red.exr");
    CHECK(different(depth_in(folder / "red.exr"), flat(3)) == 0);
}

TEST_CASE("a renderer's infinity, and what is no number, is no data", "[exr]") {
    const TemporaryFolder folder;
    cv::Mat depth = flat(2);
    depth.at<float>(0, 0) = 1e10F;
    depth.at<float>(1, 1) = std::numeric_limits<float>::infinity();
    depth.at<float>(2, 2) = std::numeric_limits<float>::quiet_NaN();
    write_exr({{"Z", depth}}, folder / "far.exr");
    const cv::Mat read = depth_in(folder / "far.exr");
    CHECK(cv::countNonZero(read == 2.0) == 45);
    for (int k = 0; k < 3; ++k) CHECK(std::isnan(read.at<float>(k, k)));
}

TEST_CASE("one EXR file of colours and Z opens as both, its colours as a screen shows them",
          "[exr]") {
    const TemporaryFolder folder;
    write_exr({{"R", flat(1)}, {"G", flat(0.5)}, {"B", flat(0)}, {"Z", flat(2)}},
              folder / "both.exr");
    CHECK(exr_has_colour_and_depth(folder / "both.exr"));
    const auto media = open_media(folder / "both.exr");
    CHECK(media->description().depth_columns == 8);
    CHECK(media->description().colour_columns == 8);
    const auto frame = media->next();
    REQUIRE(frame);
    CHECK(frame->colour.rgb[0] == 255);
    CHECK(frame->colour.rgb[1] == 188);  // the sRGB transfer of one half
    CHECK(frame->colour.rgb[2] == 0);
    CHECK(describe_media(folder / "both.exr").depth_bits == kRealBits);
}

TEST_CASE("parts of an EXR file are looked through for their channels", "[exr]") {
    const TemporaryFolder folder;
    const Channels colours{{"B", flat(0)}, {"G", flat(0)}, {"R", flat(1)}};
    const Channels depth{{"Z", flat(4)}};
    std::vector<Imf::Header> headers{header_of(colours), header_of(depth)};
    headers[0].setName("beauty");
    headers[1].setName("depth");
    for (Imf::Header& header : headers) header.setType(Imf::SCANLINEIMAGE);
    {
        Imf::MultiPartOutputFile out((folder / "parts.exr").c_str(), headers.data(), 2);
        const Buffered first = buffered(colours, headers[0]);
        const Buffered second = buffered(depth, headers[1]);
        Imf::OutputPart beauty(out, 0);
        beauty.setFrameBuffer(first.buffer);
        beauty.writePixels(6);
        Imf::OutputPart behind(out, 1);
        behind.setFrameBuffer(second.buffer);
        behind.writePixels(6);
    }
    CHECK(exr_has_colour_and_depth(folder / "parts.exr"));
    CHECK(different(depth_in(folder / "parts.exr"), flat(4)) == 0);
    CHECK(read_still(folder / "parts.exr", PictureRole::colour).picture.at<cv::Vec3b>(0, 0) ==
          cv::Vec3b(0, 0, 255));
}

TEST_CASE("an EXR file without what is asked for says what is lacking", "[exr]") {
    const TemporaryFolder folder;
    write_exr({{"Z", flat(1)}}, folder / "z.exr");
    write_exr({{"A", flat(1)}}, folder / "a.exr");
    CHECK_FALSE(exr_has_colour_and_depth(folder / "z.exr"));
    CHECK(contains(refusal([&] { (void)read_still(folder / "z.exr", PictureRole::colour); }),
                   "no channels R, G and B"));
    CHECK(contains(refusal([&] { (void)depth_in(folder / "a.exr"); }), "no channel Z, V, Y or R"));
}
