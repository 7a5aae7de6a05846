// The bump maps: made by the program, small, and without a seam when tiled.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "assets/sample/bump.hpp"
#include "tests/assets/sample_files.hpp"
#include "tests/support/catch.hpp"

namespace {

using dibhr::sample::kBumpSide;

std::vector<std::uint8_t> made(const std::string& name) {
    return name == "linen" ? dibhr::sample::linen() : dibhr::sample::grain();
}

/// Mean difference from one column or row to the next; `from` = kBumpSide - 1 is the seam.
double step_after(const std::vector<std::uint8_t>& map, int from, bool between_columns) {
    const int to = (from + 1) % kBumpSide;
    double sum = 0.0;
    for (int k = 0; k < kBumpSide; ++k) {
        const auto at = [&](int i) {
            return map[static_cast<std::size_t>(between_columns ? k * kBumpSide + i
                                                                : i * kBumpSide + k)];
        };
        sum += std::abs(at(from) - at(to));
    }
    return sum / kBumpSide;
}

}  // namespace

TEST_CASE("the bump maps in the repository are those the program makes", "[bump]") {
    const std::string name = GENERATE("linen", "grain");
    CAPTURE(name);
    const auto file = dibhr::test::asset("bump/" + name + ".png");
    const cv::Mat stored = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    REQUIRE(stored.type() == CV_8UC1);
    REQUIRE(stored.total() == made(name).size());
    CHECK(std::filesystem::file_size(file) <= 100'000U);

    // A last bit of sine or exponential may differ between machines.
    const auto bytes = made(name);
    int worst = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        worst = std::max(worst, std::abs(bytes[i] - stored.data[i]));
    CHECK(worst <= 1);
}

TEST_CASE("a bump map uses all levels from 0 to 255", "[bump]") {
    const auto map = made(GENERATE("linen", "grain"));
    const auto [low, high] = std::minmax_element(map.begin(), map.end());
    CHECK(*low == 0);
    CHECK(*high == 255);
}

TEST_CASE("a bump map laid beside itself shows no seam", "[bump]") {
    const auto map = made(GENERATE("linen", "grain"));
    const bool between_columns = GENERATE(true, false);
    double largest = 0.0;
    for (int i = 0; i < kBumpSide - 1; ++i)
        largest = std::max(largest, step_after(map, i, between_columns));
    CHECK(step_after(map, kBumpSide - 1, between_columns) <= largest);
}
