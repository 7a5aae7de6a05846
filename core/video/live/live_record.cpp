// Pictures as plain data.
#include "core/video/live/live_record.hpp"

#include <cstring>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/live/live_join.hpp"

namespace dibhr {

LiveLevels levels_of(const LiveRecord& record) {
    const cv::Mat& mat = record.pictures->levels;
    LiveLevels taken{.columns = mat.cols, .rows = mat.rows, .bits = record.pictures->bits};
    if (mat.channels() != 1 || (mat.depth() != CV_8U && mat.depth() != CV_16U)) return taken;
    taken.bytes = static_cast<int>(mat.elemSize());
    const std::size_t row = static_cast<std::size_t>(mat.cols) * mat.elemSize();
    taken.levels.resize(row * static_cast<std::size_t>(mat.rows));
    for (int j = 0; j < mat.rows; ++j)
        std::memcpy(taken.levels.data() + row * static_cast<std::size_t>(j), mat.ptr(j), row);
    return taken;
}

ColourImage colour_of(const LiveRecord& record) {
    const cv::Mat& colour = record.pictures->colour;
    return colour.empty() ? ColourImage{} : colour_of(colour);
}

}  // namespace dibhr
