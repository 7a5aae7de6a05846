// The window of frames: which two depth images a moment lies between.
#include "core/video/frames/frame_window.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

/// The first `count` of frames at 1.0, 1.1, 1.4 and 1.5 s.
FrameWindow window_of(std::size_t count) {
    FrameWindow window;
    const double times[] = {1.0, 1.1, 1.4, 1.5};
    for (std::size_t k = 0; k < count; ++k) window.frames[k].time_s = times[k];
    window.count = count;
    return window;
}

}  // namespace

TEST_CASE("an empty window has no pair", "[window]") {
    const FrameWindow window;
    CHECK(window.at(1.0).from == nullptr);
    CHECK(window.at(1.0).to == nullptr);
}

TEST_CASE("a moment lies between the frames around it, blended by time", "[window]") {
    const FrameWindow window = window_of(4);
    const auto [moment_s, from, blend] = GENERATE(table<double, int, double>({{1.0, 0, 0.0},
                                                                              {1.05, 0, 0.5},
                                                                              {1.1, 1, 0.0},
                                                                              {1.25, 1, 0.5},
                                                                              {1.4, 2, 0.0},
                                                                              {1.49, 2, 0.9}}));
    CAPTURE(moment_s);
    const DepthBlend pair = window.at(moment_s);
    CHECK(pair.from == &window.frames[static_cast<std::size_t>(from)]);
    CHECK_THAT(pair.blend, WithinAbs(blend, 1e-9));
    if (blend > 0.0) CHECK(pair.to == pair.from + 1);
}

TEST_CASE("the colour is that of the nearer frame, of which most of the depth is", "[window]") {
    const FrameWindow window = window_of(4);
    CHECK(&window.at(1.11).colour_frame() == &window.frames[1]);
    CHECK(&window.at(1.24).colour_frame() == &window.frames[1]);
    CHECK(&window.at(1.26).colour_frame() == &window.frames[2]);
    CHECK(&window.at(1.39).colour_frame() == &window.frames[2]);
}

TEST_CASE("before the first and after the last frame the surface is held", "[window]") {
    const FrameWindow window = window_of(4);
    CHECK(window.at(0.2).from == &window.frames[0]);
    CHECK_THAT(window.at(0.2).blend, WithinAbs(0.0, 0.0));
    CHECK(window.at(9.0).from == &window.frames[3]);
    CHECK(window.at(9.0).to == &window.frames[3]);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(window.at(nan).from == &window.frames[0]);
    CHECK_THAT(window.at(nan).blend, WithinAbs(0.0, 0.0));
}

TEST_CASE("a window of one frame always shows it", "[window]") {
    const FrameWindow window = window_of(1);
    CHECK(window.at(GENERATE(0.0, 1.0, 2.0)).to == &window.frames[0]);
}

TEST_CASE("the blended moment moves without a jump from pair to pair", "[window]") {
    const FrameWindow window = window_of(4);
    const auto position = [&](double moment_s) {
        const DepthBlend pair = window.at(moment_s);
        return pair.from->time_s + pair.blend * (pair.to->time_s - pair.from->time_s);
    };
    double largest = 0.0;
    for (int k = 0; k < 600; ++k) {
        const double moment_s = 0.95 + 0.001 * k;
        largest = std::max(largest, position(moment_s + 0.001) - position(moment_s));
    }
    CHECK_THAT(largest, WithinAbs(0.001, 1e-9));
}
