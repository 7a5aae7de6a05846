// The module of OpenCV's picture codecs.
#include <opencv2/imgcodecs.hpp>

#include "core/video/modules/picture_codecs.hpp"

extern "C" {
extern const dibhr::PictureCodecs dibhr_picture_codecs;
const dibhr::PictureCodecs dibhr_picture_codecs{
    .can_read = [](const std::string& file) { return cv::haveImageReader(file); },
    .read = [](const std::string& file, int flags) { return cv::imread(file, flags); },
    .decode = [](const cv::Mat& bytes, int flags) { return cv::imdecode(bytes, flags); },
    .encode =
        [](const std::string& extension, const cv::Mat& picture,
           std::vector<unsigned char>& bytes) { return cv::imencode(extension, picture, bytes); },
    .write = [](const std::string& file, const cv::Mat& picture,
                const std::vector<int>& options) { return cv::imwrite(file, picture, options); }};
}
