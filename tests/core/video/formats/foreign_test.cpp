// Recordings that only their maker's programs read are named, and what to do is said.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

TEST_CASE("recordings of other makers are known by their content, and told how to convert",
          "[foreign]") {
    const TemporaryFolder folder;
    const std::string zip = "PK\x03\x04" + std::string(40, '\0');
    const auto [name, bytes, words] = GENERATE_COPY(table<std::string, std::string, std::string>(
        {{"walk.bag", "#ROSBAG V2.0\nE" + std::string(60, '\0'), "rosbags-convert"},
         {"renamed.mp4", "#ROSBAG V2.0\nE" + std::string(60, '\0'), "rosbags-convert"},
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
             {"renamed.mp4", "\x89HDF\r\n\x1a\n" + rest, "HDF5", "h5ls -r renamed.mp4"},
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
             {"frame.csv", "0.5,0.25\n0.75,1\n", "table", "numpy.loadtxt('frame.csv'"},
             {"set.tar", std::string(257, 'a') + "ustar" + rest, "archive", "tar -xf set.tar"},
             {"set.tar.gz", "\x1f\x8b" + rest, "gzip", "gzip -dk set.tar.gz"},
             {"renamed.bin", "PK\x03\x04" + rest, "zip", "unzip renamed.bin"},
             {"depth.pt", "PK\x03\x04" + rest, "PyTorch", "torch.load('depth.pt'"},
             {"k.xef", "EVENTS1" + rest, "Kinect Studio", "xefextract"},
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
    const std::string command = said.substr(said.find("python3 -c"));
    REQUIRE(std::system(("cd '" + folder.path().string() + "' && /usr/bin/" + command).c_str()) ==
            0);
    const auto depth = open_depth(folder / "height.npy")->next();
    REQUIRE(depth);
    CHECK(depth->depth.columns == 3);
    CHECK(depth->depth.rows == 2);
    CHECK(depth->depth.at(2, 1) == 5.5F);
}

TEST_CASE("a folder of a bag that is packed says how to unpack it", "[foreign]") {
    const TemporaryFolder folder;
    write_text(folder / "walk_0.db3.zstd", "\x28\xb5\x2f\xfd" + std::string(60, '\0'));
    CHECK(contains(refusal([&] { (void)open_media(folder.path()); }), "zstd -d"));
}
