// The wandering hill.
#include "app/commands/generated_media.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dibhr {

GeneratedMedia::GeneratedMedia(int columns, int rows, int frames, double frames_per_s) {
    description_.colour_path = description_.depth_path = "generated";
    description_.colour_columns = description_.depth_columns = columns;
    description_.colour_rows = description_.depth_rows = rows;
    description_.frames = frames;
    description_.frames_per_s = frames_per_s;
    description_.duration_s = frames / frames_per_s;
}

std::optional<RawFrame> GeneratedMedia::next() {
    if (next_ >= description_.frames) return std::nullopt;
    RawFrame frame;
    frame.index = next_++;
    frame.media_s = static_cast<double>(frame.index) / description_.frames_per_s;
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(frame.index) /
                         static_cast<double>(description_.frames);
    DepthImage& depth = frame.depth;
    depth.columns = description_.depth_columns;
    depth.rows = description_.depth_rows;
    depth.levels.resize(static_cast<std::size_t>(depth.columns) *
                        static_cast<std::size_t>(depth.rows));
    const double centre_x = depth.columns * (0.5 + 0.1 * std::cos(phase));
    const double centre_y = depth.rows * (0.5 + 0.1 * std::sin(phase));
    for (int j = 0; j < depth.rows; ++j) {
        for (int i = 0; i < depth.columns; ++i) {
            const double x = (i - centre_x) / (0.3 * depth.columns);
            const double y = (j - centre_y) / (0.3 * depth.columns);
            // Whole levels, as an 8-bit video has them.
            depth.at(i, j) =
                static_cast<float>(std::round(60.0 + 120.0 / (1.0 + 2.0 * (x * x + y * y))));
        }
    }
    frame.colour.columns = depth.columns;
    frame.colour.rows = depth.rows;
    frame.colour.rgb.assign(3 * depth.levels.size(), 128);
    return frame;
}

void GeneratedMedia::seek(double media_s) {
    const auto frame = static_cast<std::int64_t>(media_s * description_.frames_per_s + 1e-6);
    next_ = std::clamp<std::int64_t>(frame, 0, description_.frames - 1);
}

}  // namespace dibhr
