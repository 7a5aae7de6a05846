// Refuses unsupported files: by magic bytes, and where there are none by the ending or as text.
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
#include "core/video/formats/array_bytes.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

/// A form that no reader reads, and what to do about it; "{}" stands for the file's name.
struct UnsupportedForm {
    std::string_view begins;  ///< magic bytes; empty: none, then the ending decides
    std::string_view ending;  ///< of the name; empty: any
    std::string_view advice;
    std::size_t at{0};  ///< where the magic bytes are
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
constexpr std::string_view kZipArchive =
    " is a zip archive: unpack it (unzip {}) and give the folder or the files in it";
constexpr std::string_view kTar =
    " is an archive of files: unpack it (tar -xf {}) and give the folder or the files in it";
constexpr std::string_view kHdf5 =
    " is an HDF5 file: list its arrays with h5ls -r {} (package hdf5-tools), and save that of the "
    "depth: python3 -c \"import h5py, numpy; numpy.save('depth.npy', h5py.File('{}')['depth'])\"";
constexpr std::string_view kMatlab73 =
    " is a MATLAB file: save the array of its depth, here called depth: python3 -c \"import h5py, "
    "numpy; numpy.save('depth.npy', numpy.swapaxes(h5py.File('{}')['depth'], -1, -2))\"";
constexpr std::string_view kMatlab5 =
    " is a MATLAB file: save the array of its depth, here called depth: python3 -c \"import "
    "scipy.io, numpy; numpy.save('depth.npy', scipy.io.loadmat('{}')['depth'])\"";
constexpr std::string_view kTrueMap =
    " is a height map of TrueMap or GelSight: convert it: python3 -c \"import numpy, struct; b = "
    "open('{}', 'rb').read(); o = b.index(b'\\0', 32) + 1; c, r = struct.unpack_from('<2I', b, o); "
    "numpy.save('height.npy', numpy.frombuffer(b, '<f4', c * r, o + 24).reshape(r, c))\"";
constexpr std::string_view kPointCloud =
    " is a point cloud or a mesh, not a picture of depth: open it in CloudCompare, choose Tools, "
    "Projection, Rasterize, save the heights as GeoTIFF (height.tif), and give that";
constexpr std::string_view kLas =
    " is a point cloud, not a picture of depth: make a map of its heights with pdal translate {} "
    "height.tif --writers.gdal.resolution=0.5 --writers.gdal.output_type=max, and give that";
constexpr std::string_view kTerrain =
    " is a map of heights: convert it with gdal_translate {} height.tif (package gdal-bin), and "
    "give that";
constexpr std::string_view kPacked7z =
    " is an archive: unpack it (7z x {}) and give the folder or the files in it";
constexpr std::string_view kPyTorch =
    " is a file of PyTorch: save its depth, if you trust the file: python3 -c \"import torch, "
    "numpy; numpy.save('depth.npy', torch.load('{}', map_location='cpu').numpy())\"";
constexpr std::string_view kLayers =
    " is a drawing in layers: export the layer of the depth as a PNG picture of 16 bits, and that "
    "of the colours beside it";
constexpr std::string_view kNoHeader =
    " holds numbers without a header, so their size and type are not known: convert it: python3 -c "
    "\"import numpy; numpy.save('depth.npy', numpy.fromfile('{}', '<u2').reshape(ROWS, "
    "COLUMNS))\", "
    "with its own rows and columns ('<f4' for real numbers)";
constexpr std::string_view kTable =
    " is a table in text: if its cells are depth, convert it: python3 -c \"import numpy; "
    "numpy.save('depth.npy', numpy.loadtxt('{}', delimiter=','))\"";

// The first entry that fits counts.
constexpr std::array kUnsupportedForms{
    UnsupportedForm{kZip, ".r3d", kRecord3d},
    UnsupportedForm{
        kZip, ".depthviewer",
        " is an archive of DepthViewer: unpack it with unzip and give the folder of its depth "
        "pictures"},
    UnsupportedForm{kZip, ".pt", kPyTorch},
    UnsupportedForm{kZip, ".pth", kPyTorch},
    UnsupportedForm{kZip, ".zip", kZipArchive},
    UnsupportedForm{"\x89MCAP0\r\n"sv, ".svo2", kZed},
    UnsupportedForm{
        "#ROSBAG V"sv,
        {},
        " is a bag of ROS 1 or RealSense: export its pictures with rs-convert -p, or make a "
        "bag of ROS 2 (.db3) of it with rosbags-convert"},
    UnsupportedForm{
        "NI10"sv,
        {},
        " is a recording of OpenNI: play it with OpenNI 2 (its Device opens the file) "
        "and save each picture of depth as a PNG of 16 bits and each of colour as PNG"},
    UnsupportedForm{"\x28\xb5\x2f\xfd"sv, {}, " is packed with zstd: unpack it with zstd -d"},
    UnsupportedForm{"EVENTS1"sv,
                    {},
                    " is a recording of Kinect Studio: export its colour and its depth as PNG "
                    "pictures with the tool xefextract of KinectXEFTools"},
    UnsupportedForm{"\x89HDF\r\n\x1a\n"sv, {}, kHdf5},
    UnsupportedForm{"MATLAB 7.3 MAT-file"sv, {}, kMatlab73},
    UnsupportedForm{"MATLAB 5.0 MAT-file"sv, {}, kMatlab5},
    UnsupportedForm{"Binary TrueMap Data File"sv, {}, kTrueMap},
    UnsupportedForm{"LASF"sv, {}, kLas},
    UnsupportedForm{"ply\n"sv, {}, kPointCloud},
    UnsupportedForm{"ply\r"sv, {}, kPointCloud},
    UnsupportedForm{"# .PCD"sv, {}, kPointCloud},
    UnsupportedForm{"ASTM-E57"sv, {}, kPointCloud},
    UnsupportedForm{"glTF"sv, {}, kPointCloud},
    UnsupportedForm{"CDF\x01"sv, {}, kTerrain},
    UnsupportedForm{"CDF\x02"sv, {}, kTerrain},
    UnsupportedForm{"%PDF-"sv,
                    {},
                    " is a PDF document: take its pictures out with pdfimages -png {} picture "
                    "(package poppler-utils), and give the one of depth"},
    UnsupportedForm{"8BPS"sv, {}, kLayers},
    UnsupportedForm{"gimp xcf"sv, {}, kLayers},
    UnsupportedForm{"\x1f\x8b"sv, ".tgz", kTar},
    UnsupportedForm{"\x1f\x8b"sv, {}, " is packed with gzip: unpack it with gzip -dk {}"},
    UnsupportedForm{"BZh"sv, {}, " is packed with bzip2: unpack it with bzip2 -dk {}"},
    UnsupportedForm{"\xfd\x37zXZ"sv, {}, " is packed with xz: unpack it with xz -dk {}"},
    UnsupportedForm{"7z\xbc\xaf\x27\x1c"sv, {}, kPacked7z},
    UnsupportedForm{"Rar!\x1a\x07"sv, {}, kPacked7z},
    UnsupportedForm{"ustar"sv, {}, kTar, 257}};

// Of files that no reader accepts.
constexpr std::array kUnsupportedEndings{
    UnsupportedForm{{}, ".svo", kZed},        UnsupportedForm{{}, ".svo2", kZed},
    UnsupportedForm{{}, ".raw", kNoHeader},   UnsupportedForm{{}, ".z16", kNoHeader},
    UnsupportedForm{{}, ".depth", kNoHeader}, UnsupportedForm{{}, ".csv", kTable},
    UnsupportedForm{{}, ".asc", kTerrain},    UnsupportedForm{{}, ".hgt", kTerrain},
    UnsupportedForm{{}, ".dem", kTerrain},    UnsupportedForm{{}, ".bil", kTerrain},
    UnsupportedForm{{}, ".flt", kTerrain},    UnsupportedForm{{}, ".grd", kTerrain},
    UnsupportedForm{{}, ".obj", kPointCloud}, UnsupportedForm{{}, ".stl", kPointCloud},
    UnsupportedForm{{}, ".xyz", kPointCloud}, UnsupportedForm{{}, ".pts", kPointCloud},
    UnsupportedForm{{}, ".pkl", kPyTorch}};

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

/// The advice for this file: its name where "{}" stands, or FILE where a shell would need quotes.
std::string filled(std::string_view advice, const fs::path& file) {
    const std::string name = file.filename().string();
    const bool is_plain =
        !name.starts_with('-') && std::all_of(name.begin(), name.end(), [](char c) {
            return c == '.' || is_bare_name(std::string_view(&c, 1));
        });
    std::string text;
    for (auto at = advice.find("{}"); at != std::string_view::npos; at = advice.find("{}")) {
        text += std::string(advice.substr(0, at)) + (is_plain ? name : "FILE");
        advice.remove_prefix(at + 2);
    }
    return text + std::string(advice);
}

/// The rest of a sentence that begins with the file's name: what it is, and what to do. Empty where
/// none of the forms fits.
template <std::size_t count>
std::string advice_of(const std::array<UnsupportedForm, count>& forms, const fs::path& file,
                      std::string_view head) {
    const std::string ending = lower_case(file.extension().string());
    const auto found = std::find_if(forms.begin(), forms.end(), [&](const UnsupportedForm& form) {
        return head.size() >= form.at && head.substr(form.at).starts_with(form.begins) &&
               (form.ending.empty() || form.ending == ending);
    });
    return found == forms.end() ? std::string() : filled(found->advice, file);
}

std::string advice_on_unsupported(const fs::path& file) {
    constexpr std::size_t kMagic_bytes = 512;
    const std::string head = beginning_of(file, kMagic_bytes);
    if (std::string advice = advice_of(kUnsupportedForms, file, head); !advice.empty())
        return advice;
    if (head.starts_with(kZip) && lists_record3d(file)) return std::string(kRecord3d);
    if (head.starts_with(kZip) && !is_npz(file, head))
        return lower_case(file.extension().string()) == ".npz"
                   ? " is damaged, or holds no array: save it again by numpy.savez"
                   : filled(kZipArchive, file);
    if (head.starts_with(kMatroska) && is_of_librgbd(file)) return std::string(kLibrgbd);
    return {};
}

/// Whether the file begins like text: no zero and no control bytes. Also true for playlists, which
/// would have the decoder open other files. A video of plain pictures has a header in text.
bool begins_like_text(const fs::path& file) {
    constexpr std::size_t kLines_bytes = 512;
    const std::string head = beginning_of(file, kLines_bytes);
    if (head.starts_with("YUV4MPEG2 ")) return false;
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
}

void require_no_other_form(const fs::path& file) {
    if (const std::string advice = advice_of(kUnsupportedEndings, file, {}); !advice.empty())
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
