// Recordings that only their maker's programs read are named, and what to do is said.
#include <string>

#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
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

TEST_CASE("a folder of a bag that is packed says how to unpack it", "[foreign]") {
    const TemporaryFolder folder;
    write_text(folder / "walk_0.db3.zstd", "\x28\xb5\x2f\xfd" + std::string(60, '\0'));
    CHECK(contains(refusal([&] { (void)open_media(folder.path()); }), "zstd -d"));
}
