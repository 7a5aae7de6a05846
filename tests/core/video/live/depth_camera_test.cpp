// A depth camera as the kernel shows it, answered for by a fake below the calls.
#include "core/video/live/depth_camera.hpp"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <vector>

#include "core/video/live/live_name.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr unsigned kColumns = 20, kRows = 6, kRowBytes = 64;  // rows are longer than their pixels

/// Sends picture k, all of whose levels are 100 k, whenever a buffer is free and it is told to.
class FakeCamera final : public CameraCalls {
  public:
    bool has_depth{true};
    bool unplugged{false};
    bool open_now{false}, streams{false};
    int sent{0};

    void send(bool damaged = false) {
        if (queued.empty()) return;
        const unsigned index = queued.front();
        queued.pop_front();
        ++sent;
        auto* const levels = reinterpret_cast<std::uint16_t*>(memory[index].data());
        std::fill_n(levels, memory[index].size() / 2, std::uint16_t{7});
        for (unsigned j = 0; j < kRows; ++j)
            std::fill_n(levels + j * kRowBytes / 2, kColumns,
                        static_cast<std::uint16_t>(100 * sent));
        v4l2_buffer done{};
        done.index = index;
        done.bytesused = kRowBytes * kRows;
        done.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | (damaged ? V4L2_BUF_FLAG_ERROR : 0U);
        done.timestamp = {1000 + sent / 30, 1000000L * (sent % 30) / 30};
        ready.push_back(done);
    }

    int open(const char* /*device*/) override {
        open_now = true;
        return 5;
    }
    void close(int /*descriptor*/) override { open_now = false; }
    void* map(int /*descriptor*/, std::size_t /*bytes*/, long offset) override {
        return memory[static_cast<std::size_t>(offset)].data();
    }
    void unmap(void* /*bytes*/, std::size_t /*count*/) override {}
    bool wait(int /*descriptor*/, int /*for_ms*/) override { return !ready.empty(); }
    int ioctl(int /*descriptor*/, unsigned long request, void* argument) override {
        switch (request) {
            case VIDIOC_ENUM_FMT: {
                auto& form = *static_cast<v4l2_fmtdesc*>(argument);
                if (form.index > (has_depth ? 1U : 0U)) return failed(EINVAL);
                form.pixelformat = form.index == 0 ? V4L2_PIX_FMT_YUYV : V4L2_PIX_FMT_Z16;
                return 0;
            }
            case VIDIOC_G_FMT:
            case VIDIOC_S_FMT: {
                auto& picture = static_cast<v4l2_format*>(argument)->fmt.pix;
                picture.width = kColumns;
                picture.height = kRows;
                picture.bytesperline = kRowBytes;
                return 0;
            }
            case VIDIOC_G_PARM:
                static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = {1, 30};
                return 0;
            case VIDIOC_REQBUFS:
                memory.assign(static_cast<v4l2_requestbuffers*>(argument)->count,
                              std::vector<std::uint8_t>(kRowBytes * kRows));
                return 0;
            case VIDIOC_QUERYBUF: {
                auto& buffer = *static_cast<v4l2_buffer*>(argument);
                buffer.length = kRowBytes * kRows;
                buffer.m.offset = buffer.index;
                return 0;
            }
            case VIDIOC_QBUF:
                if (unplugged) return failed(ENODEV);
                queued.push_back(static_cast<v4l2_buffer*>(argument)->index);
                return 0;
            case VIDIOC_DQBUF:
                if (unplugged) return failed(ENODEV);
                if (ready.empty()) return failed(EAGAIN);
                *static_cast<v4l2_buffer*>(argument) = ready.front();
                ready.pop_front();
                return 0;
            case VIDIOC_STREAMON:
                streams = true;
                return 0;
            case VIDIOC_STREAMOFF:
                streams = false;
                return 0;
            default:
                return failed(EINVAL);
        }
    }

  private:
    static int failed(int why) {
        errno = why;
        return -1;
    }
    std::vector<std::vector<std::uint8_t>> memory{};
    std::deque<unsigned> queued{};
    std::deque<v4l2_buffer> ready{};
};

const LiveName& depth_device() {
    static const LiveName name = live_name("v4l2:/dev/video2");
    return name;
}

bool never() {
    return false;
}

}  // namespace

TEST_CASE("a camera's 16-bit depth comes pixel by pixel, with the kernel's time", "[live]") {
    FakeCamera fake;
    const auto camera = DepthCamera::opened(depth_device(), fake);
    REQUIRE(camera);
    CHECK(fake.streams);
    CHECK_THAT(camera->frames_per_s(), WithinAbs(30.0, 1e-9));
    for (int k = 1; k <= 40; ++k) {  // more than there are buffers
        fake.send();
        DepthCamera::Picture picture;
        REQUIRE(camera->read(picture, never));
        REQUIRE(picture.levels.size() == cv::Size(kColumns, kRows));
        double lowest = 0.0;
        double highest = 0.0;
        cv::minMaxLoc(picture.levels, &lowest, &highest);
        CHECK(lowest == 100.0 * k);
        CHECK(highest == 100.0 * k);
        CHECK_THAT(picture.stamp_s, WithinAbs(1000.0 + k / 30.0, 1e-5));
    }
}

TEST_CASE("of pictures that wait in the camera the newest is taken, and none that is damaged",
          "[live]") {
    FakeCamera fake;
    const auto camera = DepthCamera::opened(depth_device(), fake);
    REQUIRE(camera);
    fake.send();
    fake.send();
    fake.send(true);
    DepthCamera::Picture picture;
    REQUIRE(camera->read(picture, never));
    CHECK(picture.levels.at<std::uint16_t>(3, 7) == 200);
}

TEST_CASE("a camera that is pulled out, or nobody wants any more, is let go", "[live]") {
    FakeCamera fake;
    auto camera = DepthCamera::opened(depth_device(), fake);
    REQUIRE(camera);
    DepthCamera::Picture picture;
    CHECK_FALSE(camera->read(picture, [] { return true; }));
    fake.unplugged = true;
    CHECK_FALSE(camera->read(picture, never));
    camera.reset();
    CHECK_FALSE(fake.open_now);
    CHECK_FALSE(fake.streams);
}

TEST_CASE("a camera of colour alone is left to libav", "[live]") {
    FakeCamera fake;
    fake.has_depth = false;
    CHECK(DepthCamera::opened(depth_device(), fake) == nullptr);
    CHECK_FALSE(fake.open_now);
}

TEST_CASE("a picture stays as it is when the camera writes into its buffer again", "[live]") {
    FakeCamera fake;
    const auto camera = DepthCamera::opened(depth_device(), fake);
    REQUIRE(camera);
    fake.send();
    DepthCamera::Picture picture;
    REQUIRE(camera->read(picture, never));
    for (int k = 0; k < 40; ++k) fake.send();  // into each of the buffers
    CHECK(cv::countNonZero(picture.levels != 100) == 0);
}
