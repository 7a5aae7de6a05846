// The libraries that turn files into depth levels, as they are in this run of the program.
#include "core/video/library_versions.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <opencv2/core/utility.hpp>

namespace dibhr {

namespace {

std::string text_of(unsigned version) {
    return std::to_string(AV_VERSION_MAJOR(version)) + "." +
           std::to_string(AV_VERSION_MINOR(version)) + "." +
           std::to_string(AV_VERSION_MICRO(version));
}

}  // namespace

std::map<std::string, std::string> library_versions() {
    return {{"libavcodec", text_of(avcodec_version())},
            {"libavformat", text_of(avformat_version())},
            {"libswscale", text_of(swscale_version())},
            {"opencv", cv::getVersionString()}};
}

}  // namespace dibhr
