// Times of pictures on displays, and of drawing in software.
#include "app/touching/picture_time.hpp"

#include "render/gl_objects.hpp"

namespace dibhr {

namespace {

constexpr auto kPictureTime = std::chrono::nanoseconds(1'000'000'000 / 60);
constexpr auto kSoftwarePictureTime = std::chrono::nanoseconds(1'000'000'000 / 30);
/// Software that takes longer for one picture counts as hung.
constexpr auto kLongestDrawing = std::chrono::seconds(1);

}  // namespace

std::chrono::nanoseconds least_picture_time(bool sync, bool software) {
    if (!sync) return std::chrono::nanoseconds(0);
    return software ? kSoftwarePictureTime : kPictureTime;
}

void beat_while_drawing(const std::function<void()>& beat) {
    const auto latest = std::chrono::steady_clock::now() + kLongestDrawing;
    wait_for_drawing([&] {
        beat();
        return std::chrono::steady_clock::now() < latest;
    });
}

}  // namespace dibhr
