// A depth camera of Linux's own (V4L2): its 16-bit form Z16, which libav does not know; inside the
// room.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/video/live/live_name.hpp"

namespace dibhr {

/// What is asked of the kernel; a test answers in its place.
class CameraCalls {
  public:
    virtual ~CameraCalls() = default;
    // As the system's calls of these names, for one device.
    virtual int open(const char* device);
    virtual int ioctl(int descriptor, unsigned long request, void* argument);
    virtual void* map(int descriptor, std::size_t bytes, long offset);
    virtual void unmap(void* bytes, std::size_t count);
    /// Whether a picture is there, or comes in so many milliseconds.
    virtual bool wait(int descriptor, int for_ms);
    virtual void close(int descriptor);
};

class DepthCamera {
  public:
    /// Null: there is no such form, as of a colour camera, or it is not to be had now.
    [[nodiscard]] static std::unique_ptr<DepthCamera> opened(const LiveName& name,
                                                             CameraCalls& calls);
    ~DepthCamera();
    DepthCamera(const DepthCamera&) = delete;
    DepthCamera& operator=(const DepthCamera&) = delete;

    struct Picture {
        cv::Mat levels{};     ///< CV_16UC1
        double stamp_s{0.0};  ///< by the kernel's monotonic clock; NaN: by another one
    };
    /// Waits for the newest picture. False: it is `over`, or the camera is gone.
    [[nodiscard]] bool read(Picture& picture, const std::function<bool()>& over);
    [[nodiscard]] double frames_per_s() const noexcept { return frames_per_s_; }

  private:
    struct Buffer {
        void* bytes{nullptr};
        std::size_t count{0};
    };

    DepthCamera(CameraCalls& calls, int descriptor) : calls_(calls), descriptor_(descriptor) {}
    [[nodiscard]] bool ask(unsigned long request, void* argument);
    [[nodiscard]] bool has_depth();
    [[nodiscard]] bool choose_form(const LiveName& name);
    void choose_rate(const LiveName& name);
    [[nodiscard]] bool start();
    [[nodiscard]] bool give_back(unsigned index);
    /// False: none is there.
    [[nodiscard]] bool take(Picture& picture);

    CameraCalls& calls_;
    int descriptor_;
    cv::Size size_{};
    std::size_t row_bytes_{0};
    double frames_per_s_{0.0};
    std::vector<Buffer> buffers_{};
    bool gone_{false};
};

}  // namespace dibhr
