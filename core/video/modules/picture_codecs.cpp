// Loads the picture codecs from their module.
#include "core/video/modules/picture_codecs.hpp"

#include "core/files/module.hpp"

namespace dibhr {

const PictureCodecs& picture_codecs() {
    static const auto* const codecs = static_cast<const PictureCodecs*>(
        symbol_in_module("dibhr_picture_codecs", "dibhr_picture_codecs"));
    return *codecs;
}

std::string encoded_png(const cv::Mat& picture) {
    std::vector<unsigned char> png;
    picture_codecs().encode(".png", picture, png, {});
    return {png.begin(), png.end()};
}

}  // namespace dibhr
