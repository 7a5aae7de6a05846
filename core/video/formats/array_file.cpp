// Chooses the array of a file by name, and reads its frames with their times.
#include "core/video/formats/array_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/depth_words.hpp"
#include "core/video/formats/camera_files.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;
using Words = std::span<const std::string_view>;

constexpr std::array<std::string_view, 4> kDepthNames{"depths", "depth", "disparity", "disp"};
constexpr std::array<std::string_view, 7> kColourNames{"images", "image",  "rgb",    "color",
                                                       "colour", "colors", "colours"};
constexpr std::array<std::string_view, 2> kTimeNames{"times", "timestamps"};
constexpr std::array<std::string_view, 1> kRateNames{"fps"};
constexpr std::array<std::string_view, 5> kCameraNames{"k", "intrinsics", "intrinsic", "cam_k",
                                                       "camk"};
constexpr std::size_t kMostExamined = 256;  ///< arrays whose headers are read

// Words of the names of arrays.
constexpr std::array<std::string_view, 5> kWordsOfDepth{"depths", "disp", "disps", "disparities",
                                                        "idepth"};
constexpr std::array<std::string_view, 10> kWordsOfDistance{
    "z",    "zbuffer", "range",      "distance",    "distances",
    "dist", "pred",    "prediction", "predictions", "predicted"};

/// The array with the first of these names, in any case; nothing when there is none.
std::optional<std::string> named(const NamedArrays& arrays, Words words) {
    for (const std::string_view word : words)
        for (const std::string& name : arrays.names())
            if (lower_case(name) == word) return name;
    return std::nullopt;
}

/// Whether one of the words of a name is in a list.
bool has_word(const std::string& name, Words words) {
    const std::vector<std::string> all = words_of_name(name);
    return std::any_of(all.begin(), all.end(),
                       [words](const std::string& word) { return is_one_of(word, words); });
}

bool names_depth(const std::string& name) {
    const std::string small = lower_case(name);
    return small.find("depth") != std::string::npos ||
           small.find("disparity") != std::string::npos || has_word(name, kWordsOfDepth);
}

bool names_other_content(const std::string& name) {
    const std::vector<std::string> all = words_of_name(name);
    return std::any_of(all.begin(), all.end(),
                       [](const std::string& word) { return other_content_of(word) != nullptr; });
}

/// Arrays that can be pictures of a role.
struct Candidates {
    std::vector<std::string> named{};   ///< whose names say so
    std::vector<std::string> likely{};  ///< whose names are usual for it
    std::vector<std::string> others{};

    /// The surest that are there.
    [[nodiscard]] const std::vector<std::string>& surest() const {
        return !named.empty() ? named : !likely.empty() ? likely : others;
    }
};

/// What the header of an array says; nothing where its shape is not that of pictures.
std::optional<NumpyHeader> picture_header_of(const NamedArrays& arrays, const std::string& name) {
    try {
        const NumpyArray array(arrays.file(), name, arrays.open(name));
        return array.has_sides_of_pictures() ? std::optional(array.header()) : std::nullopt;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

bool is_of_coloured_bytes(const NumpyHeader& header) {
    const std::vector<std::int64_t>& sides = header.shape;
    const bool has_channels = sides.size() > 2 && (sides.back() == 3 || sides.back() == 4 ||
                                                   (sides.size() > 3 && *(sides.end() - 3) == 3));
    return header.kind == 'u' && header.number_bytes == 1 && has_channels;
}

Candidates candidates_in(const NamedArrays& arrays, PictureRole role) {
    Candidates found;
    if (!arrays.zipped() || arrays.names().size() > kMostExamined) return found;
    for (const std::string& name : arrays.names()) {
        const auto header = picture_header_of(arrays, name);
        if (!header || names_other_content(name)) continue;
        const bool is_colour = is_of_coloured_bytes(*header);
        if (role == PictureRole::colour) {
            if (is_colour && !names_depth(name)) found.others.push_back(name);
        } else if (!is_colour && !is_one_of(lower_case(name), kColourNames)) {
            (names_depth(name)                  ? found.named
             : has_word(name, kWordsOfDistance) ? found.likely
                                                : found.others)
                .push_back(name);
        }
    }
    return found;
}

/// The array that has a name of that role.
std::optional<std::string> called_as(const NamedArrays& arrays, PictureRole role) {
    return role == PictureRole::depth ? named(arrays, kDepthNames) : named(arrays, kColourNames);
}

/// Whether one is of that role by its name, or as the only one that can be.
bool holds_array(const NamedArrays& arrays, PictureRole role) {
    return called_as(arrays, role) || candidates_in(arrays, role).surest().size() == 1;
}

/// The first names, for people.
std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t kMostNamed = 4;
    std::vector<std::string> quoted;
    for (const std::string& name : names)
        if (quoted.size() < kMostNamed) quoted.push_back(in_quotes(name));
    if (names.size() > kMostNamed) quoted.emplace_back("...");
    return listed(quoted);
}

[[noreturn]] void refuse_several(const NamedArrays& arrays, const std::vector<std::string>& names) {
    throw InputError(shown(arrays.file()) + " holds " + std::to_string(names.size()) +
                     " arrays that may be the depth, " + some_of(names) +
                     ": save the one to touch: python3 -c \"import numpy; "
                     "numpy.save('depth.npy', " +
                     loading_of(arrays.file(), names.front()) + ")\"");
}

/// The array of that role. Throws InputError when none, or more than one, is possible.
std::string chosen(const NamedArrays& arrays, PictureRole role) {
    const bool is_depth = role == PictureRole::depth;
    if (const auto called = called_as(arrays, role)) return *called;
    const Candidates candidates = candidates_in(arrays, role);
    const std::vector<std::string>& surest = candidates.surest();
    if (surest.size() == 1) return surest.front();
    if (is_depth && surest.size() > 1) refuse_several(arrays, surest);
    std::vector<std::string> left;
    std::copy_if(arrays.names().begin(), arrays.names().end(), std::back_inserter(left),
                 [](const std::string& name) {
                     const std::string small = lower_case(name);
                     return !is_one_of(small, kTimeNames) && !is_one_of(small, kRateNames) &&
                            !is_one_of(small, kCameraNames);
                 });
    if (left.size() == 1) return left.front();
    throw InputError(shown(arrays.file()) + " holds " + std::to_string(left.size()) + " arrays, " +
                     (left.empty() ? "" : some_of(left) + ", ") + "none of them called " +
                     (is_depth ? "depths, depth, disparity or disp" : "images or rgb") +
                     ": save the right one with that name, or give another file");
}

NumpyArray opened(const NamedArrays& arrays, const std::string& name) {
    return {arrays.file(), name, arrays.open(name)};
}

/// The numbers of the array with one of these names; empty when it is missing, has more than
/// `most`, or is no array of numbers.
std::vector<double> numbers_of(const NamedArrays& arrays, Words words, std::int64_t most) {
    const auto name = named(arrays, words);
    if (!name) return {};
    try {
        NumpyArray array = opened(arrays, *name);
        return array.numbers(most);
    } catch (const InputError&) {
        return {};  // the depth is readable without these
    }
}

/// The first nine numbers as a matrix, row by row. Estimators also state it in parts of the picture
/// (MoGe): then the centre is below 1.
Intrinsics intrinsics_of(const std::vector<double>& rows, const PictureShape& shape) {
    const Intrinsics camera{rows[0], rows[4], rows[2], rows[5]};
    const auto is_part = [](double value) { return value > 0.0 && value < 1.0; };
    if (!is_part(camera.cx) || !is_part(camera.cy) || !(camera.fx < 10.0)) return camera;
    const auto columns = static_cast<double>(shape.columns);
    const auto height = static_cast<double>(shape.rows);
    return {camera.fx * columns, camera.fy * height, camera.cx * columns - 0.5,
            camera.cy * height - 0.5};
}

Finding finding_in(const std::string& array, const DepthStatement& statement) {
    return finding_of_metadata(statement, "array " + in_quotes(array));
}

/// What an array beside it says that one level is.
Findings findings_on_scale(const NamedArrays& arrays, bool is_real) {
    const std::vector<double> stated = numbers_of(arrays, depth_scale_names(), 1);
    const auto level_mm = stated.empty() ? std::nullopt : level_mm_of(stated.front(), is_real);
    if (!level_mm) return {};
    return {finding_in(*named(arrays, depth_scale_names()),
                       {.unit = DepthUnit::mm, .scale = *level_mm})};
}

}  // namespace

bool is_array_file(const fs::path& file, std::string_view head) {
    return is_npy(head) || is_npz(file, head);
}

bool arrays_have_colour_and_depth(const fs::path& file) {
    if (!is_npz(file, head_of(file))) return false;
    const NamedArrays arrays(file);
    return holds_array(arrays, PictureRole::colour) && holds_array(arrays, PictureRole::depth);
}

bool may_be_picture(const fs::path& file) {
    if (!is_npy(head_of(file))) return true;
    try {
        return NumpyArray(file, {}, NamedArrays(file).open({})).has_sides_of_pictures();
    } catch (const InputError&) {
        return true;  // the refusal says why it cannot be read
    }
}

ArrayFile::ArrayFile(const fs::path& file, PictureRole role) : ArrayFile(NamedArrays(file), role) {}

ArrayFile::ArrayFile(const NamedArrays& arrays, PictureRole role)
    : role_(role),
      name_(chosen(arrays, role)),
      array_(opened(arrays, name_)),
      shape_(array_.pictures()) {
    const NumpyHeader& header = array_.header();
    const bool is_of_bytes = header.kind == 'u' && header.number_bytes == 1;
    const bool may_be_colours = is_of_bytes || (header.kind == 'f' && shape_.channels == 3);
    if (role == PictureRole::colour && !may_be_colours)
        throw InputError(shown(arrays.file()) +
                         " holds depth and no colours (uint8): give it as the depth file");
    read_facts(arrays);
    require_size(facts_.file, facts_.columns, facts_.rows);
    first_ = array_.picture(shape_, 0);
    if (role == PictureRole::depth) require_no_mask();
    if (role == PictureRole::colour && !is_of_bytes) find_white();
    read_times(arrays);
}

void ArrayFile::read_facts(const NamedArrays& arrays) {
    facts_.file = arrays.file();
    facts_.columns = static_cast<int>(shape_.columns);
    facts_.rows = static_cast<int>(shape_.rows);
    const bool whole = array_.header().kind == 'u';
    const int bytes = array_.header().number_bytes;
    facts_.bits = whole && bytes <= 2 ? 8 * bytes : kRealBits;
    facts_.channels = role_ == PictureRole::colour ? 3 : static_cast<int>(shape_.channels);
    facts_.codec = arrays.zipped() ? "NPZ" : "NPY";
    if (role_ == PictureRole::colour || !arrays.zipped()) return;
    if (lower_case(name_).starts_with("disp"))
        facts_.findings.push_back(finding_in(name_, {.unit = DepthUnit::disparity}));
    else
        facts_.findings = findings_in_name(name_, facts_.bits, "its array's name");
    for (Finding& row : findings_on_scale(arrays, facts_.bits == kRealBits))
        facts_.findings.push_back(std::move(row));
    constexpr std::int64_t kMostOfCamera = std::int64_t{9} << 20;  // one a frame
    const std::vector<double> rows = numbers_of(arrays, kCameraNames, kMostOfCamera);
    if (rows.size() < 9) return;
    const Intrinsics camera = intrinsics_of(rows, shape_);
    if (is_camera(camera))
        facts_.findings.push_back(finding_in(*named(arrays, kCameraNames), {.intrinsics = camera}));
    else
        add_clause(facts_.notice,  // why it is none
                   fit_camera(camera, {}, {facts_.columns, facts_.rows}).notice);
}

void ArrayFile::read_times(const NamedArrays& arrays) {
    const std::vector<double> rate = numbers_of(arrays, kRateNames, 1);
    const bool usable = !rate.empty() && rate[0] >= 0.001 && rate[0] <= 10000.0;
    const double frames_per_s = usable ? rate[0] : kPicturesPerSecond;
    std::vector<double> times_s = numbers_of(arrays, kTimeNames, shape_.frames);
    facts_.timing = {.from = TimesFrom::list, .text = "in the file"};
    if (std::cmp_not_equal(times_s.size(), shape_.frames) || !is_rising(times_s)) {
        times_s.clear();
        facts_.timing = assumed_timing();
        if (usable) facts_.timing = {.from = TimesFrom::stated, .text = "by the rate in the file"};
        for (std::int64_t k = 0; k < shape_.frames; ++k)
            times_s.push_back(static_cast<double>(k) / frames_per_s);
    }
    take_times(std::move(times_s));
}

/// Networks have colours from 0 to 1, or from -1 to 1; others from 0 to 255.
void ArrayFile::find_white() {
    constexpr double kMostOfParts = 1.5;
    constexpr double kLeastBelow = -0.01;
    double lowest = 0.0;
    double highest = 0.0;
    cv::minMaxIdx(first_.reshape(1), &lowest, &highest);
    if (!(lowest >= -kMostOfParts && highest <= highest_level(8)))
        throw InputError(shown(facts_.file) +
                         " holds points or normals and no colours: save the colours as uint8");
    black_ = lowest < kLeastBelow ? -1.0 : 0.0;
    white_ = highest <= kMostOfParts ? 1.0 : highest_level(8);
}

/// Throws InputError where the first frame has both 0 and 1, and nothing else.
void ArrayFile::require_no_mask() const {
    const cv::Mat numbers = first_.reshape(1);
    const int zeros = cv::countNonZero(numbers == 0.0);
    if (zeros == 0) return;
    const int ones = cv::countNonZero(numbers == 1.0);
    if (ones == 0 || zeros + ones != static_cast<int>(numbers.total())) return;
    throw InputError(shown(facts_.file) +
                     " holds 0 and 1 alone, as a mask does, and no depth: give the depth that it "
                     "belongs to, or save it as a picture (PNG) to touch its two levels");
}

cv::Mat ArrayFile::picture(std::size_t at) {
    cv::Mat frame = at == 0 && !first_.empty()
                        ? std::exchange(first_, cv::Mat())
                        : array_.picture(shape_, static_cast<std::int64_t>(at));
    if (role_ == PictureRole::colour && frame.depth() != CV_8U) {
        const double scale = highest_level(8) / (white_ - black_);
        frame.convertTo(frame, CV_8U, scale, -black_ * scale);
    }
    if (role_ == PictureRole::colour && frame.channels() == 1)
        cv::cvtColor(frame, frame, cv::COLOR_GRAY2BGR);
    if (role_ == PictureRole::colour && frame.channels() == 4)
        cv::cvtColor(frame, frame, cv::COLOR_BGRA2BGR);
    return frame;
}

StillPicture read_array(const fs::path& file, PictureRole role) {
    ArrayFile array(file, role);
    const SourceFacts& facts = array.facts();
    return {array.next()->picture, facts.bits, facts.codec, facts.findings};
}

}  // namespace dibhr
