// Recordings that only their maker's programs read are named, and what to do is said.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

template <typename Number>
std::string raw_bytes_of(const std::vector<Number>& numbers) {
    std::string bytes;
    for (const Number number : numbers) append_bytes(bytes, number);
    return bytes;
}

/// Depth of MPI Sintel, 3 x 2 pixels: 1 to 6 m; with more bytes a pixel it is optical flow.
std::string sintel(std::size_t pixel_bytes) {
    std::string bytes = "PIEH" + raw_bytes_of<std::int32_t>({3, 2});
    for (std::size_t k = 0; k < 6 * pixel_bytes / 4; ++k)
        append_bytes(bytes, static_cast<float>(k + 1));
    return bytes;
}

/// The text with another for each place where it holds the part.
std::string replaced(std::string text, const std::string& part, const std::string& by) {
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + by.size()))
        text.replace(at, part.size(), by);
    return text;
}

/// Runs the command of a refusal where the file is.
void convert(const std::string& refused, const TemporaryFolder& folder) {
    const std::string command = refused.substr(refused.find("python3 -c"));
    const std::string whole = command.substr(0, command.find('"', command.find('"') + 1) + 1);
    REQUIRE(std::system(("cd '" + folder.path().string() + "' && /usr/bin/" + whole).c_str()) == 0);
}

}  // namespace

TEST_CASE("recordings of other makers are known by their content, and told how to convert",
          "[foreign]") {
    const TemporaryFolder folder;
    const std::string zip = "PK\x03\x04" + std::string(40, '\0');
    const std::string rest_of_realsense = std::string(60, '\0') + "/device_0/sensor_0/Depth_0";
    const auto [name, bytes, words] = GENERATE_COPY(table<std::string, std::string, std::string>(
        {{"walk.bag", "#ROSBAG V2.0\nE" + std::string(60, '\0'), "rosbags-convert"},
         {"renamed.mp4", "#ROSBAG V2.0\nE" + std::string(60, '\0'), "rosbags-convert"},
         {"take.bag", "#ROSBAG V2.0\nE" + rest_of_realsense, "rs-convert -i take.bag"},
         {"scan.r3d", zip, "Record3D"},
         {"renamed.zip2", zip + std::string(100'000, 'x') + "metadata PK rgbd/0.depth", "Record3D"},
         {"frames.depthviewer", zip, "DepthViewer"},
         {"frames.zip", zip, "unpack"},
         {"zed.svo", std::string(60, '\1'), "ZED"},
         {"zed.svo2", "\x89MCAP0\r\n" + std::string(60, '\0'), "ZED"},
         {"old.oni", "NI10" + std::string(60, '\0'), "OpenNI"},
         {"telegie.mkv", "\x1a\x45\xdf\xa3" + std::string(60, '\0') + "V_TDC1", "pyrgbd"},
         {"walk.db3.zstd", "\x28\xb5\x2f\xfd" + std::string(60, '\0'), "zstd -d"}}));
    CAPTURE(name);
    write_text(folder / name, bytes);
    const std::string said = refusal([&, file = folder / name] { (void)open_depth(file); });
    CHECK(contains(said, words));
    CHECK(contains(said, name));
    CHECK(said.find('\n') == std::string::npos);
    CHECK(said == refusal([&, file = folder / name] { (void)open_media(file); }));
    CHECK(said == refusal([&, file = folder / name] { (void)describe_media(file); }));
}

TEST_CASE("what is no picture of depth is named for what it is, with the command that converts it",
          "[foreign]") {
    const TemporaryFolder folder;
    const std::string rest(600, '\0');
    const auto [name, bytes, form, way] =
        GENERATE_COPY(table<std::string, std::string, std::string, std::string>(
            {{"frames.h5", "\x89HDF\r\n\x1a\n" + rest, "HDF5", "h5py.File('frames.h5')"},
             {"renamed.mp4", "\x89HDF\r\n\x1a\n" + rest, "HDF5", "h5py.File('renamed.mp4')"},
             {"nyu.mat", "MATLAB 7.3 MAT-file, Platform" + rest, "MATLAB", "h5py.File('nyu.mat')"},
             {"old.mat", "MATLAB 5.0 MAT-file, Platform" + rest, "MATLAB", "loadmat('old.mat')"},
             {"touch.tmd", "Binary TrueMap Data File v2.0\r\n" + rest, "GelSight", "height.npy"},
             {"scan.ply", "ply\nformat ascii 1.0\n", "point cloud", "CloudCompare"},
             {"scan.pcd", "# .PCD v0.7\nVERSION 0.7\n", "point cloud", "CloudCompare"},
             {"field.las", "LASF" + rest, "point cloud", "pdal translate field.las"},
             {"field.laz", "LASF" + rest, "point cloud", "pdal translate field.laz"},
             {"room.xyz", "1 2 3\n4 5 6\n", "point cloud", "CloudCompare"},
             {"hill.asc", "ncols 3\nnrows 2\n", "heights", "gdal_translate hill.asc"},
             {"N46E007.hgt", std::string(2000, '\1'), "heights", "gdal_translate N46E007.hgt"},
             {"paper.pdf", "%PDF-1.5\n" + rest, "PDF", "pdfimages -png paper.pdf"},
             {"frame.raw", std::string(2000, '\2'), "without a header",
              "numpy.fromfile('frame.raw'"},
             {"frame.csv", "0.5,0.25\n0.75,1\n", "table", "numpy.genfromtxt('frame.csv'"},
             {"set.tar", std::string(257, 'a') + "ustar" + rest, "archive", "tar -xf set.tar"},
             {"set.tar.gz", "\x1f\x8b" + rest, "gzip", "gzip -dk set.tar.gz"},
             {"renamed.bin", "PK\x03\x04" + rest, "zip", "unzip renamed.bin"},
             {"depth.npy", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n",
              "pointer of Git LFS", "git lfs pull"},
             {"depth.exr", "<!DOCTYPE html><html><body>Not Found</body></html>", "a web page",
              "download it again"},
             {"island.ter", "TERRAGENTERRAIN SIZE" + rest, "heights", "gdal_translate island.ter"},
             {"bullet.x3p", "PK\x03\x04" + rest, "X3P", "zipfile.ZipFile('bullet.x3p')"},
             {"tip.gwy", "GWYP" + rest, "Gwyddion", "height.gsf"},
             {"depth_3x2_0001.rvl", std::string(41, '\3'), "RVL", "s = (2, 3)"},
             {"depth_0001.rvl", std::string(41, '\3'), "RVL", "with its own rows and columns"},
             {"terrain.r16", std::string(2 * 17 * 17, '\1'), "heights of 16 bits",
              "'<u2').reshape(17, 17)"},
             {"Depth_16x10_123.raw", std::string(320, '\2'), "without a header",
              "'<u2').reshape(10, 16)"},
             {"kinect.raw", std::string(2 * 512 * 424, '\2'), "without a header",
              "'<u2').reshape(424, 512)"},
             {"my frames.tar", std::string(257, 'a') + "ustar" + rest, "archive",
              "tar -xf 'my frames.tar'"},
             {"depth.pt", "PK\x03\x04" + rest, "PyTorch", "torch.load('depth.pt'"},
             {"k.xef", "EVENTS1" + rest, "Kinect Studio", "xefextract"},
             {"frame_0001.flo", sintel(8), "optical flow", "dibhr help depth"},
             {"frame_0001.dpt", sintel(4).substr(0, 30), "Sintel", "copy it again"},
             {"a.jpg.geometric.bin", "3&2&3&" + rest.substr(0, 72), "normals", "depth_maps"},
             {"sweep.pcd.bin", raw_bytes_of<float>({1.5F, 2.0F, 0.25F, 9.0F, 3.0F}), "LiDAR",
              "numpy.fromfile('sweep.pcd.bin', '<f4').reshape(-1, 5)"},
             {"my $(frames).h5", "\x89HDF\r\n\x1a\n" + rest, "HDF5", "h5py.File('FILE')"}}));
    CAPTURE(name);
    write_text(folder / name, bytes);
    const std::string said = refusal([&, file = folder / name] { (void)open_depth(file); });
    CHECK(contains(said, form));
    CHECK(contains(said, way));
    CHECK(said.find('\n') == std::string::npos);
    CHECK(said == refusal([&, file = folder / name] { (void)open_media(file); }));
    CHECK(said == refusal([&, file = folder / name] { (void)describe_media(file); }));
}

TEST_CASE("the command for a height map of GelSight gives its heights", "[foreign]") {
    const TemporaryFolder folder;
    std::string bytes = std::string("Binary TrueMap Data File v2.0\r\n\0made here\0", 42);
    for (const std::uint32_t side : {3U, 2U}) append_bytes(bytes, side);
    for (int k = 0; k < 4; ++k) append_bytes(bytes, 1.0F);
    for (int k = 0; k < 6; ++k) append_bytes(bytes, 0.5F + static_cast<float>(k));
    write_text(folder / "a.tmd", bytes);
    const std::string said = refusal([&] { (void)open_depth(folder / "a.tmd"); });
    convert(said, folder);
    const auto depth = open_depth(folder / "height.npy")->next();
    REQUIRE(depth);
    CHECK(depth->depth.columns == 3);
    CHECK(depth->depth.rows == 2);
    CHECK(depth->depth.at(2, 1) == 5.5F);
}

TEST_CASE("the command for depth in a form of a data set, or without a header, gives its numbers",
          "[foreign]") {
    const TemporaryFolder folder;
    std::vector<float> reals;
    for (int k = 0; k < 6 * 40; ++k) reals.push_back(static_cast<float>(k % 6 + 1));
    std::string text;
    for (int k = 0; k < 6 * 40; ++k) text += std::to_string(k % 6 + 1) + ".0 ";
    const std::string levels =
        raw_bytes_of<std::int32_t>({2, 3}) + raw_bytes_of<std::uint16_t>({1, 2, 3, 4, 5, 6});
    const auto [name, bytes, form] = GENERATE_COPY(table<std::string, std::string, std::string>(
        {{"frame_0001.dpt", sintel(4), "MPI Sintel"},
         {"depth0.dpt", levels, "LINEMOD"},
         {"a.jpg.geometric.bin", "3&2&1&" + raw_bytes_of<float>({1, 2, 3, 4, 5, 6}), "COLMAP"},
         {"DSC_0286.JPG", raw_bytes_of(reals), "holds 240 real numbers"},
         {"depth_0001.bin", raw_bytes_of(reals), "without a header"},
         {"scene_00.depth", text, "numbers as text"}}));
    CAPTURE(name);
    write_text(folder / name, bytes);
    std::string said = refusal([&, file = folder / name] { (void)open_depth(file); });
    CHECK(contains(said, form));
    said = replaced(replaced(said, "ROWS", "80"), "COLUMNS", "3");
    convert(said, folder);
    cv::Mat depth;
    read_still(folder / "depth.npy", PictureRole::depth).picture.convertTo(depth, CV_32F);
    REQUIRE(depth.cols == 3);
    for (int k = 0; k < 6; ++k) CHECK(depth.at<float>(k / 3, k % 3) == static_cast<float>(k + 1));
}

TEST_CASE("the command for a table in text gives its rows, whatever is before and between them",
          "[foreign]") {
    const TemporaryFolder folder;
    const auto [name, text, saved] = GENERATE(table<std::string, std::string, std::string>(
        {{"plain.csv", "1,2,3\n4,5,6\n", "depth.npy"},
         {"高さ.csv", "\"Keyence VK-X\"\n\"高さ\",\"µm\"\n\n1.0,2.0,3.0\n4.0,5.0,6.0\n",
          "height.npy"},
         {"comma.csv", "a;b;c\n1,0;2,0;3,0\n4,0;5,0;6,0\n", "depth.npy"},
         {"afm.txt", "# Channel: Height\n# Units: nm\n1.0\t2.0\t3.0\n4.0\t5.0\t6.0\n",
          "height.npy"},
         {"tabs.txt", "Topography\n1,0\t2,0\t3,0\n4,0\t5,0\t6,0\n", "height.npy"},
         {"quoted.csv", "\"Unit\",\"um\"\n\"1.0\",\"2.0\",\"3.0\"\n\"4.0\",\"5.0\",\"6.0\"\n",
          "depth.npy"},
         {"groove.sdf", "aISO-1.0\nZscale = 1e-6\n*\n1.0 2.0 3.0\n4.0 5.0 6.0\n*\n", "height.npy"},
         {"gap.csv", "1,2,3\n4,,9\n1,2,3\n4,5,6\n", "depth.npy"},
         {"with nan.txt", "nan nan nan\n1e0 2e0 3e0\n4e0 5e0 6e0\n", "depth.npy"}}));
    CAPTURE(name);
    write_text(folder / name, text);
    const std::string said = refusal([&, file = folder / name] { (void)open_depth(file); });
    convert(said, folder);
    cv::Mat depth;
    read_still(folder / saved, PictureRole::depth).picture.convertTo(depth, CV_32F);
    REQUIRE(depth.cols == 3);
    const int first = depth.rows - 2;
    for (int k = 0; k < 6; ++k)
        CHECK(depth.at<float>(first + k / 3, k % 3) == static_cast<float>(k + 1));
}

TEST_CASE("the command for points in text gives the distances of the pixels", "[foreign]") {
    const TemporaryFolder folder;
    std::string rows;
    for (int k = 0; k < 160 * 120; ++k) rows += "0;0;" + std::to_string(k % 160 + 1) + ".5;90\n";
    write_text(folder / "a.csv", "X [m];Y [m];Z [m];grey\n" + rows);
    const std::string said = refusal([&] { (void)open_depth(folder / "a.csv"); });
    CHECK(contains(said, "a list of points"));
    convert(said, folder);
    const cv::Mat depth = read_still(folder / "depth.npy", PictureRole::depth).picture;
    REQUIRE(depth.size() == cv::Size(160, 120));
    CHECK(depth.at<float>(119, 7) == 8.5F);
}

TEST_CASE("the command for a cloud in the order of the pixels gives their distances", "[foreign]") {
    const TemporaryFolder folder;
    const auto [name, header] = GENERATE(table<std::string, std::string>(
        {{"a.ply",
          "ply\nformat binary_little_endian 1.0\nobj_info Width 3\nobj_info Height 2\n"
          "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
          "end_header\n"},
         {"a.pcd",
          "# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\n"
          "HEIGHT 2\nPOINTS 6\nDATA binary\n"}}));
    CAPTURE(name);
    std::vector<float> numbers;
    for (int k = 0; k < 6; ++k)
        numbers.insert(numbers.end(), {0.0F, 0.0F, 700.0F + static_cast<float>(k)});
    write_text(folder / name, header + raw_bytes_of(numbers));
    const std::string said = refusal([&, file = folder / name] { (void)open_depth(file); });
    CHECK(contains(said, "is a point cloud"));
    convert(said, folder);
    const cv::Mat depth = read_still(folder / "depth.npy", PictureRole::depth).picture;
    REQUIRE(depth.size() == cv::Size(3, 2));
    CHECK(depth.at<float>(1, 2) == 705.0F);
}

TEST_CASE("the command for a simple field of Gwyddion gives its heights", "[foreign]") {
    const TemporaryFolder folder;
    const std::string head = "Gwyddion Simple Field 1.0\nXRes = 3\nYRes = 2\nZUnits = m\n";
    write_text(folder / "a.gsf", head + std::string(4 - head.size() % 4, '\0') +
                                     raw_bytes_of<float>({1, 2, 3, 4, 5, 6}));
    convert(refusal([&] { (void)open_depth(folder / "a.gsf"); }), folder);
    const cv::Mat heights = read_still(folder / "height.npy", PictureRole::depth).picture;
    REQUIRE(heights.size() == cv::Size(3, 2));
    CHECK(heights.at<float>(1, 2) == 6.0F);
}

TEST_CASE("the command for depth packed with RVL gives its levels", "[foreign]") {
    const TemporaryFolder folder;
    // One pixel without depth, four with it, 4, 3, 3 and 12, and one without: by half bytes
    // 1, 4, then the changes +4, -1, 0, +9 as 8|0 1, 1, 0, 8|2 2, then 1, 0.
    write_text(folder / "a_3x2.rvl", raw_bytes_of<std::uint32_t>({0x14811'0A2U, 0x1000'0000U}));
    convert(refusal([&] { (void)open_depth(folder / "a_3x2.rvl"); }), folder);
    const cv::Mat levels = read_still(folder / "depth.npy", PictureRole::depth).picture;
    REQUIRE(levels.size() == cv::Size(3, 2));
    const std::vector<std::uint16_t> expected{0, 4, 3, 3, 12, 0};
    CHECK(std::equal(expected.begin(), expected.end(), levels.begin<std::uint16_t>()));
}

TEST_CASE("a photo with Samsung's map of depth in its trailer says how to take it out",
          "[foreign]") {
    const TemporaryFolder folder;
    const auto file = folder / "IMG_0001.jpg";
    REQUIRE(cv::imwrite(file.string(), cv::Mat(40, 60, CV_8UC3, cv::Scalar(90, 120, 200))));
    const std::string photo = read_text(file);
    const std::string block = std::string("\0\0\xb1\x0a\x13\0\0\0", 8) + "DualShot_DepthMap_1";
    const std::string list("SEFH\x6a\0\0\0\1\0\0\0\0\0\xb1\x0a\x7b\0\0\0\x7b\0\0\0", 24);
    std::string levels;
    for (char k = 0; k < 12 * 8; ++k) levels += k;
    const auto said = [&](const std::string& trailer) {
        write_text(file, photo + trailer + "SEFT");
        return refusal([&] { (void)open_media(file); });
    };
    CHECK(contains(said(list + std::string("\0\0\xb3\x0a", 4)),
                   "exiftool -b -DepthMapTiff IMG_0001.jpg > depth.tif"));
    convert(said(block + levels + list), folder);
    const cv::Mat depth = read_still(folder / "depth.npy", PictureRole::depth).picture;
    REQUIRE(depth.size() == cv::Size(12, 8));
    CHECK(depth.at<std::uint8_t>(1, 2) == 14);
}

TEST_CASE("real numbers that look like text are not taken for text", "[foreign]") {
    const TemporaryFolder folder;
    // 3111.51 is "'xBE" in bytes.
    write_text(folder / "depth.bin", raw_bytes_of(std::vector<float>(640, 3111.5095F)));
    const std::string said = refusal([&] { (void)open_depth(folder / "depth.bin"); });
    CHECK(contains(said, "640 real numbers"));
}

TEST_CASE("a folder of a bag that is packed says how to unpack it", "[foreign]") {
    const TemporaryFolder folder;
    write_text(folder / "walk_0.db3.zstd", "\x28\xb5\x2f\xfd" + std::string(60, '\0'));
    CHECK(contains(refusal([&] { (void)open_media(folder.path()); }), "zstd -d"));
}
