// Cleaning on a few threads, however much is waiting.
#include "core/replay/frames.hpp"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <future>
#include <iterator>
#include <memory>
#include <vector>

#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

/// Slopes and holes, so that there is something to clean; each image is another one.
DepthImage image_of(int number) {
    DepthImage depth{64, 48, 255.0, {}};
    for (int k = 0; k < depth.columns * depth.rows; ++k) {
        depth.levels.push_back(k % 11 == 0 ? std::nanf("")
                                           : static_cast<float>((k + 7 * number) % 97));
    }
    return depth;
}

std::ptrdiff_t threads_of_this_process() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

}  // namespace

TEST_CASE("hundreds of images are cleaned by two threads, each as if it were alone", "[replay]") {
    constexpr int kImages = 300;
    const CleaningOptions options{true, true, true};
    const auto before = threads_of_this_process();
    CleaningWorkers workers;
    std::vector<std::shared_future<CleanedDepth>> cleaned;
    for (int k = 0; k < kImages; ++k) cleaned.push_back(workers.clean(image_of(k), options));
    CHECK(threads_of_this_process() <= before + 2);
    DepthCleaner alone;
    int differing = 0;
    for (int k = 0; k < kImages; ++k) {
        DepthImage expected = image_of(k);
        alone.clean(expected, options);
        differing +=
            cleaned[static_cast<std::size_t>(k)].get().depth->levels == expected.levels ? 0 : 1;
    }
    CHECK(differing == 0);
}

TEST_CASE("what waits to be cleaned is given up when nobody wants it any more", "[replay]") {
    std::shared_future<CleanedDepth> last;
    {
        CleaningWorkers workers;
        for (int k = 0; k < 2000; ++k) last = workers.clean(image_of(k), {true, true, true});
    }
    CHECK_THROWS_AS(last.get(), std::future_error);
}
