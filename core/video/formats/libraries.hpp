// Brings OpenCV and FFmpeg into the state this room needs: silent, and on our own threads only.
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace dibhr {

/// Once per process, before the first file is opened. With OPENCV_LOG_LEVEL set, which asks for
/// words, they stay as they are.
void set_up_libraries();

/// While it lives, the standard error stream goes nowhere: the picture decoders under OpenCV
/// (libpng, libjpeg) write to it themselves, and what is wrong is said by our own line. For the
/// whole process, so only around one decoding; not with OPENCV_LOG_LEVEL set, which asks for words.
class QuietErrors {
  public:
    QuietErrors();
    ~QuietErrors();
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;

  private:
    std::unique_lock<std::mutex> alone_;
    int kept_{-1};  ///< the stream's own descriptor
};

/// Versions by name: "libavcodec", "libavformat", "libswscale" ("59.37.100"), "libheif", "libzip",
/// "opencv" ("4.6.0"), "openexr".
/// Of the libraries that are loaded, not of those that the program was compiled against.
[[nodiscard]] std::map<std::string, std::string> library_versions();

}  // namespace dibhr
