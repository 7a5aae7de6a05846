// Refuses unsupported files: by magic bytes, and where there are none by the size that the file
// claims, the ending, as numbers without a header, or as text.
#include "core/video/formats/file_bytes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/array_bytes.hpp"
#include "core/video/formats/text_numbers.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

/// A form that no reader reads, and what to do about it; "{}" stands for the file's name, "{sides}"
/// for "ROWS, COLUMNS" of numbers of 16 bits.
struct UnsupportedForm {
    std::string_view begins;  ///< magic bytes; empty: none, then the ending decides
    std::string_view ending;  ///< of the name, in small letters; empty: any
    std::string_view advice;
    std::size_t at{0};  ///< where the magic bytes are
};

/// Such a form that its first bytes and the size of the file tell together.
struct SizedForm {
    bool (*fits)(std::string_view head, std::uint64_t bytes);
    std::string_view ending;
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
constexpr std::string_view kZipArchive =
    " is a zip archive: unpack it (unzip {}) and give the folder or the files in it";
constexpr std::string_view kTar =
    " is an archive of files: unpack it (tar -xf {}) and give the folder or the files in it";
constexpr std::string_view kHdf5 =
    " is an HDF5 file: save its array of depth, by its name or as the largest: python3 -c \"import "
    "h5py, numpy; d = []; h5py.File('{}').visititems(lambda n, o: d.append(o) if getattr(o, "
    "'ndim', 0) > 1 else None); numpy.save('depth.npy', max(d, key=lambda o: ('dep' in "
    "o.name.lower(), o.size)))\" (package python3-h5py)";
constexpr std::string_view kMatlab73 =
    " is a MATLAB file: save its array of depth, by its name or as the largest: python3 -c "
    "\"import h5py, numpy; d = []; h5py.File('{}').visititems(lambda n, o: d.append(o) if "
    "getattr(o, 'ndim', 0) > 1 else None); numpy.save('depth.npy', numpy.swapaxes(max(d, "
    "key=lambda o: ('dep' in o.name.lower(), o.size)), -1, -2))\" (package python3-h5py)";
constexpr std::string_view kMatlab5 =
    " is a MATLAB file: save its array of depth, by its name or as the largest: python3 -c "
    "\"import scipy.io, numpy; m = scipy.io.loadmat('{}'); numpy.save('depth.npy', m[max((k for k "
    "in m if not k.startswith('_')), key=lambda k: ('dep' in k.lower(), m[k].size))])\" (package "
    "python3-scipy)";
constexpr std::string_view kTrueMap =
    " is a height map of TrueMap or GelSight: convert it: python3 -c \"import numpy, struct; b = "
    "open('{}', 'rb').read(); o = b.index(b'\\0', 32) + 1; c, r = struct.unpack_from('<2I', b, o); "
    "numpy.save('height.npy', numpy.frombuffer(b, '<f4', c * r, o + 24).reshape(r, c))\"";
constexpr std::string_view kPointCloud =
    " is a point cloud or a mesh, not a picture of depth: open it in CloudCompare (package "
    "cloudcompare), choose Tools, Projection, Rasterize, save the heights as GeoTIFF (height.tif, "
    "or depth.tif where Z points away from the camera), and give that";
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
    " holds numbers without a header: convert it: python3 -c \"import numpy; "
    "numpy.save('depth.npy', numpy.fromfile('{}', '<u2').reshape({sides}))\"";
constexpr std::string_view kHeightsNoHeader =
    " holds heights of 16 bits without a header: convert it: python3 -c \"import numpy; "
    "numpy.save('height.npy', numpy.fromfile('{}', '<u2').reshape({sides}))\"";
constexpr std::string_view kReals =
    " real numbers of 32 bits without a header: convert it: python3 -c \"import numpy; "
    "numpy.save('depth.npy', numpy.fromfile('{}', '<f4').reshape({sides}))\"";
constexpr std::string_view kSurfaceX3p =
    " is a measured surface (X3P): convert it: python3 -c \"import numpy, re, zipfile; z = "
    "zipfile.ZipFile('{}'); m = z.read('main.xml').decode(); g = lambda t: re.search(t + "
    "'>([^<]+)', m, 16)[1].strip(); t = dict(D='<f8', F='<f4', L='<i4', "
    "I='<i2')[g('<CZ>.*?<DataType')]; numpy.save('height.npy', "
    "numpy.frombuffer(z.read(g('<PointDataLink')), t).reshape(int(g('<SizeY')), "
    "int(g('<SizeX'))).astype('<f4'))\", and give that";
constexpr std::string_view kGwyddionField =
    " is a measured surface (simple field of Gwyddion): convert it: python3 -c \"import numpy, re; "
    "b = open('{}', 'rb').read(); c, r = (int(re.search(k + b'Res *= *([0-9]+)', b)[1]) for k in "
    "(b'X', b'Y')); o = b.index(b'\\0'); numpy.save('height.npy', numpy.frombuffer(b, '<f4', c * "
    "r, o + 4 - o % 4).reshape(r, c))\", and give that";
constexpr std::string_view kGwyddion =
    " is a measured surface (of Gwyddion): open it there (package gwyddion), save its heights as "
    "Gwyddion Simple Field (height.gsf), and give that";
// Wilson, "Fast lossless depth image compression" (ISS 2017).
constexpr std::string_view kRvl =
    " holds depth packed with RVL, without a header: unpack it: python3 -c \"import numpy; s = "
    "({sides}); n = iter((numpy.fromfile('{}', '<u4')[:, None] >> numpy.arange(28, -1, -4, 'u4') & "
    "15).ravel().tolist()); v = lambda: (lambda x: x & 7 | (v() << 3 if x & 8 else 0))(next(n)); d "
    "= []; p = 0; [d.extend([0] * v()) or [d.append(p := p + (lambda e: e >> 1 ^ -(e & 1))(v())) "
    "for _ in range(v())] for _ in iter(lambda: len(d) < s[0] * s[1], False)]; "
    "numpy.save('depth.npy', numpy.array(d, 'u2').reshape(s))\"";
constexpr std::string_view kLfsPointer =
    " is a pointer of Git LFS, not the file itself: fetch it with git lfs pull in its clone "
    "(package git-lfs), or download it again by the Download button of its page";
constexpr std::string_view kWebPage =
    " is a web page, not the file itself: download it again by the Download or Raw button of its "
    "page";
constexpr std::string_view kSintel =
    " is a depth picture of MPI Sintel: convert it: python3 -c \"import numpy; b = open('{}', "
    "'rb').read(); c, r = numpy.frombuffer(b, '<i4', 2, 4); numpy.save('depth.npy', "
    "numpy.frombuffer(b, '<f4', -1, 12).reshape(r, c))\", and give that with --depth-unit m";
constexpr std::string_view kFlow =
    " holds optical flow, where each pixel moves to, and no depth: give the depth of the same "
    "pictures, or let an estimator make it (dibhr help depth)";
constexpr std::string_view kSintelCutOff =
    " begins as depth of MPI Sintel or optical flow (.flo), but is not as long as it claims: copy "
    "it again";
constexpr std::string_view kLinemod =
    " is a depth picture of LINEMOD: convert it: python3 -c \"import numpy; b = open('{}', "
    "'rb').read(); numpy.save('depth.npy', numpy.frombuffer(b, '<u2', -1, "
    "8).reshape(numpy.frombuffer(b, '<i4', 2)))\", and give that with --depth-unit mm";
constexpr std::string_view kColmap =
    " is a depth map of COLMAP: convert it: python3 -c \"import numpy; c, r, n, d = open('{}', "
    "'rb').read().split(b'&', 3); numpy.save('depth.npy', numpy.frombuffer(d, "
    "'<f4').reshape(int(r), int(c)))\", and give that";
constexpr std::string_view kColmapNormals =
    " is a map of normals of COLMAP, not of depth: give the file of the same name in the folder "
    "depth_maps";
constexpr std::string_view kSweep =
    " is a sweep of a LiDAR: points, not a picture of depth: save them as text with python3 -c "
    "\"import numpy; numpy.savetxt('points.xyz', numpy.fromfile('{}', '<f4').reshape(-1, 5)[:, "
    ":3])\", open that in CloudCompare, choose Tools, Projection, Rasterize, save the heights as "
    "GeoTIFF (height.tif), and give that";
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
    UnsupportedForm{kZip, ".x3p", kSurfaceX3p},
    UnsupportedForm{"version https://git-lfs"sv, {}, kLfsPointer},
    UnsupportedForm{"<!DOCTYPE html"sv, {}, kWebPage},
    UnsupportedForm{"<!doctype html"sv, {}, kWebPage},
    UnsupportedForm{"<html"sv, {}, kWebPage},
    UnsupportedForm{"TERRAGENTERRAIN "sv, {}, kTerrain},
    UnsupportedForm{"\x89MCAP0\r\n"sv, ".svo2", kZed},
    UnsupportedForm{"NI10"sv,
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
    UnsupportedForm{"Gwyddion Simple Field"sv, {}, kGwyddionField},
    UnsupportedForm{"GWYP"sv, {}, kGwyddion},
    UnsupportedForm{"gimp xcf"sv, {}, kLayers},
    UnsupportedForm{"\x1f\x8b"sv, ".tgz", kTar},
    UnsupportedForm{"\x1f\x8b"sv, {}, " is packed with gzip: unpack it with gzip -dk {}"},
    UnsupportedForm{"BZh"sv, {}, " is packed with bzip2: unpack it with bzip2 -dk {}"},
    UnsupportedForm{"\xfd\x37zXZ"sv, {}, " is packed with xz: unpack it with xz -dk {}"},
    UnsupportedForm{"7z\xbc\xaf\x27\x1c"sv, {}, kPacked7z},
    UnsupportedForm{"Rar!\x1a\x07"sv, {}, kPacked7z},
    UnsupportedForm{"ustar"sv, {}, kTar, 257}};

/// The number of pixels by the two sides, whole numbers of 32 bits, there; 0: of no picture.
std::uint64_t pixels_at(std::string_view head, std::size_t at) {
    if (head.size() < at + 8) return 0;
    const auto side = [&](std::size_t begin) {
        std::uint64_t number = 0;
        for (std::size_t k = 4; k-- > 0;)
            number = number * 256 + static_cast<unsigned char>(head[begin + k]);
        return static_cast<std::int64_t>(number);
    };
    const std::int64_t first = side(at);
    const std::int64_t second = side(at + 4);
    return may_be_decoded(first, second, 1) ? static_cast<std::uint64_t>(first * second) : 0;
}

/// Whether it begins as depth of MPI Sintel (sintel.is.tue.mpg.de/depth) and as optical flow
/// (vision.middlebury.edu/flow) do: 202021.25 as a real number, columns and rows.
bool begins_as_sintel(std::string_view head) {
    return head.starts_with("PIEH");
}

/// "160&120&1&", then real numbers row by row: colmap.github.io, format of its dense workspace.
bool begins_as_colmap(std::string_view head, char channels) {
    std::size_t at = 0;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = at;
        while (at < head.size() && is_decimal_digit(head[at])) ++at;
        if (at == first || at == head.size() || head[at++] != '&') return false;
    }
    return head.size() >= at + 2 && head[at] == channels && head[at + 1] == '&';
}

// The first entry that fits counts.
constexpr std::array kSizedForms{
    SizedForm{[](std::string_view head, std::uint64_t bytes) {
                  return begins_as_sintel(head) && bytes == 12 + 4 * pixels_at(head, 4);
              },
              {},
              kSintel},
    SizedForm{[](std::string_view head, std::uint64_t bytes) {
                  return begins_as_sintel(head) && bytes == 12 + 8 * pixels_at(head, 4);
              },
              {},
              kFlow},
    SizedForm{[](std::string_view head, std::uint64_t) { return begins_as_sintel(head); },
              {},
              kSintelCutOff},
    SizedForm{[](std::string_view head, std::uint64_t bytes) {
                  return bytes > 8 && bytes == 8 + 2 * pixels_at(head, 0);
              },
              ".dpt", kLinemod},
    SizedForm{[](std::string_view head, std::uint64_t) { return begins_as_colmap(head, '1'); },
              {},
              kColmap},
    SizedForm{[](std::string_view head, std::uint64_t) { return begins_as_colmap(head, '3'); },
              {},
              kColmapNormals}};

// Of files that no reader accepts.
constexpr std::array kUnsupportedEndings{
    UnsupportedForm{{}, ".svo", kZed},        UnsupportedForm{{}, ".svo2", kZed},
    UnsupportedForm{{}, ".pcd.bin", kSweep},  UnsupportedForm{{}, ".asc", kTerrain},
    UnsupportedForm{{}, ".hgt", kTerrain},    UnsupportedForm{{}, ".dem", kTerrain},
    UnsupportedForm{{}, ".bil", kTerrain},    UnsupportedForm{{}, ".flt", kTerrain},
    UnsupportedForm{{}, ".grd", kTerrain},    UnsupportedForm{{}, ".obj", kPointCloud},
    UnsupportedForm{{}, ".stl", kPointCloud}, UnsupportedForm{{}, ".xyz", kPointCloud},
    UnsupportedForm{{}, ".pts", kPointCloud}, UnsupportedForm{{}, ".pkl", kPyTorch}};

// Of such files that do not hold text.
constexpr std::array kHeaderlessEndings{
    UnsupportedForm{{}, ".raw", kNoHeader}, UnsupportedForm{{}, ".r16", kHeightsNoHeader},
    UnsupportedForm{{}, ".z16", kNoHeader}, UnsupportedForm{{}, ".depth", kNoHeader}};

constexpr std::size_t kInspected_bytes = 1 << 16;

bool hold(const std::string& bytes, std::string_view part) {
    return bytes.find(part) != std::string::npos;
}

/// Whether a zip archive is Record3D's, by the names in the directory at its end.
bool lists_record3d(const fs::path& file) {
    const std::string end = end_of(file, kInspected_bytes);
    return hold(end, "rgbd/") && hold(end, "metadata");
}

/// Of a bag of ROS 1; RealSense names its topics after the device, in the index at the end.
std::string_view advice_on_bag(const fs::path& file) {
    if (hold(end_of(file, kInspected_bytes), "/device_0/"))
        return " is a recording of RealSense (a bag of ROS 1): export its pictures with rs-convert "
               "-i {} -p depth_ (of librealsense)";
    return " is a bag of ROS 1: make one of ROS 2 of it with rosbags-convert --src {} --dst ros2 "
           "(pip install rosbags), and give the folder ros2";
}

/// Whether a Matroska file's list of tracks has librgbd's depth codecs.
bool is_of_librgbd(const fs::path& file) {
    const std::string begin = beginning_of(file, kInspected_bytes);
    return hold(begin, "V_TDC1") || hold(begin, "V_RVL");
}

/// The name of the file as a word of a shell's command or, where quotes are around it already, as
/// text within them; FILE where neither can have it.
std::string name_in_command(const std::string& name, bool is_quoted) {
    constexpr std::string_view kNeverPlain = "'\"\\$`!";
    const bool is_text =
        name == one_line(name) && name.find_first_of(kNeverPlain) == std::string::npos;
    if (!is_text) return "FILE";
    const std::string safe = name.starts_with('-') ? "./" + name : name;
    const bool is_word = std::all_of(name.begin(), name.end(), [](char c) {
        return c == '.' || is_bare_name(std::string_view(&c, 1));
    });
    return is_quoted || is_word ? safe : "'" + safe + "'";
}

/// The sides of so many numbers, "ROWS, COLUMNS": by "160x120" in the name, by what cameras have,
/// or as a square. In letters where none fits. Of packed numbers, whose count is not known (0), by
/// the name alone.
std::string sides_of(const std::string& name, std::uint64_t numbers) {
    using Sides = std::array<std::uint64_t, 2>;  // columns, rows
    constexpr std::array<Sides, 15> kOfCameras{{{640, 480},
                                                {512, 424},
                                                {320, 240},
                                                {320, 288},
                                                {640, 576},
                                                {848, 480},
                                                {640, 360},
                                                {424, 240},
                                                {1280, 720},
                                                {1280, 800},
                                                {1920, 1080},
                                                {256, 192},
                                                {224, 171},
                                                {176, 144},
                                                {160, 120}}};
    constexpr const char* kInLetters = "ROWS, COLUMNS";
    const auto text = [](const Sides& sides) {
        return std::to_string(sides[1]) + ", " + std::to_string(sides[0]);
    };
    const auto fits = [numbers](const Sides& sides) {
        return sides[0] > 0 && sides[1] > 0 &&
               (numbers == 0 || (numbers % sides[0] == 0 && numbers / sides[0] == sides[1]));
    };
    for (std::size_t at = name.find_first_of("xX", 1); at != std::string::npos;
         at = name.find_first_of("xX", at + 1)) {
        std::size_t first = at;
        while (first > 0 && is_decimal_digit(name[first - 1])) --first;
        Sides sides{};
        std::from_chars(name.data() + first, name.data() + at, sides[0]);
        std::from_chars(name.data() + at + 1, name.data() + name.size(), sides[1]);
        if (fits(sides)) return text(sides);
    }
    if (numbers == 0) return kInLetters;
    const auto* const usual = std::find_if(kOfCameras.begin(), kOfCameras.end(), fits);
    if (usual != kOfCameras.end()) return text(*usual);
    const auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(numbers)));
    return fits({root, root}) ? text({root, root}) : kInLetters;
}

/// The sides of so many numbers in the shape of a photo, "ROWS, COLUMNS"; empty where none fit.
std::string sides_as_of_photo(const fs::path& file, std::uint64_t numbers) {
    std::ifstream in(file, std::ios::binary);
    const auto photo = claimed_size(in);
    if (!photo || photo->columns < 1 || photo->rows < 1) return {};
    const double shape = static_cast<double>(photo->columns) / static_cast<double>(photo->rows);
    const auto columns =
        static_cast<std::uint64_t>(std::llround(std::sqrt(static_cast<double>(numbers) * shape)));
    if (columns == 0 || numbers % columns != 0) return {};
    return std::to_string(numbers / columns) + ", " + std::to_string(columns);
}

/// The advice for this file, with its name and the sides of so many numbers.
std::string filled(std::string_view advice, const fs::path& file, std::uint64_t numbers) {
    constexpr std::string_view kName = "{}";
    constexpr std::string_view kSides = "{sides}";
    const std::string name = file.filename().string();
    std::string text(advice);
    for (auto at = text.find(kName); at != std::string::npos; at = text.find(kName, at)) {
        const std::string word = name_in_command(name, at > 0 && text[at - 1] == '\'');
        text.replace(at, kName.size(), word);
        at += word.size();
    }
    if (const auto at = text.find(kSides); at != std::string::npos)
        text.replace(at, kSides.size(), sides_of(name, numbers));
    return hold(text, "(ROWS, COLUMNS)") ? text + ", with its own rows and columns" : text;
}

/// The rest of a sentence that begins with the file's name: what it is, and what to do. Empty where
/// none of the forms fits.
template <std::size_t count>
std::string advice_of(const std::array<UnsupportedForm, count>& forms, const fs::path& file,
                      std::string_view head) {
    const std::string name = lower_case(file.filename().string());
    const auto found = std::find_if(forms.begin(), forms.end(), [&](const UnsupportedForm& form) {
        return head.size() >= form.at && head.substr(form.at).starts_with(form.begins) &&
               name.ends_with(form.ending);
    });
    return found == forms.end() ? std::string() : filled_advice(found->advice, file);
}

/// Points in the order of the pixels of a camera, each of some numbers of 32 bits.
struct PixelPoints {
    std::uint64_t columns{0};
    std::uint64_t rows{0};
    std::uint64_t count{0};              ///< 0: not stated
    std::vector<std::string> numbers{};  ///< "x", "y", "z", ...
    bool are_real{true};
    bool are_binary{false};
};

/// Takes what a line of a header states: of PLY, with the size as 3D scanners add it, or of PCD.
/// False at the last line.
bool take_line(const std::string& line, PixelPoints& points) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(std::move(word));
    words.resize(std::max<std::size_t>(words.size(), 3));
    const std::string& first = words[0];
    const auto is_all = [&](const char* value) {
        return std::all_of(words.begin() + 1, words.end(), [value](const std::string& word) {
            return word.empty() || word == value;
        });
    };
    const bool is_info = first == "obj_info";
    const std::string key = lower_case(is_info ? words[1] : first);
    const std::string& value = is_info ? words[2] : words[1];
    std::uint64_t number = 0;
    std::from_chars(value.data(), value.data() + value.size(), number);
    if (key == "width") points.columns = number;
    if (key == "height") points.rows = number;
    if (first == "element" && words[1] == "vertex")
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), points.count);
    if (first == "property") {
        points.numbers.push_back(words[2]);
        points.are_real &= words[1] == "float" || words[1] == "float32";
    }
    if (first == "FIELDS") points.numbers.assign(words.begin() + 1, words.end());
    if ((first == "SIZE" && !is_all("4")) || (first == "COUNT" && !is_all("1")))
        points.are_real = false;
    if (first == "format") points.are_binary = words[1] == "binary_little_endian";
    if (first == "DATA") points.are_binary = words[1] == "binary";
    return first != "end_header" && first != "DATA";
}

/// What to do about a cloud whose points are in the order of the pixels; empty for others.
std::string advice_on_pixel_points(const fs::path& file) {
    constexpr std::size_t kHeader_bytes = 4096;
    std::istringstream header(beginning_of(file, kHeader_bytes));
    PixelPoints points;
    std::string line;
    bool is_complete = false;
    while (!is_complete && std::getline(header, line)) is_complete = !take_line(line, points);
    if (!is_complete || !header) return {};
    const auto at = static_cast<std::uint64_t>(header.tellg());
    const auto z = std::find(points.numbers.begin(), points.numbers.end(), "z");
    const bool is_picture = points.columns >= 2 && points.rows >= 2 &&
                            points.columns <= kMostPixels / points.rows &&
                            (points.count == 0 || points.count == points.columns * points.rows);
    if (!is_picture || !points.are_real || !points.are_binary || z == points.numbers.end())
        return {};
    const std::string sides = std::to_string(points.rows) + ", " + std::to_string(points.columns);
    const std::string numbers = std::to_string(points.numbers.size());
    return filled_advice(
        " is a point cloud in the order of the pixels, not a picture of depth: save its distances: "
        "python3 -c \"import numpy; numpy.save('depth.npy', numpy.fromfile('{}', '<f4', " +
            std::to_string(points.columns * points.rows) + " * " + numbers +
            ", offset=" + std::to_string(at) + ").reshape(" + sides + ", " + numbers + ")[..., " +
            std::to_string(z - points.numbers.begin()) + "])\", and give that",
        file);
}

std::string advice_on_unsupported(const fs::path& file) {
    constexpr std::size_t kMagic_bytes = 512;
    const std::string head = beginning_of(file, kMagic_bytes);
    if (head.starts_with("ply\n") || head.starts_with("ply\r") || head.starts_with("# .PCD")) {
        if (std::string advice = advice_on_pixel_points(file); !advice.empty()) return advice;
    }
    if (std::string advice = advice_of(kUnsupportedForms, file, head); !advice.empty())
        return advice;
    if (head.starts_with("#ROSBAG V")) return filled_advice(advice_on_bag(file), file);
    if (head.starts_with(kZip) && lists_record3d(file)) return std::string(kRecord3d);
    if (head.starts_with(kZip) && !is_npz(file, head))
        return lower_case(file.extension().string()) == ".npz"
                   ? " is damaged, or holds no array: save it again by numpy.savez"
                   : filled_advice(kZipArchive, file);
    if (head.starts_with(kMatroska) && is_of_librgbd(file)) return std::string(kLibrgbd);
    const std::string name = lower_case(file.filename().string());
    const auto* const sized =
        std::find_if(kSizedForms.begin(), kSizedForms.end(), [&](const SizedForm& form) {
            return name.ends_with(form.ending) && form.fits(head, size_of(file));
        });
    return sized == kSizedForms.end() ? std::string() : filled_advice(sized->advice, file);
}

/// Whether the bytes are real numbers of 32 bits from the first one on, as far as depth has them;
/// of other bytes one in eight would be.
bool are_reals(std::string_view bytes) {
    constexpr std::size_t kLeast = 64;
    constexpr std::size_t kAtBeginning = 16;  // a header would be there
    constexpr float kSmallest = 1e-4F;
    constexpr float kLargest = 1e6F;
    const std::size_t count = bytes.size() / 4;
    std::size_t usual = 0;
    std::size_t unusual = 0;
    for (std::size_t k = 0; k < count; ++k) {
        std::uint32_t bits = 0;
        for (std::size_t b = 4; b-- > 0;)
            bits = bits * 256 + static_cast<unsigned char>(bytes[4 * k + b]);
        const float size = std::abs(std::bit_cast<float>(bits));
        const bool is_nothing = size == 0.0F || (bits & 0x7fbfffffU) == 0x7f800000U;
        const bool is_usual = size >= kSmallest && size <= kLargest;
        usual += static_cast<std::size_t>(is_usual);
        unusual += static_cast<std::size_t>(!is_usual && !is_nothing);
        if (unusual > 0 && k < kAtBeginning) return false;
    }
    return count >= kLeast && usual >= count / 20 && unusual <= count / 20;
}

std::string advice_by_ending(const fs::path& file) {
    if (lower_case(file.extension().string()) == ".rvl") return filled(kRvl, file, 0);
    return advice_of(kUnsupportedEndings, file, {});
}

std::string filled_advice_on_text(const fs::path& file) {
    const TextAdvice advice = advice_on_numbers_in_text(file);
    return advice.words.empty() ? advice.words : filled(advice.words, file, advice.numbers);
}

std::string advice_on_headerless(const fs::path& file) {
    const std::uint64_t bytes = size_of(file);
    if (bytes % 4 == 0 && are_reals(beginning_of(file, kInspected_bytes)))
        return " holds " + std::to_string(bytes / 4) + filled(kReals, file, bytes / 4);
    return advice_of(kHeaderlessEndings, file, {});
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

std::string advice_on_form(const fs::path& file) {
    std::string advice = advice_on_unsupported(file);
    if (advice.empty()) advice = advice_by_ending(file);
    if (advice.empty() && lower_case(file.extension().string()) == ".csv")
        advice = filled_advice_on_text(file);
    if (advice.empty()) advice = advice_on_headerless(file);
    return advice;
}

std::string filled_advice(std::string_view advice, const fs::path& file) {
    return filled(advice, file, size_of(file) / 2);
}

std::string advice_on_depth_within(const fs::path& file) {
    // Samsung's trailer: a list of blocks with their types, of which 0x0ab1 is the map of depth, of
    // 8 bits, and 0x0ab3 has its size.
    constexpr std::size_t kList_bytes = 4096;
    constexpr std::string_view kMapBlock = "\0\0\xb1\x0a"sv;
    if (!head_of(file).starts_with("\xff\xd8\xff")) return {};
    const std::string end = end_of(file, kList_bytes);
    const auto list = end.rfind("SEFH");
    const auto map = list == std::string::npos ? list : end.find(kMapBlock, list);
    if (!end.ends_with("SEFT") || map == std::string::npos) return {};
    // A block is its type, the length of its name, the name, "DualShot_DepthMap_1", and its data.
    constexpr std::uint64_t kBefore_bytes = 8 + 19;
    std::uint64_t bytes = 0;
    for (std::size_t k = 4; k-- > 0 && map + 8 + k < end.size();)
        bytes = bytes * 256 + static_cast<unsigned char>(end[map + 8 + k]);
    if (bytes <= kBefore_bytes || end.find("\0\0\xb3\x0a"sv, list) != std::string::npos)
        return filled_advice(
            " holds a map of depth by Samsung, which is not read: take it out with exiftool -b "
            "-DepthMapTiff {} > depth.tif (package libimage-exiftool-perl), and give that as the "
            "second file",
            file);
    const std::uint64_t levels = bytes - kBefore_bytes;
    const std::string advice =
        " holds a map of depth by Samsung, which is not read: take it out with python3 -c \"import "
        "numpy; b = open('{}', 'rb').read(); numpy.save('depth.npy', numpy.frombuffer(b, 'u1', " +
        std::to_string(levels) + ", b.rindex(b'DualShot_DepthMap_') + 19).reshape(";
    const std::string rest = "))\", and give that as the second file";
    const std::string by_photo = sides_as_of_photo(file, levels);
    return filled(advice + (by_photo.empty() ? "{sides}" : by_photo) + rest, file, levels);
}

void require_no_other_form(const fs::path& file) {
    std::string advice = advice_by_ending(file);
    if (advice.empty()) advice = filled_advice_on_text(file);
    if (advice.empty()) advice = advice_on_headerless(file);
    if (!advice.empty()) throw InputError(shown(file) + advice);
    if (begins_like_text(file))
        throw InputError(shown(file) + " holds text, not a video or a picture: give another file");
}

void require_size(const fs::path& file, int columns, int rows) {
    if (columns >= 2 && rows >= 2) return;
    throw InputError(shown(file) + " is only " + std::to_string(columns) + " x " +
                     std::to_string(rows) + " pixels: give one of at least 2 x 2");
}

}  // namespace dibhr
