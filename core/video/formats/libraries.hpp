// Sets up OpenCV and FFmpeg: no messages of their own, no threads of OpenCV.
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace dibhr {

/// To be called before the first file is opened; works once. With OPENCV_LOG_LEVEL set, which
/// requests messages, logging stays as it is.
void set_up_libraries();

/// Discards the standard error stream while it lives: picture decoders under OpenCV (libpng,
/// libjpeg) write to it, and our own message reports the error. It acts on the whole process, so
/// use it around one decoding only. No effect with OPENCV_LOG_LEVEL set, which requests messages.
class QuietErrors {
  public:
    QuietErrors();
    ~QuietErrors();
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;

  private:
    std::unique_lock<std::mutex> lock_;
    int kept_{-1};  ///< the stream's own descriptor
};

/// Versions by name: "libavcodec", "libavformat", "libswscale" ("59.37.100"), "libheif", "libzip",
/// "opencv" ("4.6.0"), "openexr".
/// These are the loaded libraries, not those that the program was compiled with.
[[nodiscard]] std::map<std::string, std::string> library_versions();

}  // namespace dibhr
