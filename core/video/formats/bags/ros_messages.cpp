// Parses messages; a truncated message, or one with impossible sizes, gives nothing.
#include "core/video/formats/bags/ros_messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "core/video/formats/camera_files.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/still_picture.hpp"

namespace dibhr {

namespace {

constexpr std::uint32_t kLongestSide = 1U << 20;

/// Reads a message from its beginning. Beyond its end it gives zeros, and whole() is false.
class CdrReader {
  public:
    explicit CdrReader(Bytes message) : bytes_(message) {
        // The representation: plain CDR, big- or little-endian; then two bytes of options.
        whole_ = message.size() >= 4 && message[0] == 0 && message[1] <= 1;
        swapped_ = whole_ && (message[1] == 1) != (std::endian::native == std::endian::little);
        if (whole_) bytes_ = message.subspan(4);
    }

    [[nodiscard]] bool whole() const noexcept { return whole_; }

    /// Numbers are aligned to their own size.
    template <typename Number>
    Number number() {
        at_ += (sizeof(Number) - at_ % sizeof(Number)) % sizeof(Number);
        const Bytes raw = take(sizeof(Number));
        std::array<std::uint8_t, sizeof(Number)> bytes{};
        std::copy(raw.begin(), raw.end(), bytes.begin());
        if (swapped_) std::reverse(bytes.begin(), bytes.end());
        Number value{};
        std::memcpy(&value, bytes.data(), sizeof value);
        return value;
    }

    Bytes sequence() { return take(number<std::uint32_t>()); }

    std::string text() {
        const Bytes letters = sequence();
        std::string text(letters.begin(), letters.end());
        if (!text.empty() && text.back() == '\0') text.pop_back();
        return text;
    }

  private:
    Bytes take(std::size_t count) {
        whole_ = whole_ && at_ <= bytes_.size() && count <= bytes_.size() - at_;
        if (!whole_) return {};
        const Bytes taken = bytes_.subspan(at_, count);
        at_ += count;
        return taken;
    }

    Bytes bytes_;
    std::size_t at_{0};
    bool whole_{false};
    bool swapped_{false};
};

/// std_msgs/msg/Header; its stamp in nanoseconds.
std::int64_t header_of(CdrReader& reader) {
    const auto seconds = reader.number<std::int32_t>();
    const auto rest_ns = reader.number<std::uint32_t>();
    return std::int64_t{seconds} * 1'000'000'000 + rest_ns;
}

/// Encodings as sensor_msgs/image_encodings.hpp names them.
struct Encoding {
    std::string_view name;
    RosPicture kind;
    int type;    ///< OpenCV's, as it is stored
    int to_bgr;  ///< OpenCV's conversion; -1: none is needed
};
constexpr std::array kEncodings{Encoding{"16UC1", RosPicture::depth, CV_16UC1, -1},
                                Encoding{"mono16", RosPicture::depth, CV_16UC1, -1},
                                Encoding{"32FC1", RosPicture::depth, CV_32FC1, -1},
                                Encoding{"mono8", RosPicture::grey, CV_8UC1, cv::COLOR_GRAY2BGR},
                                Encoding{"8UC1", RosPicture::grey, CV_8UC1, cv::COLOR_GRAY2BGR},
                                Encoding{"rgb8", RosPicture::colour, CV_8UC3, cv::COLOR_RGB2BGR},
                                Encoding{"bgr8", RosPicture::colour, CV_8UC3, -1},
                                Encoding{"8UC3", RosPicture::colour, CV_8UC3, -1},
                                Encoding{"rgba8", RosPicture::colour, CV_8UC4, cv::COLOR_RGBA2BGR},
                                Encoding{"bgra8", RosPicture::colour, CV_8UC4, cv::COLOR_BGRA2BGR},
                                Encoding{"8UC4", RosPicture::colour, CV_8UC4, cv::COLOR_BGRA2BGR}};

const Encoding* encoding_of(const std::string& name) {
    const auto found = std::find_if(kEncodings.begin(), kEncodings.end(),
                                    [&](const Encoding& known) { return known.name == name; });
    return found == kEncodings.end() ? nullptr : &*found;
}

bool holds(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

bool is_compressed_depth(const RosImage& image) {
    return image.compressed && holds(image.encoding, "compressedDepth");
}

cv::Mat plain_picture(const RosImage& image) {
    const Encoding* const encoding = encoding_of(image.encoding);
    if (encoding == nullptr ||
        !may_be_decoded(image.columns, image.rows, CV_ELEM_SIZE(encoding->type)))
        return {};
    const std::uint64_t row_bytes = std::uint64_t{image.columns} * CV_ELEM_SIZE(encoding->type);
    // The last row may lack the padding.
    const std::uint64_t needed = std::uint64_t{image.step} * (image.rows - 1) + row_bytes;
    if (image.step < row_bytes || needed > image.data.size()) return {};
    cv::Mat picture(static_cast<int>(image.rows), static_cast<int>(image.columns), encoding->type);
    for (std::uint32_t row = 0; row < image.rows; ++row) {
        std::memcpy(picture.ptr(static_cast<int>(row)),
                    image.data.data() + std::size_t{image.step} * row, row_bytes);
    }
    const bool is_little = std::endian::native == std::endian::little;
    if (picture.elemSize1() > 1 && image.big_endian == is_little)
        swap_bytes({picture.ptr(), picture.total() * picture.elemSize()}, picture.elemSize1());
    if (encoding->to_bgr >= 0) cv::cvtColor(picture, picture, encoding->to_bgr);
    return picture;
}

/// A PNG behind a header of compressed_depth_image_transport: an enumeration, and the two numbers
/// of the formula by which floats became 16 bits, v = a / depth + b.
cv::Mat compressed_depth(const RosImage& image) {
    constexpr std::size_t kHeaderBytes = 12;
    if (image.data.size() <= kHeaderBytes) return {};
    cv::Mat stored = decoded_picture(image.data.subspan(kHeaderBytes), cv::IMREAD_UNCHANGED);
    if (stored.empty() || stored.type() != CV_16UC1) return {};
    if (!holds(image.encoding, "32FC1")) return stored;
    std::array<float, 2> quantised{};
    std::memcpy(quantised.data(), image.data.data() + 4, sizeof quantised);
    cv::Mat depth(stored.size(), CV_32FC1);
    for (int row = 0; row < stored.rows; ++row) {
        const auto* const from = stored.ptr<std::uint16_t>(row);
        auto* const to = depth.ptr<float>(row);
        std::transform(from, from + stored.cols, to, [quantised](std::uint16_t level) {
            return level == 0 ? std::numeric_limits<float>::quiet_NaN()
                              : quantised[0] / (static_cast<float>(level) - quantised[1]);
        });
    }
    return depth;
}

}  // namespace

std::optional<std::int64_t> ros_stamp_ns(Bytes message) {
    CdrReader reader(message);
    const std::int64_t stamp_ns = header_of(reader);
    return reader.whole() ? std::optional(stamp_ns) : std::nullopt;
}

std::optional<RosImage> ros_image(Bytes message, bool compressed) {
    CdrReader reader(message);
    (void)header_of(reader);
    (void)reader.text();  // the frame's name
    RosImage image;
    image.compressed = compressed;
    if (!compressed) {
        image.rows = reader.number<std::uint32_t>();
        image.columns = reader.number<std::uint32_t>();
    }
    image.encoding = reader.text();
    if (!compressed) {
        image.big_endian = reader.number<std::uint8_t>() != 0;
        image.step = reader.number<std::uint32_t>();
    }
    image.data = reader.sequence();
    return reader.whole() ? std::optional(image) : std::nullopt;
}

RosPicture kind_of(const RosImage& image) {
    if (image.compressed) {
        if (!is_compressed_depth(image)) return RosPicture::colour;
        return holds(image.encoding, "rvl") ? RosPicture::unknown : RosPicture::depth;
    }
    const Encoding* const encoding = encoding_of(image.encoding);
    return encoding == nullptr ? RosPicture::unknown : encoding->kind;
}

cv::Mat picture_of(const RosImage& image) {
    if (is_compressed_depth(image)) return compressed_depth(image);
    return image.compressed ? decoded_picture(image.data, cv::IMREAD_COLOR) : plain_picture(image);
}

std::optional<RosCamera> ros_camera(Bytes message) {
    CdrReader reader(message);
    (void)header_of(reader);
    RosCamera found;
    found.frame = reader.text();
    const auto rows = reader.number<std::uint32_t>();
    const auto columns = reader.number<std::uint32_t>();
    if (rows > kLongestSide || columns > kLongestSide) return std::nullopt;
    found.size = {static_cast<int>(columns), static_cast<int>(rows)};
    const std::string model = reader.text();
    std::array<double, 8> distortions{};  // k1, k2, p1, p2, k3 to k6, as OpenCV has them
    const auto coefficients = reader.number<std::uint32_t>();
    for (std::uint32_t k = 0; k < coefficients && reader.whole(); ++k) {
        const auto bend = reader.number<double>();
        if (k < distortions.size()) distortions[k] = bend;
    }
    std::array<double, 9> matrix{};  // row by row
    for (double& value : matrix) value = reader.number<double>();
    const Intrinsics intrinsics{matrix[0], matrix[4], matrix[2], matrix[5]};
    if (!reader.whole() || !is_camera(intrinsics)) return std::nullopt;
    const bool is_known = model == "plumb_bob" || model == "rational_polynomial";
    const bool is_sane = std::all_of(distortions.begin(), distortions.end(),
                                     [](double bend) { return std::fabs(bend) < 1e6; });
    Lens lens;
    if (is_known && is_sane)
        lens = {{distortions[0], distortions[1], distortions[4], distortions[5], distortions[6],
                 distortions[7]},
                distortions[2],
                distortions[3]};
    found.camera = CameraModel(intrinsics, lens);
    return found;
}

std::optional<Placement> ros_placement(Bytes message) {
    CdrReader reader(message);
    cv::Matx33d columns;  // column by column
    for (double& value : columns.val) value = reader.number<double>();
    Placement placement{columns.t(), {}};
    for (double& metres : placement.shift_mm.val) metres = 1000.0 * reader.number<double>();
    return reader.whole() && is_placement(placement) ? std::optional(placement) : std::nullopt;
}

}  // namespace dibhr
