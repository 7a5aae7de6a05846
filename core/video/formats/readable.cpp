// Refuses unsupported files by their first bytes, and by their names where these are not enough.
#include "core/video/formats/file_bytes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

struct UnsupportedForm {
    std::string_view begins;  ///< first bytes; empty: any
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

// The first entry that fits counts.
constexpr std::array kUnsupportedForms{
    UnsupportedForm{kZip, ".r3d", kRecord3d},
    UnsupportedForm{
        kZip, ".depthviewer",
        " is an archive of DepthViewer: unpack it with unzip and give the folder of its depth "
        "pictures"},
    UnsupportedForm{kZip, ".zip",
                    " is a zip archive: unpack it and give the folder or the files in it"},
    UnsupportedForm{{}, ".svo", kZed},
    UnsupportedForm{{}, ".svo2", kZed},
    UnsupportedForm{
        "#ROSBAG V"sv,
        {},
        " is a bag of ROS 1 or RealSense: export its pictures with rs-convert -p, or make a "
        "bag of ROS 2 (.db3) of it with rosbags-convert"},
    UnsupportedForm{
        "NI10"sv,
        {},
        " is a recording of OpenNI: export its colour and its depth as PNG pictures with "
        "OpenNI's tools"},
    UnsupportedForm{"\x28\xb5\x2f\xfd"sv, {}, " is packed with zstd: unpack it with zstd -d"}};

constexpr std::size_t kInspected_bytes = 1 << 16;

bool hold(const std::string& bytes, std::string_view part) {
    return bytes.find(part) != std::string::npos;
}

/// Whether a zip archive is Record3D's, by the names in the directory at its end.
bool lists_record3d(const fs::path& file) {
    const std::string end = end_of(file, kInspected_bytes);
    return hold(end, "rgbd/") && hold(end, "metadata");
}

/// Whether a Matroska file's list of tracks has librgbd's depth codecs.
bool is_of_librgbd(const fs::path& file) {
    const std::string begin = beginning_of(file, kInspected_bytes);
    return hold(begin, "V_TDC1") || hold(begin, "V_RVL");
}

/// The rest of a sentence that begins with the file's name: what it is, and what to do. Empty for a
/// supported file.
std::string advice_on_unsupported(const fs::path& file) {
    const std::string head = head_of(file);
    const std::string ending = lower_case(file.extension().string());
    for (const UnsupportedForm& foreign : kUnsupportedForms) {
        if (head.starts_with(foreign.begins) &&
            (foreign.ending.empty() || foreign.ending == ending))
            return std::string(foreign.advice);
    }
    if (head.starts_with(kZip) && lists_record3d(file)) return std::string(kRecord3d);
    if (head.starts_with(kMatroska) && is_of_librgbd(file)) return std::string(kLibrgbd);
    return {};
}

/// Whether the file begins like text: no zero and no control bytes. Also refuses playlists, which
/// would have the decoder open other files. Text pictures (PNM) are allowed.
bool begins_like_text(const fs::path& file) {
    constexpr std::size_t kLines_bytes = 512;
    const std::string head = beginning_of(file, kLines_bytes);
    if (head.size() >= 2 && head[0] == 'P' && head[1] >= '1' && head[1] <= '7') return false;
    return std::all_of(head.begin(), head.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 32 || (byte >= '\t' && byte <= '\r') || byte == 27;
    });
}

}  // namespace

void require_readable(const fs::path& file) {
    std::error_code failed;
    const auto status = fs::status(file, failed);
    if (status.type() == fs::file_type::not_found)
        throw InputError(shown(file) + " does not exist: check the name and the folder");
    if (failed)
        throw InputError(shown(file) + " cannot be reached (" + failed.message() +
                         "): check the name and the permissions of its folder");
    if (fs::is_directory(status))
        throw InputError(shown(file) + " is a folder: give the video or picture file in it");
    if (!fs::is_regular_file(status))
        throw InputError(shown(file) +
                         " is a pipe or a device: open it as it runs, as pipe:NAME, or "
                         "save its data to a file first");
    if (!std::ifstream(file, std::ios::binary))
        throw InputError(shown(file) + " cannot be read: check its permissions (chmod u+r)");
    if (fs::file_size(file, failed) == 0)
        throw InputError(shown(file) + " is empty: record or copy it again");
    if (const std::string advice = advice_on_unsupported(file); !advice.empty())
        throw InputError(shown(file) + advice);
    if (begins_like_text(file))
        throw InputError(shown(file) + " holds text, not a video or a picture: give another file");
}

void require_size(const fs::path& file, int columns, int rows) {
    if (columns >= 2 && rows >= 2) return;
    throw InputError(shown(file) + " is only " + std::to_string(columns) + " x " +
                     std::to_string(rows) + " pixels: give one of at least 2 x 2");
}

}  // namespace dibhr
