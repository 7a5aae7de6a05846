// Pictures as plain data, and words for a file's tags.
#include "core/video/live/live_record.hpp"

#include <cstring>
#include <locale>
#include <sstream>

#include "core/files/plain_text.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/live/taken_pictures.hpp"

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

std::string text_of(const DepthNoise& noise) {
    const auto text = [](float value) { return number_text(static_cast<double>(value)); };
    return text(noise.constant) + " " + text(noise.linear) + " " + text(noise.square) + " " +
           text(noise.blotched) + " " + (noise.of_scale ? "1" : "0");
}

std::optional<DepthNoise> noise_in(const std::string& text) {
    std::istringstream words(text);
    words.imbue(std::locale::classic());
    DepthNoise noise;
    words >> noise.constant >> noise.linear >> noise.square >> noise.blotched >> noise.of_scale;
    return words ? std::optional(noise) : std::nullopt;
}

}  // namespace dibhr
