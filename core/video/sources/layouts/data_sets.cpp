// The table, and the comparison of a picture's path with it.
#include "core/video/sources/layouts/data_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/sources/layouts/picture_folder.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

/// What levels mean, as several rows have it.
struct Values {
    std::string_view words;  ///< for people
    NearLevels near;
    DepthUnit unit;
    double scale;
    double no_data;       ///< a level; kNotStated: the numbers tell it
    double least_m{0.0};  ///< usual distances; 0, 0: any, or none
    double most_m{0.0};
};

constexpr Values kMillimetres{
    "millimetres, 0 is no data", NearLevels::dark, DepthUnit::mm, 1.0, 0.0, 0.02, 60.0};
constexpr Values kStreet{
    "metres x 256, 0 is no data", NearLevels::dark, DepthUnit::m, 1.0 / 256.0, 0.0, 0.5, 120.0};
constexpr Values kEstimated{"metres x 256, as programs that estimate depth write it",
                            NearLevels::dark,
                            DepthUnit::m,
                            1.0 / 256.0,
                            kNotStated,
                            0.2,
                            30.0};
constexpr Values kStreetDisparity{"disparities x 256, 0 is no data", NearLevels::bright,
                                  DepthUnit::disparity, 1.0 / 256.0, 0.0};
constexpr Values kCentimetres{
    "centimetres, 65535 is the sky", NearLevels::dark, DepthUnit::mm, 10.0, 65535.0, 0.1, 656.0};
constexpr Values kUnrealUnits{
    "centimetres, 65504 is the sky", NearLevels::dark, DepthUnit::mm, 10.0, 65504.0, 0.05, 656.0};
constexpr Values kMetres{"metres", NearLevels::dark, DepthUnit::m, 1.0, kNotStated, 0.01, 1e5};
constexpr Values kMetresOr0{
    "metres, 0 is no data", NearLevels::dark, DepthUnit::m, 1.0, 0.0, 0.1, 1000.0};
constexpr Values kMetresToSky{
    "metres, 65504 is the sky", NearLevels::dark, DepthUnit::m, 1.0, 65504.0, 0.01, 1e5};
constexpr Values kTum{
    "metres x 5000, 0 is no data", NearLevels::dark, DepthUnit::mm, 0.2, 0.0, 0.1, 14.0};
constexpr Values kMatterport{
    "metres x 4000, 0 is no data", NearLevels::dark, DepthUnit::m, 0.00025, 0.0, 0.1, 17.0};
constexpr Values kReplica{
    "metres x 6553.5, 0 is no data", NearLevels::dark, DepthUnit::m, 1.0 / 6553.5, 0.0, 0.02, 10.0};
constexpr Values kTaskonomy{"metres x 512, 65535 is no data",
                            NearLevels::dark,
                            DepthUnit::m,
                            1.0 / 512.0,
                            65535.0,
                            0.1,
                            128.0};
constexpr Values kYcb{
    "metres x 10000, 0 is no data", NearLevels::dark, DepthUnit::mm, 0.1, 0.0, 0.1, 6.6};
constexpr Values kBop{"the depth_scale of scene_camera.json, 0 is no data",
                      NearLevels::dark,
                      DepthUnit::mm,
                      1.0,
                      0.0,
                      0.02,
                      60.0};
constexpr Values kMvs{
    "millimetres, 0 is no data", NearLevels::dark, DepthUnit::mm, 1.0, 0.0, 0.1, 5.0};
constexpr Values kC3vd{"65535 is 100 mm", NearLevels::dark, DepthUnit::mm, 100.0 / 65535.0,
                       kNotStated};
constexpr Values kSimCol{"65280 is 200 mm", NearLevels::dark, DepthUnit::mm, 200.0 / 65280.0,
                         kNotStated};
constexpr Values kOrgan{
    "millimetres, 0 is no data", NearLevels::dark, DepthUnit::mm, 1.0, 0.0, 0.001, 1.0};
constexpr Values kPoints{"points in millimetres", NearLevels::dark, DepthUnit::mm, 1.0, kNotStated};
constexpr Values kFarBright{"levels, far is bright", NearLevels::dark, DepthUnit::levels, 1.0,
                            kNotStated};
constexpr Values kFarBrightOr0{"of no unit, far is bright, 0 is no data", NearLevels::dark,
                               DepthUnit::levels, 1.0, 0.0};
constexpr Values kNearBright{"levels, near is bright", NearLevels::bright, DepthUnit::levels, 1.0,
                             kNotStated};
constexpr Values kDisparity{"disparities", NearLevels::bright, DepthUnit::disparity, 1.0,
                            kNotStated};
constexpr Values kDisparityOr0{"disparities, 0 is no data", NearLevels::bright,
                               DepthUnit::disparity, 1.0, 0.0};
constexpr Values kByCalibration{"disparities, with the cameras' calib.txt", NearLevels::dark,
                                DepthUnit::mm, 1.0, kNotStated};
constexpr Values kTurned{"millimetres, whose bits are turned by three", NearLevels::dark,
                         DepthUnit::mm, 1.0, 0.0};
constexpr Values kBelowConfidence{"millimetres in 13 bits, a confidence above",
                                  NearLevels::dark,
                                  DepthUnit::mm,
                                  1.0,
                                  0.0,
                                  0.02,
                                  8.2};
constexpr Values kRawKinect{"raw disparities of a Kinect", NearLevels::dark, DepthUnit::mm, 1.0,
                            kNotStated};

/// One layout or way to name files. `path`: its last parts, in small letters; # is a number, * any
/// letters, ? one. `beside`: what must be there, too, from the picture's folder, in the same way;
/// of several names, between blanks, all. A name that begins with `same` has there the picture's
/// name without its ending; with `short`, this without its last word.
struct DataSet {
    std::string_view name;
    std::string_view path;
    std::string_view beside;
    int bits;
    const Values& values;
    double sureness;  ///< how surely such a layout is that of the data set
    DepthCode code{DepthCode::grey};
    /// Reads files beside; false: they are not of this data set. Null: nothing to read.
    bool (*read)(const fs::path& folder, const SourceFacts& facts, DataSetFacts& found){nullptr};
    bool is_dense{false};
};

// Readers of files beside.

void take_levels_per_m(const CameraFile& camera, DataSetFacts& found) {
    if (!camera.levels_per_m) return;
    const double metre_mm = one_in_mm(DepthUnit::m);
    const DepthUnit unit = found.finding.statement.unit.value_or(DepthUnit::mm);
    found.finding.statement.scale = metre_mm / one_in_mm(unit) / *camera.levels_per_m;
}

bool read_bop(const fs::path& folder, const SourceFacts& facts, DataSetFacts& found) {
    found.camera =
        read_camera_bop(folder / ".." / "scene_camera.json", number_in_name(facts.picture()));
    if (!found.camera || !found.camera->levels_per_m) return false;
    take_levels_per_m(*found.camera, found);
    return true;
}

bool read_replica(const fs::path& folder, const SourceFacts& /*facts*/, DataSetFacts& found) {
    for (const char* const file : {"../cam_params.json", "../../cam_params.json"}) {
        if (!found.camera) found.camera = read_camera_json(folder / file);
    }
    if (found.camera) take_levels_per_m(*found.camera, found);
    return true;
}

bool read_middlebury(const fs::path& folder, const SourceFacts& facts, DataSetFacts& found) {
    const auto law = read_stereo_calibration(folder / "calib.txt", facts.columns);
    if (law) found.law = *law;
    return law.has_value();
}

/// The NYU toolbox: 351.3 / (1092.5 - v) metres.
bool read_nyu(const fs::path& /*folder*/, const SourceFacts& /*facts*/, DataSetFacts& found) {
    found.law = {-351300.0, -1092.5};
    return true;
}

// By the pages and public readers of each: cvlibs.net/datasets/kitti (devkit of depth, of stereo);
// europe.naverlabs.com (Virtual KITTI 2); rgbd.cs.princeton.edu and github.com/PrincetonVision;
// github.com/niessner/Matterport; rse-lab.cs.washington.edu/projects/posecnn (YCB-Video);
// bop.felk.cvut.cz; theairlab.org/tartanair-dataset, github.com/castacks/tartanairpy;
// github.com/cvg/nice-slam (Replica); robotvault.bitbucket.io/scenenet-rgbd.html;
// cvg.cit.tum.de/data/datasets/rgbd-dataset; vision.middlebury.edu/stereo; diode-dataset.org;
// github.com/StanfordVL/taskonomy; cs.nyu.edu/~silberman (toolbox); kaldir.vc.in.tum.de/scannetpp;
// durrlab.github.io/C3VD; github.com/anitarau/simcol; github.com/CapsuleEndoscope/EndoSLAM;
// github.com/UZ-SLAMLab/Endo-Depth-and-Motion (Hamlyn); endovissub2019-scared.grand-challenge.org;
// github.com/stepjam/RLBench; microsoft.github.io/AirSim (image APIs); docs.unrealengine.com
// (SceneDepthWorldUnits); github.com/TRI-ML/DDAD; github.com/YoYo000/BlendedMVS (units differ from
// scene to scene); github.com/isl-org/ZoeDepth, /MiDaS; github.com/prs-eth/Marigold;
// roboimagedata.compute.dtu.dk.
constexpr std::array kDataSets{
    // Streets.
    DataSet{"KITTI depth completion", "proj_depth/groundtruth/image_#/#.png", "", 16, kStreet,
            0.995},
    DataSet{"KITTI depth completion", "proj_depth/velodyne_raw/image_#/#.png", "", 16, kStreet,
            0.995},
    DataSet{"KITTI depth completion", "*_groundtruth_depth_#_image_#.png", "", 16, kStreet, 0.995},
    DataSet{"KITTI depth completion", "*_velodyne_raw_#_image_#.png", "", 16, kStreet, 0.995},
    DataSet{"KITTI depth completion", "velodyne_raw/#.png", "../image", 16, kStreet, 0.98},
    DataSet{"KITTI stereo", "disp_occ*/#_#.png", "", 16, kStreetDisparity, 0.99},
    DataSet{"KITTI stereo", "disp_noc*/#_#.png", "", 16, kStreetDisparity, 0.99},
    DataSet{"Virtual KITTI 2", "frames/depth/camera_#/depth_#.png", "", 16, kCentimetres, 0.995},
    DataSet{"Virtual KITTI 2", "depth/camera_#/depth_#.png", "", 16, kCentimetres, 0.97},
    DataSet{"Virtual KITTI", "vkitti_*_depthgt/#/*/#.png", "", 16, kCentimetres, 0.995},
    DataSet{"DDAD", "depth/lidar/camera_#/#.npz", "", kRealBits, kMetresOr0, 0.98},
    // Simulated places.
    DataSet{"TartanAir", "depth_left/#_left_depth.npy", "", kRealBits, kMetres, 0.995},
    DataSet{"TartanAir", "depth_right/#_right_depth.npy", "", kRealBits, kMetres, 0.995},
    DataSet{"TartanAir V2", "depth_?cam_*/#_?cam_*_depth.png", "", kRealBits, kMetres, 0.995},
    DataSet{"RLBench", "*_depth/#.png", "../*_rgb ../*_mask", kRealBits, kFarBright, 0.97},
    DataSet{"AirSim", "*_depthplanar_*.pfm", "", kRealBits, kMetresToSky, 0.995},
    DataSet{"AirSim", "*_depthperspective_*.pfm", "", kRealBits, kMetresToSky, 0.995},
    DataSet{"AirSim", "images/img_*.pfm", "../airsim_rec.txt", kRealBits, kMetresToSky, 0.99},
    DataSet{"Unreal Engine's scene depth", "*scenedepth*.exr", "", kRealBits, kUnrealUnits, 0.95},
    DataSet{"Unreal Engine's world depth", "*worlddepth*.exr", "", kRealBits, kUnrealUnits, 0.95},
    // Rooms.
    DataSet{"SUN RGB-D", "depth*/*.png", "../depth_bfx ../image ../intrinsics.txt", 16, kTurned,
            0.99, DepthCode::turned16},
    DataSet{"SUN RGB-D", "depth*/*.png", "../image ../intrinsics.txt ../scene.txt", 16, kTurned,
            0.99, DepthCode::turned16},
    DataSet{"SUN3D", "depth/#-#.png", "../image ../extrinsics ../intrinsics.txt", 16, kTurned, 0.98,
            DepthCode::turned16},
    DataSet{"Matterport3D", "undistorted_depth_images/*_d#_#.png", "", 16, kMatterport, 0.995},
    DataSet{"Matterport3D", "matterport_depth_images/*_d#_#.png", "", 16, kMatterport, 0.995},
    DataSet{"Replica", "results/depth#.png", "frame#.jpg ../traj.txt", 16, kReplica, 0.97,
            DepthCode::grey, read_replica},
    DataSet{"SceneNet RGB-D", "depth/#.png", "../photo ../instance", 16, kMillimetres, 0.97},
    DataSet{"ScanNet", "depth/#.png", "../intrinsic/intrinsic_depth.txt", 16, kMillimetres, 0.99},
    DataSet{"ScanNet++", "iphone/depth/frame_#.png", "", 16, kMillimetres, 0.97},
    DataSet{"NYU Depth V2", "d-#.#-#.pgm", "", 16, kRawKinect, 0.98, DepthCode::kinect11, read_nyu},
    DataSet{"NYU Depth V2", "sync_depth_#.png", "rgb_#.jpg", 16, kMillimetres, 0.97},
    DataSet{"NYU Depth V2", "#_depth.png", "#_colors.png", 16, kMillimetres, 0.95},
    DataSet{"TUM RGB-D", "depth/#.#.png", "../rgb ../groundtruth.txt", 16, kTum, 0.97},
    DataSet{"TUM RGB-D", "depth/#.#.png", "../rgb", 16, kTum, 0.2},
    DataSet{"Taskonomy", "*_domain_depth_zbuffer.png", "", 16, kTaskonomy, 0.98},
    DataSet{"Taskonomy", "*_domain_depth_euclidean.png", "", 16, kTaskonomy, 0.98},
    DataSet{"DIODE", "*_depth.npy", "same_mask.npy", kRealBits, kMetresOr0, 0.97},
    // Things.
    DataSet{"BOP", "depth/#.*", "../scene_camera.json", 16, kBop, 0.995, DepthCode::grey, read_bop},
    DataSet{"YCB-Video", "#-depth.png", "#-color.* #-box.txt", 16, kYcb, 0.97},
    DataSet{"YCB-Video", "#-depth.png", "#-color.* #-meta.mat", 16, kYcb, 0.97},
    DataSet{"Middlebury stereo", "disp#*.pfm", "calib.txt", kRealBits, kByCalibration, 0.98,
            DepthCode::stereo, read_middlebury},
    DataSet{"Middlebury stereo", "disp#.png", "view#.png", 8, kDisparityOr0, 0.97},
    DataSet{"BlendedMVS", "rendered_depth_maps/#.pfm", "../blended_images", kRealBits,
            kFarBrightOr0, 0.98},
    DataSet{"DTU", "depth_map_#.pfm", "", kRealBits, kMvs, 0.99},
    // Inside the body.
    DataSet{"C3VD", "#_depth.tiff", "#_color.png #_normals.tiff", 16, kC3vd, 0.97},
    DataSet{"C3VD", "#_depth.tiff", "#_color.png #_occlusion.png", 16, kC3vd, 0.97},
    DataSet{"C3VD", "depth/#_depth.tiff", "../rgb", 16, kC3vd, 0.93},
    DataSet{"SimCol3D", "depth_#.png", "framebuffer_#.png", 16, kSimCol, 0.98},
    DataSet{"EndoSLAM", "pixelwise depths/aov_image_#.png", "", 8, kFarBright, 0.97},
    DataSet{"EndoSLAM", "depths/aov_image_#.png", "", 8, kFarBright, 0.95},
    DataSet{"Hamlyn", "depth0#/#.png", "../image0#", 16, kOrgan, 0.95},
    DataSet{"SCARED", "*_depth_map.tiff", "left_image.png", kRealBits, kPoints, 0.98,
            DepthCode::xyz},
    // Phones.
    DataSet{"Android's DEPTH16", "*depth16*", "", 16, kBelowConfidence, 0.97, DepthCode::depth16},
    DataSet{"Android's DEPTH16", "*arcore*", "", 16, kBelowConfidence, 0.97, DepthCode::depth16},
    // Programs that estimate depth.
    DataSet{"MiDaS", "*-dpt_*.png", "", 16, kNearBright, 0.95},
    DataSet{"MiDaS", "*-midas_*.png", "", 16, kNearBright, 0.95},
    DataSet{"MiDaS", "*-dpt_*.pfm", "", kRealBits, kDisparity, 0.95},
    DataSet{"MiDaS", "*-midas_*.pfm", "", kRealBits, kDisparity, 0.95},
    DataSet{"Marigold", "depth_npy*/*_pred.npy", "", kRealBits, kFarBright, 0.97},
    DataSet{"Marigold", "depth_bw*/*_pred.png", "", 16, kFarBright, 0.97},
    DataSet{"Depth Anything", "vis_depth/*.png", "", 8, kNearBright, 0.95},
    DataSet{"ZoeDepth", "*zoe*.png", "", 16, kEstimated, 0.85, DepthCode::grey, nullptr, true},
    DataSet{"ZoeDepth", "*_depth.png", "short.j*g", 16, kEstimated, 0.4, DepthCode::grey, nullptr,
            true},
    DataSet{"ZoeDepth", "*_depth.png", "short.png", 16, kEstimated, 0.4, DepthCode::grey, nullptr,
            true}};

// Comparison.

/// The number of letters that the first letter of a pattern stands for; 0: it does not fit.
std::size_t letters_of(char first, std::string_view name) {
    if (first == '#') return std::min(name.find_first_not_of("0123456789"), name.size());
    return !name.empty() && (first == '?' || first == name.front()) ? 1 : 0;
}

/// Whether a name fits a pattern; both in small letters. Only the last star is tried again with
/// more letters: a file's own name may be the pattern, with any number of stars.
bool fits_pattern(std::string_view name, std::string_view pattern) {
    std::optional<std::string_view> behind_star;
    std::string_view untried;  // of the name, behind the letters of that star
    while (!name.empty() || !pattern.empty()) {
        if (pattern.starts_with('*')) {
            pattern.remove_prefix(1);
            behind_star = pattern;
            untried = name;
        } else if (const auto count = pattern.empty() ? 0 : letters_of(pattern.front(), name)) {
            pattern.remove_prefix(1);
            name.remove_prefix(count);
        } else {
            if (!behind_star || untried.empty()) return false;
            untried.remove_prefix(1);
            name = untried;
            pattern = *behind_star;
        }
    }
    return true;
}

std::string name_in_small(const fs::path& place) {
    return lower_case(place.filename().string());
}

bool has_path(fs::path place, std::string_view pattern) {
    while (true) {
        const std::size_t slash = pattern.rfind('/');
        const std::size_t begin = slash == std::string_view::npos ? 0 : slash + 1;
        if (!fits_pattern(name_in_small(place), pattern.substr(begin))) return false;
        if (begin == 0) return true;
        pattern = pattern.substr(0, slash);
        place = place.parent_path();
    }
}

/// Whether the folder holds an entry of that name, or one that fits the pattern.
bool holds_entry(const fs::path& folder, const std::string& pattern) {
    std::error_code failed;
    if (fs::exists(folder / pattern, failed)) return true;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        if (fits_pattern(name_in_small(entry->path()), pattern)) return true;
    }
    return false;
}

bool is_beside(const fs::path& picture, std::string_view name) {
    constexpr std::string_view kSame = "same";
    constexpr std::string_view kShort = "short";
    constexpr std::string_view kUp = "../";
    fs::path folder = picture.parent_path();
    for (; name.starts_with(kUp); name.remove_prefix(kUp.size())) folder = folder.parent_path();
    const std::string stem = lower_case(picture.stem().string());
    std::string pattern(name);
    if (name.starts_with(kSame)) pattern.replace(0, kSame.size(), stem);
    if (name.starts_with(kShort))
        pattern.replace(0, kShort.size(), stem.substr(0, stem.find_last_of("_-")));
    return holds_entry(folder, pattern);
}

bool are_beside(const fs::path& picture, std::string_view names) {
    while (!names.empty()) {
        const std::size_t end = std::min(names.find(' '), names.size());
        if (!is_beside(picture, names.substr(0, end))) return false;
        names.remove_prefix(std::min(end + 1, names.size()));
    }
    return true;
}

DepthStatement statement_of(const DataSet& set) {
    const Values& values = set.values;
    DepthStatement said{.near = values.near, .unit = values.unit, .scale = values.scale};
    if (!std::isnan(values.no_data)) said.no_data = {values.no_data};
    if (set.code != DepthCode::grey) said.code = set.code;
    return said;
}

}  // namespace

std::optional<DataSetFacts> data_set_of(const SourceFacts& facts) {
    std::error_code failed;
    const fs::path picture = fs::absolute(facts.picture(), failed).lexically_normal();
    for (const DataSet& set : kDataSets) {
        if (set.bits != facts.bits || !has_path(picture, set.path) ||
            !are_beside(picture, set.beside))
            continue;
        const Values& values = set.values;
        DataSetFacts found;
        found.name = set.name;
        found.finding = {statement_of(set), Evidence::layout, set.sureness,
                         std::string(set.name) + ": " + std::string(values.words)};
        if (set.read != nullptr && !set.read(picture.parent_path(), facts, found)) continue;
        found.finding.usual = {std::string(set.name), values.least_m, values.most_m, 0.0,
                               set.is_dense};
        return found;
    }
    return std::nullopt;
}

const std::optional<DataSetFacts>& KnownDataSet::of(const SourceFacts& facts) {
    if (picture_ == facts.picture() && bits_ == facts.bits) return found_;
    found_ = data_set_of(facts);
    picture_ = facts.picture();
    bits_ = facts.bits;
    return found_;
}

}  // namespace dibhr
