// Parses numpy's headers, and reads pictures from the numbers behind them.
#include "core/video/formats/numpy_array.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

/// Many rows of few numbers.
bool is_list(const std::vector<std::int64_t>& sides) {
    constexpr std::int64_t kMostOfRow = 8;
    constexpr std::int64_t kLeastRows = 256;
    return sides.size() == 2 && sides[1] <= kMostOfRow && sides[0] >= kLeastRows;
}

constexpr std::uint64_t kMostHeaderBytes = 65536;
constexpr std::int64_t kLeastSide = 16;  ///< shorter sides count channels or frames

/// The text behind "'name':" in the header's dictionary; empty when it has no such key.
std::string_view value_of(std::string_view dictionary, const std::string& name) {
    const auto at = dictionary.find("'" + name + "':");
    if (at == std::string_view::npos) return {};
    const auto value = dictionary.find_first_not_of(' ', at + name.size() + 3);
    return value == std::string_view::npos ? std::string_view() : dictionary.substr(value);
}

/// "(3, 4)": 3, 4. Nothing for another syntax.
std::optional<std::vector<std::int64_t>> shape_of(std::string_view text) {
    if (!text.starts_with('(')) return std::nullopt;
    std::vector<std::int64_t> shape;
    text.remove_prefix(1);
    while (!text.empty()) {
        if (text.front() == ')') return shape;
        if (text.front() == ' ' || text.front() == ',' || text.front() == 'L') {
            text.remove_prefix(1);
            continue;
        }
        std::int64_t side = 0;
        const auto end = std::from_chars(text.data(), text.data() + text.size(), side);
        if (end.ec != std::errc() || side < 0) return std::nullopt;
        shape.push_back(side);
        text.remove_prefix(static_cast<std::size_t>(end.ptr - text.data()));
    }
    return std::nullopt;
}

/// Parses "'<f4'" into kind, bytes and byte order. False for an unsupported type.
bool read_type(std::string_view text, NumpyHeader& header) {
    if (text.size() < 5 || text[0] != '\'' || text[4] != '\'') return false;
    header.kind = text[2];
    header.number_bytes = text[3] - '0';
    const bool little = std::endian::native == std::endian::little;
    header.swapped = text[1] == (little ? '>' : '<');
    constexpr std::array<std::string_view, 11> kTypes{"f2", "f4", "f8", "u1", "u2", "u4",
                                                      "u8", "i1", "i2", "i4", "i8"};
    return std::find(kTypes.begin(), kTypes.end(), text.substr(2, 2)) != kTypes.end();
}

/// What an array is whose type is not read, after the name of its file. Those within an archive
/// have no file of their own for a command.
std::string advice_on_type(const fs::path& file, const std::string& dictionary) {
    const std::string_view type = value_of(dictionary, "descr");
    if (type.starts_with("'|b1'"))
        return " holds no plain numbers but true and false, as a mask does, and no depth: give the "
               "depth that it belongs to";
    if (type.starts_with("'|O'") && value_of(dictionary, "shape").starts_with("()") &&
        file.extension() == ".npy")
        return filled_advice(
            " holds Python objects and no plain numbers: if you trust the file, save its depth: "
            "python3 -c \"import numpy; d = numpy.load('{}', allow_pickle=True).item(); "
            "numpy.save('depth.npy', d[max(d, key=lambda k: 'dep' in k.lower())])\"",
            file);
    return " holds no array of plain numbers: save its depth as float32 by numpy.save (Python "
           "objects are read by numpy.load with allow_pickle=True, if you trust the file)";
}

/// The dictionary of a header, and where it ends. Throws InputError.
std::pair<std::string, std::uint64_t> dictionary_of(const fs::path& file, ArrayBytes& bytes) {
    std::array<std::uint8_t, 12> head{};
    const bool long_enough = bytes.size() >= head.size();
    if (long_enough) bytes.read(0, head);
    constexpr std::string_view kMagic = "\x93NUMPY";
    if (!long_enough || std::memcmp(head.data(), kMagic.data(), kMagic.size()) != 0)
        throw InputError(shown(file) + " holds no numpy array: save it again by numpy.save");
    const bool first_version = head[6] == 1;
    const std::uint64_t begin = first_version ? 10 : 12;
    std::uint64_t length = head[8] | std::uint64_t{head[9]} << 8U;
    if (!first_version) length |= std::uint64_t{head[10]} << 16U | std::uint64_t{head[11]} << 24U;
    if (length > kMostHeaderBytes || begin + length > bytes.size())
        throw InputError(shown(file) + " is cut off or damaged: copy it or save it again");
    std::string dictionary(length, '\0');
    bytes.read(begin, {reinterpret_cast<std::uint8_t*>(dictionary.data()), length});
    return {std::move(dictionary), begin + length};
}

NumpyHeader read_header(const fs::path& file, ArrayBytes& bytes) {
    NumpyHeader header;
    const auto [dictionary, end] = dictionary_of(file, bytes);
    header.data_at = end;
    header.fortran = value_of(dictionary, "fortran_order").starts_with("True");
    const auto shape = shape_of(value_of(dictionary, "shape"));
    if (!shape || !read_type(value_of(dictionary, "descr"), header))
        throw InputError(shown(file) + advice_on_type(file, dictionary));
    header.shape = *shape;
    return header;
}

std::string text_of(const std::vector<std::int64_t>& shape) {
    std::string text;
    for (const std::int64_t side : shape) text += (text.empty() ? "" : ", ") + std::to_string(side);
    return "[" + text + "]";
}

/// Whether two pictures of one channel look like frames of one recording, and not like two
/// quantities: values of the same size, high where the other's are high.
bool are_alike(const cv::Mat& a, const cv::Mat& b) {
    constexpr double kLeastCorrelation = 0.5;
    constexpr double kMostRatio = 3.0;  // of the standard deviations
    constexpr double kMostShift = 1.0;  // of the means, in standard deviations
    const cv::Mat finite = (cv::abs(a) <= std::numeric_limits<float>::max()) &
                           (cv::abs(b) <= std::numeric_limits<float>::max());
    std::array<cv::Scalar, 2> means;
    std::array<cv::Scalar, 2> deviations;
    cv::meanStdDev(a, means[0], deviations[0], finite);
    cv::meanStdDev(b, means[1], deviations[1], finite);
    const auto [least, most] = std::minmax(deviations[0][0], deviations[1][0]);
    if (!(least > 0.0) || most > kMostRatio * least ||
        std::abs(means[0][0] - means[1][0]) > kMostShift * most)
        return false;
    cv::Mat product;
    cv::multiply(a - means[0], b - means[1], product, 1.0, CV_64F);
    return cv::mean(product, finite)[0] >= kLeastCorrelation * least * most;
}

/// Every so many pixels of a large picture, as real numbers.
cv::Mat thinned(const cv::Mat& picture) {
    constexpr int kMostSide = 256;
    cv::Mat few;
    cv::resize(picture, few, {std::min(picture.cols, kMostSide), std::min(picture.rows, kMostSide)},
               0.0, 0.0, cv::INTER_NEAREST);
    few.convertTo(few, CV_32F);
    return few;
}

/// The number of elements; nothing when they take more than `most_bytes`.
std::optional<std::int64_t> count_of(const NumpyHeader& header, std::uint64_t most_bytes) {
    const auto bytes = static_cast<std::uint64_t>(header.number_bytes);
    std::uint64_t count = 1;
    for (const std::int64_t side : header.shape) {
        const auto factor = static_cast<std::uint64_t>(side);
        if (factor == 0) return 0;
        if (count > most_bytes / bytes / factor) return std::nullopt;
        count *= factor;
    }
    return static_cast<std::int64_t>(count);
}

/// OpenCV's type of the numbers. NumpyArray::read() corrects u4, i8 and u8, which OpenCV lacks.
int mat_type(const NumpyHeader& header) {
    // Index: 1, 2, 4 or 8 bytes; real numbers have at least 2.
    constexpr std::array kReal{CV_8U, CV_16F, CV_32F, CV_64F};
    constexpr std::array kSigned{CV_8S, CV_16S, CV_32S, CV_64F};
    constexpr std::array kUnsigned{CV_8U, CV_16U, CV_32S, CV_64F};
    const auto& types = header.kind == 'f' ? kReal : header.kind == 'i' ? kSigned : kUnsigned;
    const int doublings = std::countr_zero(static_cast<unsigned>(header.number_bytes));
    return types[static_cast<std::size_t>(doublings)];
}

/// Converts whole numbers of eight bytes, which OpenCV does not have, to real ones in place.
void make_real(cv::Mat& numbers) {
    for (double& number : cv::Mat_<double>(numbers)) {
        std::int64_t whole = 0;
        std::memcpy(&whole, &number, sizeof whole);
        number = static_cast<double>(whole);
    }
}

/// Corrects unsigned numbers that OpenCV read as negative.
void restore_unsigned(cv::Mat& numbers) {
    cv::Mat real;
    numbers.convertTo(real, CV_64F);
    cv::add(real, cv::Scalar::all(4294967296.0), real, real < 0.0);
    numbers = real;
}

}  // namespace

std::string loading_of(const fs::path& file, const std::string& name) {
    return "numpy.load(" + shown(file.filename()) + ")" +
           (name.empty() ? std::string() : "['" + one_line(name) + "']");
}

NumpyArray::NumpyArray(fs::path file, const std::string& name, std::unique_ptr<ArrayBytes> bytes)
    : file_(std::move(file)),
      loaded_(loading_of(file_, name)),
      bytes_(std::move(bytes)),
      header_(read_header(file_, *bytes_)) {
    const auto count = count_of(header_, bytes_->size() - header_.data_at);
    if (!count)
        throw InputError(shown(file_) + " is shorter than its header says (" +
                         text_of(header_.shape) + "): copy it or save it again");
    count_ = *count;
}

std::vector<double> NumpyArray::numbers(std::int64_t most) {
    if (count_ > most || count_ == 0) return {};
    cv::Mat real;
    read(0, count_).convertTo(real, CV_64F);
    return {real.begin<double>(), real.end<double>()};
}

bool NumpyArray::has_sides_of_pictures() const {
    return std::count_if(header_.shape.begin(), header_.shape.end(),
                         [](std::int64_t side) { return side >= kLeastSide; }) >= 2;
}

/// Whether it holds one or more matrices of 3 x 3 or 4 x 4 numbers whose last row is 0, 0, ..., 1,
/// as cameras and poses have.
bool NumpyArray::is_matrix() {
    const std::vector<std::int64_t>& sides = header_.shape;
    const bool is_row = sides.size() == 3 && !header_.fortran;
    if ((sides.size() != 2 && !is_row) || count_ == 0) return false;
    const std::int64_t side = sides.back();
    if (sides[sides.size() - 2] != side || (side != 3 && side != 4)) return false;
    cv::Mat real;
    read(0, side * side).convertTo(real, CV_64F);
    const cv::Mat matrix = real.reshape(1, static_cast<int>(side));
    const cv::Mat last =
        header_.fortran ? cv::Mat(matrix.col(matrix.cols - 1).t()) : matrix.row(matrix.rows - 1);
    return last.at<double>(static_cast<int>(side) - 1) == 1.0 && cv::countNonZero(last) == 1;
}

/// Throws InputError where the last axis does not count frames, but numbers of each pixel.
void NumpyArray::require_frames(const PictureShape& shape) {
    cv::Mat before = thinned(picture(shape, 0));
    for (std::int64_t k = 1; k < shape.frames; ++k) {
        const cv::Mat next = thinned(picture(shape, k));
        if (!are_alike(before, next))
            throw InputError(
                shown(file_) + " holds " + std::to_string(shape.frames) +
                " different numbers of each pixel, in the shape " + text_of(header_.shape) +
                ", and none is named depth: save the one that is, as the first, [..., 0]: python3 "
                "-c \"import numpy; numpy.save('depth.npy', " +
                loaded_ + "[..., 0])\"");
        before = next;
    }
}

/// Throws InputError when the pictures are larger than the bounds.
void NumpyArray::require_bounded_size(const PictureShape& shape) const {
    require_plausible_size(file_, shape.columns, shape.rows, shape.channels * header_.number_bytes);
    if (shape.frames > kMostPictures)
        throw InputError(shown(file_) + " holds " + std::to_string(shape.frames) +
                         " pictures: save at most 10 million in one array");
    const bool is_scattered = header_.fortran != shape.frames_last;
    if (!is_scattered || count_ <= kMostPictureBytes / header_.number_bytes) return;
    throw InputError(shown(file_) +
                     (shape.frames_last
                          ? " is too large with its frames in the last axis: save "
                            "numpy.ascontiguousarray(numpy.moveaxis(a, -1, 0)) of it"
                          : " is too large in Fortran order: save numpy.ascontiguousarray of it"));
}

PictureShape NumpyArray::pictures() {
    if (is_matrix())
        throw InputError(shown(file_) + " holds numbers in the shape " + text_of(header_.shape) +
                         ", the matrix of a camera or a pose, and no picture: give the depth that "
                         "it belongs to");
    std::vector<std::int64_t> sides = header_.shape;
    if (is_list(sides))
        throw InputError(
            shown(file_) + " holds numbers in the shape " + text_of(sides) +
            filled_advice(
                ", a list of points or poses, and no picture: save points as text with python3 -c "
                "\"import numpy; numpy.savetxt('points.xyz', numpy.load('{}')[:, :3])\", open "
                "that in CloudCompare (package cloudcompare), choose Tools, Projection, Rasterize, "
                "save the heights as GeoTIFF (height.tif, or depth.tif where Z points away from "
                "the camera), and give that",
                file_));
    const bool of_colours = header_.kind == 'u' && header_.number_bytes == 1;
    PictureShape shape;
    // Estimators' batches: [1, frames, ...]
    while (sides.size() > 4 && sides.front() == 1) sides.erase(sides.begin());
    if (sides.size() > 2) {
        const std::int64_t last = sides.back();
        const bool may_be_planar =
            sides.size() == 4 && (sides[1] == 1 || (sides[1] == 3 && !header_.fortran));
        if (last == 1 || last == 3 || (of_colours && last == 4)) {
            shape.channels = last;
            sides.pop_back();
        } else if (may_be_planar) {  // [frames, channels, rows, columns]
            shape.channels = sides[1];
            shape.is_planar = shape.channels > 1;
            sides.erase(sides.begin() + 1);
        }
    }
    if (sides.size() == 4 && sides.front() == 1) sides.erase(sides.begin());
    if (sides.size() == 2) sides.insert(sides.begin(), 1);
    if (sides.size() != 3 || count_ == 0)
        throw InputError(shown(file_) + " holds numbers in the shape " + text_of(header_.shape) +
                         ": save depth as [rows, columns] or [frames, rows, columns], and colours "
                         "as the same with 3 at the end");
    shape.frames_last =
        sides[2] < kLeastSide && std::min(sides[0], sides[1]) >= kLeastSide && shape.channels == 1;
    if (shape.frames_last) std::rotate(sides.begin(), sides.begin() + 2, sides.end());
    shape.frames = sides[0];
    shape.rows = sides[1];
    shape.columns = sides[2];
    require_bounded_size(shape);
    if (shape.frames_last) require_frames(shape);
    return shape;
}

/// Reads `count` numbers from `first` on, as one row.
cv::Mat NumpyArray::read(std::uint64_t first, std::int64_t count) {
    const auto number_bytes = static_cast<std::size_t>(header_.number_bytes);
    cv::Mat numbers(1, static_cast<int>(count), mat_type(header_));
    const std::span<std::uint8_t> bytes(numbers.ptr<std::uint8_t>(),
                                        static_cast<std::size_t>(count) * number_bytes);
    bytes_->read(header_.data_at + first * number_bytes, bytes);
    if (header_.swapped) swap_bytes(bytes, number_bytes);
    if (header_.kind != 'f' && number_bytes == 8) make_real(numbers);
    if (header_.kind == 'u' && number_bytes == 4) restore_unsigned(numbers);
    return numbers;
}

/// In Fortran order the frame index varies fastest, then the row, then the column.
cv::Mat NumpyArray::fortran_picture(const PictureShape& shape, std::int64_t frame) {
    if (whole_.empty()) whole_ = read(0, count_);
    const cv::Mat by_frame = whole_.reshape(1, static_cast<int>(count_ / shape.frames));
    const cv::Mat own = by_frame.col(static_cast<int>(frame)).clone();
    const auto columns = static_cast<int>(shape.columns);
    const cv::Mat upright = own.reshape(1, columns * static_cast<int>(shape.channels));
    std::vector<cv::Mat> planes;
    planes.reserve(static_cast<std::size_t>(shape.channels));
    for (int k = 0; k < static_cast<int>(shape.channels); ++k)
        planes.emplace_back(upright.rowRange(k * columns, (k + 1) * columns).t());
    if (planes.size() == 1) return planes.front();
    cv::Mat picture;
    cv::merge(planes, picture);
    return picture;
}

/// In C order.
cv::Mat NumpyArray::plain_picture(const PictureShape& shape, std::int64_t frame) {
    const std::int64_t count = shape.rows * shape.columns * shape.channels;
    const auto rows = static_cast<int>(shape.rows);
    const auto channels = static_cast<int>(shape.channels);
    const cv::Mat numbers = read(static_cast<std::uint64_t>(frame * count), count);
    if (!shape.is_planar) return numbers.reshape(channels, rows);
    const cv::Mat stacked = numbers.reshape(1, channels * rows);
    std::vector<cv::Mat> planes;
    planes.reserve(static_cast<std::size_t>(channels));
    for (int k = 0; k < channels; ++k) planes.push_back(stacked.rowRange(k * rows, (k + 1) * rows));
    cv::Mat picture;
    cv::merge(planes, picture);
    return picture;
}

/// In C order all frames of a pixel follow each other; in Fortran order each frame lies in one
/// piece, column by column.
cv::Mat NumpyArray::last_axis_picture(const PictureShape& shape, std::int64_t frame) {
    const std::int64_t count = shape.rows * shape.columns;
    if (header_.fortran)
        return read(static_cast<std::uint64_t>(frame * count), count)
            .reshape(1, static_cast<int>(shape.columns))
            .t();
    if (whole_.empty()) whole_ = read(0, count_);
    const cv::Mat by_pixel = whole_.reshape(1, static_cast<int>(count));
    return by_pixel.col(static_cast<int>(frame)).clone().reshape(1, static_cast<int>(shape.rows));
}

cv::Mat NumpyArray::picture(const PictureShape& shape, std::int64_t frame) {
    cv::Mat picture = shape.frames_last ? last_axis_picture(shape, frame)
                      : header_.fortran ? fortran_picture(shape, frame)
                                        : plain_picture(shape, frame);
    const bool keeps = picture.depth() == CV_8U || picture.depth() == CV_16U;
    if (!keeps) picture.convertTo(picture, CV_32F);
    if (picture.channels() == 3) cv::cvtColor(picture, picture, cv::COLOR_RGB2BGR);
    if (picture.channels() == 4) cv::cvtColor(picture, picture, cv::COLOR_RGBA2BGRA);
    return picture;
}

}  // namespace dibhr
