// Sets up OpenCV and FFmpeg: no messages of their own, no threads of OpenCV.
#include "core/video/formats/libraries.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
#include <libavutil/mem.h>
#include <libswscale/swscale.h>
}

#include <fcntl.h>
#include <libheif/heif.h>
#include <openexr.h>
#include <stdlib.h>
#include <unistd.h>
#include <zip.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

/// stderr is one for the process: two threads that discard it at once could leave it discarded.
std::mutex& stderr_mutex() {
    static std::mutex mutex;
    return mutex;
}

std::string text_of(unsigned version) {
    return std::to_string(AV_VERSION_MAJOR(version)) + "." +
           std::to_string(AV_VERSION_MINOR(version)) + "." +
           std::to_string(AV_VERSION_MICRO(version));
}

}  // namespace

void set_up_libraries() {
    static std::once_flag once;
    std::call_once(once, [] {
        if (std::getenv("OPENCV_LOG_LEVEL") == nullptr) {
            cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
            av_log_set_level(AV_LOG_QUIET);
        }
        // Headers of files are unpacked into memory, too.
        av_max_alloc(static_cast<std::size_t>(kMostPictureBytes) + (std::size_t{1} << 20U));
        // A thread pool would wake on every conversion and take the haptic thread's core.
        cv::setNumThreads(1);
    });
}

QuietErrors::QuietErrors() : lock_(stderr_mutex()) {
    if (std::getenv("OPENCV_LOG_LEVEL") != nullptr) return;
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    std::fflush(stderr);
    kept_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    if (kept_ >= 0) ::dup2(nowhere, STDERR_FILENO);
    ::close(nowhere);
}

QuietErrors::~QuietErrors() {
    if (kept_ < 0) return;
    std::fflush(stderr);
    ::dup2(kept_, STDERR_FILENO);
    ::close(kept_);
}

std::map<std::string, std::string> library_versions() {
    int major = 0;
    int minor = 0;
    int patch = 0;
    exr_get_library_version(&major, &minor, &patch, nullptr);
    return {{"libavcodec", text_of(avcodec_version())},
            {"libavformat", text_of(avformat_version())},
            {"libswscale", text_of(swscale_version())},
            {"libheif", heif_get_version()},
            {"libzip", zip_libzip_version()},
            {"opencv", cv::getVersionString()},
            {"openexr",
             std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch)}};
}

}  // namespace dibhr
