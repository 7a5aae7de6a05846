// The messages of ROS 2 that hold pictures, as they are stored: in OMG's CDR, version 1; inside the
// room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>

#include "core/video/depth/camera.hpp"

namespace dibhr {

using Bytes = std::span<const std::uint8_t>;

/// How much of a message its stamp takes.
inline constexpr std::size_t kStampBytes = 12;

/// When the message's header says that it was taken, by the clock of its sender [ns]; nothing when
/// it has no such header.
[[nodiscard]] std::optional<std::int64_t> ros_stamp_ns(Bytes message);

/// Of a sensor_msgs/msg/Image, or of a CompressedImage, which does not tell its size.
struct RosImage {
    std::uint32_t columns{0}, rows{0}, step{0};  ///< step: bytes from row to row
    std::string encoding{};                      ///< of a compressed one its format
    bool big_endian{false};
    bool compressed{false};
    Bytes data{};  ///< of the message
};

/// Nothing when the message is broken.
[[nodiscard]] std::optional<RosImage> ros_image(Bytes message, bool compressed);

/// What a picture of that encoding can be taken for.
enum class RosPicture { depth, grey, colour, unknown };
[[nodiscard]] RosPicture kind_of(const RosImage& image);

/// The picture in OpenCV's order of channels: depth as 16 bits or floats, else 8-bit BGR. Empty
/// when it is broken or of an unknown encoding.
[[nodiscard]] cv::Mat picture_of(const RosImage& image);

/// Of a sensor_msgs/msg/CameraInfo.
struct RosCamera {
    Camera camera{};
    cv::Size size{};      ///< of the pictures that it is for
    std::string frame{};  ///< the name of its axes
};
/// Nothing when the message is broken, or has no camera.
[[nodiscard]] std::optional<RosCamera> ros_camera(Bytes message);

/// Of a realsense2_camera_msgs/msg/Extrinsics; nothing when it is broken, or none.
[[nodiscard]] std::optional<Placement> ros_placement(Bytes message);

}  // namespace dibhr
