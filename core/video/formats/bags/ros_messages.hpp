// Parses ROS 2 messages with pictures, stored in OMG's CDR, version 1; inside the room.
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

/// The first bytes of a message up to the end of its stamp.
inline constexpr std::size_t kStampBytes = 12;

/// The stamp in the message's header, by the clock of its sender [ns]; nothing when the message is
/// too short.
[[nodiscard]] std::optional<std::int64_t> ros_stamp_ns(Bytes message);

/// A sensor_msgs/msg/Image, or a CompressedImage, which does not state its size.
struct RosImage {
    std::uint32_t columns{0}, rows{0}, step{0};  ///< step: bytes from row to row
    std::string encoding{};                      ///< of a compressed image its format
    bool big_endian{false};
    bool compressed{false};
    Bytes data{};  ///< of the message
};

/// Nothing when the message is broken.
[[nodiscard]] std::optional<RosImage> ros_image(Bytes message, bool compressed);

/// What a picture of that encoding can be used as.
enum class RosPicture { depth, grey, colour, unknown };
[[nodiscard]] RosPicture kind_of(const RosImage& image);

/// The picture in OpenCV's order of channels: depth as 16 bits or floats, else 8-bit BGR. Empty
/// when it is broken or of an unknown encoding.
[[nodiscard]] cv::Mat picture_of(const RosImage& image);

/// A sensor_msgs/msg/CameraInfo.
struct RosCamera {
    CameraModel camera{};
    cv::Size size{};      ///< of its pictures
    std::string frame{};  ///< the name of its axes
};
/// Nothing when the message is broken, or has no camera.
[[nodiscard]] std::optional<RosCamera> ros_camera(Bytes message);

/// Parses a realsense2_camera_msgs/msg/Extrinsics; nothing when the message is broken.
[[nodiscard]] std::optional<Placement> ros_placement(Bytes message);

}  // namespace dibhr
