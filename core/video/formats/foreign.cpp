// Told by how files begin, and by their names where that says too little.
#include "core/video/formats/foreign.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

struct Foreign {
    std::string_view begins;  ///< empty: as any
    std::string_view ending;  ///< of the name; empty: any
    std::string_view advice;
};

constexpr std::string_view kZip = "PK\x03\x04";
constexpr std::string_view kMatroska = "\x1a\x45\xdf\xa3";
constexpr std::string_view kLibrgbd =
    " is a recording of librgbd (Telegie), whose depth has a codec of its own: export it as 16-bit "
    "PNG pictures with its Python package pyrgbd";
constexpr std::string_view kRecord3d =
    " is an archive of Record3D, whose depth is packed with LZFSE: export it in Record3D as RGBD "
    "video (MP4) or as EXR and JPEG, and give that";
constexpr std::string_view kZed =
    " is a recording of a ZED camera, which only the ZED SDK reads: export its left view and its "
    "depth as 16-bit PNG with the ZED SDK's SVO Export";

// The first that fits.
constexpr std::array kForeign{
    Foreign{kZip, ".r3d", kRecord3d},
    Foreign{kZip, ".depthviewer",
            " is an archive of DepthViewer: unpack it with unzip and give the folder of its depth "
            "pictures"},
    Foreign{kZip, ".zip", " is a zip archive: unpack it and give the folder or the files in it"},
    Foreign{{}, ".svo", kZed},
    Foreign{{}, ".svo2", kZed},
    Foreign{"#ROSBAG V"sv,
            {},
            " is a bag of ROS 1 or RealSense: export its pictures with rs-convert -p, or make a "
            "bag of ROS 2 (.db3) of it with rosbags-convert"},
    Foreign{"\x89MCAP0\r\n"sv,
            {},
            " is an MCAP recording: make a bag in SQLite (.db3) of it with ros2 bag convert"},
    Foreign{"NI10"sv,
            {},
            " is a recording of OpenNI: export its colour and its depth as PNG pictures with "
            "OpenNI's tools"},
    Foreign{"\x28\xb5\x2f\xfd"sv, {}, " is packed with zstd: unpack it with zstd -d"}};

constexpr std::size_t kLookedAt_bytes = 1 << 16;

bool hold(const std::string& bytes, std::string_view part) {
    return bytes.find(part) != std::string::npos;
}

/// The names in a zip archive are listed at its end.
bool lists_record3d(const fs::path& file) {
    const std::string end = end_of(file, kLookedAt_bytes);
    return hold(end, "rgbd/") && hold(end, "metadata");
}

/// Its own codecs of depth, in the Matroska file's list of tracks.
bool is_of_librgbd(const fs::path& file) {
    const std::string begin = beginning_of(file, kLookedAt_bytes);
    return hold(begin, "V_TDC1") || hold(begin, "V_RVL");
}

}  // namespace

std::string advice_on_foreign(const fs::path& file) {
    std::error_code failed;
    if (!fs::is_regular_file(file, failed)) return {};
    const std::string head = head_of(file);
    const std::string ending = lower_case(file.extension().string());
    for (const Foreign& foreign : kForeign) {
        if (head.starts_with(foreign.begins) &&
            (foreign.ending.empty() || foreign.ending == ending))
            return std::string(foreign.advice);
    }
    if (head.starts_with(kZip) && lists_record3d(file)) return std::string(kRecord3d);
    if (head.starts_with(kMatroska) && is_of_librgbd(file)) return std::string(kLibrgbd);
    return {};
}

}  // namespace dibhr
