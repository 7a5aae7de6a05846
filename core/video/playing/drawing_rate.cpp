// Weighs pictures of the window against the frames that are felt.
#include "core/video/playing/drawing_rate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr int kLastingFrames = 12;   ///< frames until costs tell whether there is time
constexpr int kLastingFarAway = 4;   ///< where they are far from it
constexpr double kFarLate = 2.0;     ///< times as long as there is time
constexpr double kRelevant = 0.2;    ///< share of the processors; less is not worth a change
constexpr double kGranted = 0.2;     ///< of one processor, to pictures while frames are late
constexpr double kRoomToDraw = 1.3;  ///< of a frame's time before pictures come back

}  // namespace

void DrawingRate::update(const DrawingCost& drawing, const FrameCosts& costs, double interval_s,
                         double speed) noexcept {
    const double frame_s = frame_time_s(costs, 1.0);
    if (!(interval_s > 0.0) || !(frame_s > 0.0) || !(drawing.picture_s > 0.0)) return;
    const double free_s = interval_s / speed;
    const int lasting = frame_s > kFarLate * free_s ? kLastingFarAway : kLastingFrames;
    ++frames_;
    if (before_s_ > 0.0) {
        if (frames_ < lasting) return;
        times_as_long_ = std::max(std::exchange(before_s_, 0.0) / frame_s, 1.0);
        frames_ = 0;
    }
    const bool draws_less = most_per_s_ > 0.0;
    const bool changes = draws_less ? times_as_long_ * frame_s * kRoomToDraw <= free_s
                                    : frame_s > free_s && drawing.share >= kRelevant;
    if (!changes) frames_ = 0;
    if (frames_ < lasting) return;
    frames_ = 0;
    before_s_ = draws_less ? 0.0 : frame_s;
    most_per_s_ = draws_less ? 0.0
                             : std::clamp(std::round(kGranted / drawing.picture_s), kFewest_per_s,
                                          kMostOfFew_per_s);
}

std::string DrawingRate::in_words() const {
    if (!(most_per_s_ > 0.0)) return {};
    return "The window draws " + number_text(most_per_s_, 0) + " coarse pictures a second.";
}

}  // namespace dibhr
