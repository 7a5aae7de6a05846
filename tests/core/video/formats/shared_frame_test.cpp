// What a video's decoder made is drawn as it is: each form of samples in its own matrix and range.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/video/formats/video_decoder.hpp"
#include "core/video/formats/video_file.hpp"
#include "core/video/frames/video_picture.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

/// Smooth colours that all matrices keep within red, green and blue.
std::string smooth(int columns, int rows, const std::string& format) {
    return "-f lavfi -i \"nullsrc=s=" + std::to_string(columns) + "x" + std::to_string(rows) +
           ":r=10:d=0.5,format=yuv444p,geq=lum='70+100*X/W':cb='105+24*Y/H':cr='150-20*X/W'," +
           "format=" + format + "\" ";
}

/// What the ffmpeg program shows of the first picture: red, green, blue.
std::vector<std::uint8_t> by_ffmpeg(const fs::path& file, const fs::path& raw) {
    ffmpeg("-i '" + file.string() +
           "' -frames:v 1 -sws_flags accurate_rnd+full_chroma_int+bilinear -pix_fmt rgb24 -f "
           "rawvideo '" +
           raw.string() + "'");
    const std::string bytes = read_text(raw);
    return {bytes.begin(), bytes.end()};
}

std::shared_ptr<const VideoPicture> first_of(const fs::path& file) {
    VideoDecoder decoder(file, 0);
    REQUIRE(decoder.decode());
    return decoder.shared(1.0);
}

/// As words, which NaN for no data compares equal in.
std::vector<std::uint32_t> bits_of(const DepthImage& depth) {
    std::vector<std::uint32_t> bits(depth.levels.size());
    std::transform(depth.levels.begin(), depth.levels.end(), bits.begin(),
                   [](float level) { return std::bit_cast<std::uint32_t>(level); });
    return bits;
}

/// The largest difference of a channel, away from the edges, where chroma goes on in other ways.
int apart(const VideoPicture& picture, const std::vector<std::uint8_t>& rgb) {
    REQUIRE(rgb.size() == std::size_t{3} * static_cast<std::size_t>(picture.columns) *
                              static_cast<std::size_t>(picture.rows));
    constexpr int kEdge = 3;
    int most = 0;
    for (int j = kEdge; j < picture.rows - kEdge; ++j)
        for (int i = kEdge; i < picture.columns - kEdge; ++i) {
            const auto seen = rgb_at(picture, i, j);
            for (std::size_t k = 0; k < 3; ++k)
                most = std::max(
                    most,
                    std::abs(int{seen[k]} -
                             int{rgb[3 * static_cast<std::size_t>(j * picture.columns + i) + k]}));
        }
    return most;
}

struct Coded {
    const char* format;
    const char* encoding;
    const char* ending;
};

}  // namespace

TEST_CASE("each form of samples is shared and has the colours that swscale gives it") {
    const Coded coded = GENERATE(
        Coded{"yuv420p", "-c:v ffv1", ".mkv"}, Coded{"yuv422p", "-c:v ffv1", ".mkv"},
        Coded{"yuv444p", "-c:v ffv1", ".mkv"}, Coded{"gray", "-c:v ffv1", ".mkv"},
        Coded{"gray10le", "-c:v ffv1", ".mkv"}, Coded{"yuv420p10le", "-c:v ffv1", ".mkv"},
        Coded{"yuv422p10le", "-c:v ffv1", ".mkv"}, Coded{"yuv444p12le", "-c:v ffv1", ".mkv"},
        Coded{"nv12", "-c:v rawvideo -allow_raw_vfw 1", ".mkv"},
        Coded{"yuvj420p", "-c:v mjpeg -q:v 1", ".avi"});
    const bool odd = GENERATE(false, true);
    CAPTURE(coded.format, odd);
    const TemporaryFolder folder;
    const fs::path file = folder / (std::string("clip") + coded.ending);
    ffmpeg(smooth(odd ? 65 : 64, odd ? 49 : 48, coded.format) + coded.encoding + " '" +
           file.string() + "'");
    const auto picture = first_of(file);
    REQUIRE(picture);
    CHECK(apart(*picture, by_ffmpeg(file, folder / "raw")) <= 3);
}

TEST_CASE("a stream that states its matrix and range is shown with these") {
    const std::string matrix =
        GENERATE(as<std::string>{}, "bt709", "bt2020nc", "smpte170m", "fcc", "smpte240m");
    const std::string range = GENERATE(as<std::string>{}, "tv", "pc");
    const std::string format = GENERATE(as<std::string>{}, "yuv444p", "yuv420p10le");
    CAPTURE(matrix, range, format);
    const TemporaryFolder folder;
    const fs::path file = folder / "clip.mkv";
    ffmpeg(smooth(64, 48, format) + "-c:v ffv1 -colorspace " + matrix + " -color_range " + range +
           " '" + file.string() + "'");
    const auto picture = first_of(file);
    REQUIRE(picture);
    CHECK(apart(*picture, by_ffmpeg(file, folder / "raw")) <= 3);
}

TEST_CASE("red green and blue and transparency and rare matrices are converted as before") {
    const Coded coded =
        GENERATE(Coded{"gbrp", "-c:v ffv1", ".mkv"}, Coded{"yuva420p", "-c:v ffv1", ".mkv"},
                 Coded{"yuv411p", "-c:v ffv1", ".mkv"},
                 Coded{"yuv444p", "-c:v ffv1 -colorspace ycgco", ".mkv"});
    CAPTURE(coded.format);
    const TemporaryFolder folder;
    const fs::path file = folder / "clip.mkv";
    ffmpeg(smooth(64, 48, coded.format) + coded.encoding + " '" + file.string() + "'");
    CHECK(first_of(file) == nullptr);
    VideoFile video(file, PictureRole::colour);
    video.share_video();
    const auto taken = video.next();
    REQUIRE(taken);
    CHECK(taken->picture.cols == 64);
    CHECK_FALSE(taken->video);
}

TEST_CASE("a picture for textures has the pixels of the shared one") {
    const Coded coded = GENERATE(
        Coded{"yuv420p", "-c:v ffv1", ""}, Coded{"yuv444p12le", "-c:v ffv1", ""},
        Coded{"gray", "-c:v ffv1", ""}, Coded{"nv12", "-c:v rawvideo -allow_raw_vfw 1", ""});
    const int step = GENERATE(1, 2, 3);
    CAPTURE(coded.format, step);
    const TemporaryFolder folder;
    const fs::path file = folder / "clip.mkv";
    ffmpeg(smooth(65, 49, coded.format) + coded.encoding + " '" + file.string() + "'");
    const auto picture = first_of(file);
    REQUIRE(picture);
    std::vector<std::uint32_t> rgbx;
    const auto [columns, rows] = write_rgbx(*picture, step, rgbx);
    REQUIRE(columns == 65 / step);
    REQUIRE(rows == 49 / step);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(rgbx.data());
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto pixel = rgb_at(*picture, i * step + step / 2, j * step + step / 2);
            const std::uint8_t* const seen = bytes + 4 * (std::ptrdiff_t{j} * columns + i);
            for (std::size_t k = 0; k < 3; ++k)
                REQUIRE(std::abs(int{pixel[k]} - int{seen[k]}) <= 1);
            REQUIRE(seen[3] == 255);
        }
}

TEST_CASE("a phone's video is shown upright where its planes lie turned") {
    const int degrees = GENERATE(90, 180, 270);
    CAPTURE(degrees);
    const TemporaryFolder folder;
    const fs::path lying = folder / "lying.mp4";
    const fs::path file = folder / "clip.mp4";
    ffmpeg(smooth(96, 64, "yuv420p") + "-c:v libx264 -crf 4 '" + lying.string() + "'");
    turn(lying, file, degrees);
    const auto picture = first_of(file);
    REQUIRE(picture);
    CHECK(picture->quarter_turns == degrees / 90);
    CHECK(picture->columns == (degrees == 180 ? 96 : 64));
    const ColourImage converted = picture->convert();
    REQUIRE(converted.columns == picture->columns);
    REQUIRE(converted.rows == picture->rows);
    CHECK(apart(*picture, converted.rgb) <= 3);
}

TEST_CASE("a change of size or of samples in a stream is followed") {
    const std::string second =
        GENERATE(as<std::string>{}, "-s 80x48", "-pix_fmt yuv444p -profile:v high444");
    CAPTURE(second);
    const TemporaryFolder folder;
    const fs::path file = folder / "clip.h264";
    std::string bytes;
    for (const std::string& form : {std::string("-pix_fmt yuv420p"), second}) {
        ffmpeg(smooth(64, 48, "yuv420p") + "-c:v libx264 -crf 4 -bf 0 " + form + " -f h264 '" +
               (folder / "part").string() + "'");
        bytes += read_text(folder / "part");
    }
    write_text(file, bytes);
    VideoFile video(file, PictureRole::colour);
    video.share_video();
    int count = 0;
    std::vector<std::array<int, 2>> sizes;
    while (const auto taken = video.next()) {
        REQUIRE(taken->video);
        const VideoPicture& picture = *taken->video;
        const ColourImage converted = picture.convert();
        CHECK(converted.columns == picture.columns);
        CHECK(apart(picture, converted.rgb) <= 3);
        const std::array<int, 2> size{picture.columns, picture.planes[1].columns};
        if (sizes.empty() || sizes.back() != size) sizes.push_back(size);
        ++count;
    }
    CHECK(count == 10);
    CHECK(sizes.size() == 2);
}

TEST_CASE("shared frames are converted to the bits that a reader without sharing gets") {
    const std::string encoding =
        GENERATE(as<std::string>{}, kH264, kVp9, "-c:v ffv1 -pix_fmt yuv444p -aspect 2:1");
    CAPTURE(encoding);
    const TemporaryFolder folder;
    const fs::path colour = folder / "clip.mkv";
    const fs::path depth = folder / "clip_depth.mkv";
    ffmpeg("-f lavfi -i testsrc2=s=66x50:r=10:d=1 " + encoding + " '" + colour.string() + "'");
    make_flat_clip(depth, 10, 10, kLossless, "", 66, 50);
    const auto plain = open_media(colour, depth);
    auto shared = open_media(colour, depth);
    shared->share_video();
    std::vector<std::shared_ptr<const VideoPicture>> pictures;
    std::vector<ColourImage> expected;
    const auto take = [&] {
        const auto before = plain->next();
        const auto frame = shared->next();
        REQUIRE(before.has_value() == frame.has_value());
        if (!frame) return;
        CHECK(frame->media_s == before->media_s);
        CHECK(frame->colour.rgb.empty());
        REQUIRE(frame->video);
        CHECK(frame->video->columns == before->colour.columns);
        CHECK(frame->video->rows == before->colour.rows);
        pictures.push_back(frame->video);
        expected.push_back(before->colour);
    };
    for (int n = 0; n < 10; ++n) take();
    for (const double to_s : {0.3, 0.8, 0.2}) {
        plain->seek(to_s);
        shared->seek(to_s);
        take();
    }
    shared.reset();  // pictures outlive their file
    REQUIRE(pictures.size() == 13);
    for (std::size_t k = 0; k < pictures.size(); ++k)
        CHECK(pictures[k]->convert().rgb == expected[k].rgb);
}

TEST_CASE(
    "a depth video of any range and size gives the same levels with shared frames as without") {
    const std::string encoding =
        GENERATE(as<std::string>{}, "-pix_fmt yuv420p -color_range tv -c:v libx264 -qp 0",
                 "-pix_fmt yuv420p -color_range pc -c:v libx264 -qp 0",
                 "-pix_fmt yuv420p -c:v libx264 -crf 30",
                 "-pix_fmt yuv420p10le -color_range tv -c:v libx265 -x265-params log-level=none",
                 "-pix_fmt yuv420p -color_range tv -c:v libx264 -qp 0 -aspect 3:1");
    const DepthStatement said =
        GENERATE(DepthStatement{.near = NearLevels::bright},
                 DepthStatement{.near = NearLevels::dark, .range = DepthRange{30.0, 200.0}},
                 DepthStatement{.unit = DepthUnit::disparity, .scale = 0.1},
                 DepthStatement{.unit = DepthUnit::mm, .scale = 10.0, .no_data = {{0.0}}});
    CAPTURE(encoding);
    const TemporaryFolder folder;
    const fs::path file = folder / "clip_depth.mp4";
    ffmpeg("-f lavfi -i testsrc2=s=66x50:r=10:d=1 -vf format=gray " + encoding + " '" +
           file.string() + "'");
    const DepthRequest request{.find_out = true, .command_line = said};
    const auto plain = open_media({}, file, request);
    const auto shared = open_media({}, file, request);
    shared->share_video();
    const auto check_next = [&] {
        const auto expected = plain->next();
        const auto frame = shared->next();
        REQUIRE(expected.has_value());
        REQUIRE(frame.has_value());
        CHECK(frame->media_s == expected->media_s);
        CHECK(bits_of(frame->depth) == bits_of(expected->depth));
        CHECK(frame->depth.highest_level == expected->depth.highest_level);
    };
    for (int n = 0; n < 5; ++n) check_next();
    for (const double to_s : {0.8, 0.2}) {
        plain->seek(to_s);
        shared->seek(to_s);
        check_next();
    }
}

TEST_CASE(
    "a reader's frames have the colour of the video also for those who need red green and blue") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "clip_color.mp4", 10, 10, kH264);
    make_flat_clip(folder / "clip_depth.mkv", 10, 10, kLossless);
    FrameReader reader(open_media(folder / "clip_color.mp4", folder / "clip_depth.mkv"));
    const auto frame = reader.at(0.5);
    REQUIRE(frame);
    REQUIRE(frame->video);
    CHECK(frame->has_colour());
    CHECK(frame->colour_bytes() >= std::size_t{64} * 48 * 3 / 2);
    const auto rgb = frame->rgb();
    REQUIRE(rgb);
    CHECK(rgb->columns == 64);
    CHECK(std::lround(rgb->rgb[rgb->rgb.size() / 2] / 5.0) == 5);
}
