// A depth camera through Linux's V4L2, in its 16-bit format Z16, which libav does not support;
// inside the room.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/video/live/live_name.hpp"

namespace dibhr {

/// The system calls to the kernel; a test replaces them.
class CameraCalls {
  public:
    virtual ~CameraCalls() = default;
    // The system calls of these names, for one device.
    virtual int open(const char* device);
    virtual int ioctl(int descriptor, unsigned long request, void* argument);
    virtual void* map(int descriptor, std::size_t bytes, long offset);
    virtual void unmap(void* bytes, std::size_t count);
    /// Whether a picture is ready, or becomes ready in so many milliseconds.
    virtual bool wait(int descriptor, int for_ms);
    virtual void close(int descriptor);
};

class DepthCamera {
  public:
    /// Null: no such format, as of a colour camera, or the device cannot be opened now.
    [[nodiscard]] static std::unique_ptr<DepthCamera> opened(const LiveName& name,
                                                             CameraCalls& calls);
    ~DepthCamera();
    DepthCamera(const DepthCamera&) = delete;
    DepthCamera& operator=(const DepthCamera&) = delete;

    struct Picture {
        cv::Mat levels{};     ///< CV_16UC1
        double stamp_s{0.0};  ///< by the kernel's monotonic clock; NaN: by another clock
    };
    /// Waits for the newest picture. False: the function returned true, or the camera is lost.
    [[nodiscard]] bool read(Picture& picture, const std::function<bool()>& must_stop);
    [[nodiscard]] double frames_per_s() const noexcept { return frames_per_s_; }

  private:
    struct Buffer {
        void* bytes{nullptr};
        std::size_t count{0};
    };

    DepthCamera(CameraCalls& calls, int descriptor) : calls_(calls), descriptor_(descriptor) {}
    [[nodiscard]] bool call_ioctl(unsigned long request, void* argument);
    [[nodiscard]] bool has_depth();
    [[nodiscard]] bool choose_form(const LiveName& name);
    void choose_rate(const LiveName& name);
    [[nodiscard]] bool start();
    [[nodiscard]] bool queue_buffer(unsigned index);
    /// False: no picture is ready.
    [[nodiscard]] bool take(Picture& picture);

    CameraCalls& calls_;
    int descriptor_;
    cv::Size size_{};
    std::size_t row_bytes_{0};
    double frames_per_s_{0.0};
    std::vector<Buffer> buffers_{};
    bool lost_{false};
};

}  // namespace dibhr
