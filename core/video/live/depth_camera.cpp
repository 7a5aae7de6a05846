// Reads through the kernel's streaming interface (docs.kernel.org: V4L API, Streaming I/O).
#include "core/video/live/depth_camera.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr unsigned kBuffers = 4;
constexpr int kCameraPoll_ms = 50;  ///< how soon a read notices that it must stop
constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;

v4l2_buffer buffer_of(unsigned index) {
    v4l2_buffer buffer{};
    buffer.type = kCapture;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    return buffer;
}

std::string option(const LiveName& name, const char* key) {
    const auto found = name.options.find(key);
    return found == name.options.end() ? std::string{} : found->second;
}

double stamp_of(const v4l2_buffer& buffer) {
    if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC)
        return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(buffer.timestamp.tv_sec) +
           1e-6 * static_cast<double>(buffer.timestamp.tv_usec);
}

}  // namespace

int CameraCalls::open(const char* device) {
    return ::open(device, O_RDWR | O_NONBLOCK | O_CLOEXEC);
}
int CameraCalls::ioctl(int descriptor, unsigned long request, void* argument) {
    return ::ioctl(descriptor, request, argument);
}
void* CameraCalls::map(int descriptor, std::size_t bytes, long offset) {
    return ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, offset);
}
void CameraCalls::unmap(void* bytes, std::size_t count) {
    ::munmap(bytes, count);
}
bool CameraCalls::wait(int descriptor, int for_ms) {
    pollfd wanted{.fd = descriptor, .events = POLLIN, .revents = 0};
    return ::poll(&wanted, 1, for_ms) > 0;
}
void CameraCalls::close(int descriptor) {
    ::close(descriptor);
}

std::unique_ptr<DepthCamera> DepthCamera::opened(const LiveName& name, CameraCalls& calls) {
    const int descriptor = calls.open(name.url.c_str());
    if (descriptor < 0) return nullptr;
    std::unique_ptr<DepthCamera> camera(new DepthCamera(calls, descriptor));
    if (!camera->has_depth() || !camera->choose_form(name)) return nullptr;
    camera->choose_rate(name);
    return camera->start() ? std::move(camera) : nullptr;
}

DepthCamera::~DepthCamera() {
    int type = kCapture;
    if (!buffers_.empty()) static_cast<void>(call_ioctl(VIDIOC_STREAMOFF, &type));
    for (const Buffer& buffer : buffers_) calls_.unmap(buffer.bytes, buffer.count);
    calls_.close(descriptor_);
}

bool DepthCamera::call_ioctl(unsigned long request, void* argument) {
    int result = 0;
    do {
        result = calls_.ioctl(descriptor_, request, argument);
    } while (result < 0 && errno == EINTR);
    return result >= 0;
}

bool DepthCamera::has_depth() {
    v4l2_fmtdesc form{};
    form.type = kCapture;
    for (; call_ioctl(VIDIOC_ENUM_FMT, &form); ++form.index)
        if (form.pixelformat == V4L2_PIX_FMT_Z16) return true;
    return false;
}

bool DepthCamera::choose_form(const LiveName& name) {
    v4l2_format format{};
    format.type = kCapture;
    if (!call_ioctl(VIDIOC_G_FMT, &format)) return false;
    v4l2_pix_format& picture = format.fmt.pix;
    const std::string size = option(name, "video_size");
    if (!size.empty() && std::sscanf(size.c_str(), "%ux%u", &picture.width, &picture.height) != 2)
        return false;
    picture.pixelformat = V4L2_PIX_FMT_Z16;
    picture.field = V4L2_FIELD_NONE;
    picture.bytesperline = picture.sizeimage = 0;
    if (!call_ioctl(VIDIOC_S_FMT, &format) || picture.pixelformat != V4L2_PIX_FMT_Z16) return false;
    size_ = {static_cast<int>(picture.width), static_cast<int>(picture.height)};
    row_bytes_ = std::max<std::size_t>(picture.bytesperline, 2 * std::size_t{picture.width});
    return size_.width >= 2 && size_.height >= 2;
}

void DepthCamera::choose_rate(const LiveName& name) {
    v4l2_streamparm rate{};
    rate.type = kCapture;
    if (!call_ioctl(VIDIOC_G_PARM, &rate)) return;
    v4l2_fract& interval = rate.parm.capture.timeperframe;
    if (const std::string wanted = option(name, "framerate"); !wanted.empty()) {
        interval = {1000,
                    static_cast<std::uint32_t>(1000.0 * number_of_text(wanted).value_or(0.0))};
        static_cast<void>(call_ioctl(VIDIOC_S_PARM, &rate));
    }
    if (interval.numerator > 0)
        frames_per_s_ = static_cast<double>(interval.denominator) / interval.numerator;
}

bool DepthCamera::start() {
    v4l2_requestbuffers request{};
    request.count = kBuffers;
    request.type = kCapture;
    request.memory = V4L2_MEMORY_MMAP;
    if (!call_ioctl(VIDIOC_REQBUFS, &request)) return false;
    for (unsigned k = 0; k < request.count; ++k) {
        v4l2_buffer buffer = buffer_of(k);
        if (!call_ioctl(VIDIOC_QUERYBUF, &buffer)) return false;
        void* const bytes = calls_.map(descriptor_, buffer.length, buffer.m.offset);
        if (bytes == MAP_FAILED) return false;
        buffers_.push_back({bytes, buffer.length});
        if (!queue_buffer(k)) return false;
    }
    int type = kCapture;
    return !buffers_.empty() && call_ioctl(VIDIOC_STREAMON, &type);
}

bool DepthCamera::queue_buffer(unsigned index) {
    v4l2_buffer buffer = buffer_of(index);
    return call_ioctl(VIDIOC_QBUF, &buffer);
}

bool DepthCamera::take(Picture& picture) {
    v4l2_buffer buffer = buffer_of(0);
    if (!call_ioctl(VIDIOC_DQBUF, &buffer)) {
        lost_ = errno != EAGAIN;
        return false;
    }
    if (buffer.index >= buffers_.size()) return false;
    const Buffer& held = buffers_[buffer.index];
    const std::size_t rows = static_cast<std::size_t>(size_.height);
    const bool whole = (buffer.flags & V4L2_BUF_FLAG_ERROR) == 0 &&
                       row_bytes_ * (rows - 1) + 2 * static_cast<std::size_t>(size_.width) <=
                           std::min<std::size_t>(held.count, buffer.bytesused);
    if (whole) {
        picture.levels = cv::Mat(size_, CV_16UC1, held.bytes, row_bytes_).clone();
        picture.stamp_s = stamp_of(buffer);
    }
    lost_ = !queue_buffer(buffer.index);
    return true;
}

bool DepthCamera::read(Picture& picture, const std::function<bool()>& must_stop) {
    picture.levels = cv::Mat();
    while (!must_stop() && !lost_) {
        while (take(picture)) continue;  // the newest of those that wait
        if (!picture.levels.empty()) return true;
        static_cast<void>(calls_.wait(descriptor_, kCameraPoll_ms));
    }
    return false;
}

}  // namespace dibhr
