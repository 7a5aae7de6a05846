// How often the window draws, for any cost of a frame and of a picture.
#include "core/video/playing/drawing_rate.hpp"

#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr double kVideoFrame_s = 1.0 / 30.0;
constexpr DrawingCost kCostly{.picture_s = 0.02, .share = 0.3};
constexpr DrawingCost kCheap{.picture_s = 0.001, .share = 0.02};

/// A machine on which a frame takes so long while the window draws as it likes, and while it draws
/// less often [s].
struct DrawingMachine {
    double frame_s, relieved_s;
};

/// How often the rate changes within so many frames.
int rate_changes(DrawingRate& rate, const DrawingCost& drawing, const DrawingMachine& machine,
                 int frames, double speed = 1.0) {
    int count = 0;
    for (int k = 0; k < frames; ++k) {
        const double before_per_s = rate.most_per_s();
        const double takes_s = before_per_s > 0.0 ? machine.relieved_s : machine.frame_s;
        rate.update(drawing, {.cleaning_s = takes_s}, kVideoFrame_s, speed);
        count += rate.most_per_s() == before_per_s ? 0 : 1;
    }
    return count;
}

}  // namespace

TEST_CASE("the window draws less often while frames are late, ten times a second or more",
          "[drawing]") {
    const double picture_s = GENERATE(0.005, 0.012, 0.02, 0.5);
    DrawingRate rate;
    CHECK(rate_changes(rate, {picture_s, 0.3}, {0.05, 0.04}, 100) == 1);
    CHECK(rate.most_per_s() >= 10.0);
    CHECK(rate.most_per_s() <= 15.0);
}

TEST_CASE("the window draws as it likes where frames are in time, drawing is cheap or not measured",
          "[drawing]") {
    DrawingRate rate;
    CHECK(rate_changes(rate, kCostly, {0.03, 0.02}, 100) == 0);
    CHECK(rate_changes(rate, kCheap, {0.2, 0.2}, 100) == 0);
    CHECK(rate_changes(rate, {}, {0.2, 0.2}, 100) == 0);
    CHECK(rate.in_words().empty());
}

TEST_CASE("the window draws as before once there is time for it, and not before", "[drawing]") {
    const DrawingMachine machine{0.04, 0.02};
    DrawingRate rate;
    CHECK(rate_changes(rate, kCostly, machine, 1000) == 1);  // frames are in time by that alone
    CHECK(rate.in_words() == "The window draws 10 coarse pictures a second.");
    CHECK(rate_changes(rate, kCostly, machine, 1000, 0.7) == 0);  // 0.048 s: too near to 0.04
    CHECK(rate_changes(rate, kCostly, machine, 1000, 0.5) == 1);
    CHECK(rate.most_per_s() == 0.0);
}

TEST_CASE("a few late frames change nothing", "[drawing]") {
    DrawingRate rate;
    for (int k = 0; k < 100; ++k) {
        CHECK(rate_changes(rate, kCostly, {0.05, 0.05}, 5) == 0);
        CHECK(rate_changes(rate, kCostly, {0.02, 0.02}, 5) == 0);
    }
}

TEST_CASE("nothing changes for a video whose rate is not known", "[drawing]") {
    DrawingRate rate;
    for (int k = 0; k < 100; ++k) rate.update(kCostly, {.cleaning_s = 0.9}, 0.0, 1.0);
    CHECK(rate.most_per_s() == 0.0);
}
