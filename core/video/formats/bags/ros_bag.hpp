// Reads the picture topics of ROS 2 bags (.db3, .mcap), in order of the messages' stamps; inside
// the room.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"

namespace dibhr {

/// Whether the place is a SQLite or MCAP file, or a folder of a bag's files.
[[nodiscard]] bool is_ros_bag(const std::filesystem::path& place, std::string_view head);

/// Whether the bag has a topic of that role. Throws InputError as below.
[[nodiscard]] bool ros_bag_holds(const std::filesystem::path& place, PictureRole role);

/// Opens the topic that is most likely of that role, by encoding and name; prefers depth registered
/// to the colour camera. Facts about depth: 16 bits are millimetres and floats metres (REP 118), 0
/// is no data, and the intrinsics of the topic's camera_info. Throws InputError when the file is no
/// bag, is damaged, or has no such topic.
[[nodiscard]] std::unique_ptr<PictureSource> open_ros_topic(const std::filesystem::path& place,
                                                            PictureRole role);

}  // namespace dibhr
