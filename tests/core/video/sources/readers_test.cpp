// Which reader a place belongs to: one list, asked from its first to its last.
#include "core/video/sources/readers.hpp"

#include <filesystem>
#include <string>

#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

TEST_CASE("a file belongs to the reader of its form by how it begins, whatever it is called",
          "[readers]") {
    const TemporaryFolder folder;
    const std::string rest(64, '\0');
    const auto [begin, form] = GENERATE_COPY(table<std::string, std::string>(
        {{"SQLite format 3", "bag of ROS 2"},
         {"\x89MCAP0\r\n", "bag of ROS 2"},
         {std::string("\0\0\0\x18", 4) + "ftypisom", "video in a usual container"},
         {"\x1a\x45\xdf\xa3", "video in a usual container"},
         {"RIFF----AVI ", "video in a usual container"},
         {"\x93NUMPY", "numpy arrays"},
         {"\x76\x2f\x31\x01", "OpenEXR picture"},
         {"Pf\n2 2\n-1\n", "portable float map"},
         {std::string("\0\0\0\x18", 4) + "ftypheic", "HEIC photo"},
         {"RIFF----WEBP", "picture by OpenCV's codecs"},
         {"\x89PNG\r\n\x1a\n", "picture by OpenCV's codecs"},
         {"\1\2\3", "video by libav"}}));
    CAPTURE(form);
    write_text(folder / "take.bin", begin + rest);
    CHECK(reader_of(folder / "take.bin").name == form);
    write_text(folder / "take.npy", begin + rest);
    CHECK(reader_of(folder / "take.npy").name == form);
}

TEST_CASE("magic bytes decide before the content: a picture of letters alone is a picture",
          "[readers]") {
    const TemporaryFolder folder;
    // The numbers' bytes are letters: 12.07.
    write_text(folder / "flat.pfm", "Pf\n4 3\n-1\n" + std::string(48, 'A'));
    CHECK(reader_of(folder / "flat.pfm").name == "portable float map");
    CHECK(read_still(folder / "flat.pfm", PictureRole::depth).picture.cols == 4);
    write_text(folder / "flat.y4m",
               "YUV4MPEG2 W16 H16 F10:1 Ip A1:1 C420\nFRAME\n" + std::string(384, 'A'));
    CHECK(open_picture_source(folder / "flat.y4m", PictureRole::depth)->facts().columns == 16);
    write_text(folder / "list.y4m", "#EXTM3U\nother.mp4\n");
    CHECK(contains(refusal([&] { (void)reader_of(folder / "list.y4m"); }), "holds text"));
}

TEST_CASE("folders, lists and patterns are rows of pictures, but for a bag's folder", "[readers]") {
    const TemporaryFolder folder;
    CHECK(reader_of(folder.path()).name == "row of pictures");
    CHECK(reader_of(folder / "depth_%04d.png").name == "row of pictures");
    write_text(folder / "depth.txt", "0.5 depth/0.5.png\n");
    CHECK(reader_of(folder / "depth.txt").name == "row of pictures");
    write_text(folder / GENERATE("walk_0.db3", "walk_0.mcap"), "any");
    CHECK(reader_of(folder.path()).form == PictureForm::bag);
}

TEST_CASE("what no reader could read is refused before any is asked", "[readers]") {
    const TemporaryFolder folder;
    CHECK(contains(refusal([&] { (void)reader_of(folder / "none.png"); }), "does not exist"));
    write_text(folder / "words.npy", "only words\n");
    CHECK(contains(refusal([&] { (void)reader_of(folder / "words.npy"); }), "holds text"));
}
