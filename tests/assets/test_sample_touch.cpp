// DIBHR on the built-in sample: the force is that of a walk in far finer steps.
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "core/haptics/surface.hpp"
#include "core/video/cleaning/cleaning_chain.hpp"
#include "tests/assets/sample_files.hpp"
#include "tests/core/haptics/fine_walk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

/// A frame of the sample as the viewer touches it.
DepthImage cleaned(const cv::Mat& frame) {
    DepthImage depth{frame.cols, frame.rows, 255.0, {}};
    for (int j = 0; j < frame.rows; ++j) {
        for (int i = 0; i < frame.cols; ++i) {
            depth.levels.push_back(static_cast<float>(frame.at<unsigned char>(j, i)));
        }
    }
    return *CleaningChain().clean_and_finish(depth, {kGentleSteps}).depth;
}

/// Rounds over the body at half a pixel an update, 6 px under the surface there.
std::vector<Vec3> goals_under(const DepthSurface& surface) {
    std::vector<Vec3> goals;
    for (int k = 0; k < 300; ++k) {
        const double t = 0.01 * k;
        Vec3 goal(surface.columns() * (0.5 + 0.12 * std::cos(t)),
                  surface.rows() * (0.55 + 0.12 * std::sin(1.3 * t)), 0.0);
        goal.z = surface.elevation_at(goal.x, goal.y) - 6.0;
        goals.push_back(goal);
    }
    return goals;
}

}  // namespace

TEST_CASE("on the sample the force is within half a degree of a hundred times finer walk's",
          "[sample]") {
    const auto [frame, mu] =
        GENERATE(table<std::size_t, double>({{std::size_t{0}, 0.0}, {std::size_t{5}, 0.4}}));
    REQUIRE(test::sample_video().depth.size() > frame);
    const DepthImage image = cleaned(test::sample_video().depth[frame]);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    const auto angles_deg = test::angles_to_fine_walk(surface, goals_under(surface), mu);
    const double median_deg = test::median_of(angles_deg);
    CAPTURE(frame, mu, median_deg);
    CHECK(median_deg <= 0.5);
}
