// Models of cameras, codecs and estimators: their frames of a known surface.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "tests/bench/known_scene.hpp"

namespace dibhr::bench {

/// One way to see: frames as a file would give them, of 8 or 16 bits; NaN is no data.
struct Sensor {
    std::string name{};
    std::function<std::vector<DepthImage>(const TrueFrames& truth, std::uint32_t seed)> see{};
};

/// "exact" (nothing is done but to round to 16 bits), "white", "kinect", "stereo", "lidar", "tof",
/// "8-bit", "h264", "mono" and "sparse". The same seed gives the same frames.
[[nodiscard]] std::vector<Sensor> sensors();

/// The noise of four cameras on a surface without silhouettes: "time of flight", "LiDAR",
/// "Kinect v1" and "stereo". Distances are whole millimetres.
[[nodiscard]] std::vector<Sensor> noises();

/// "standing": the LiDAR's noise, and 1 mm that is the same in every frame.
[[nodiscard]] Sensor standing_noise();

/// The sensor of that name, which must exist.
[[nodiscard]] Sensor sensor(const std::string& name);

}  // namespace dibhr::bench
