// The sample's named regions: twelve, each with a text, and where the program that makes them says.
#include <cstddef>
#include <set>
#include <string>

#include "assets/sample/pose.hpp"
#include "assets/sample/regions.hpp"
#include "core/video/guide/regions_file.hpp"
#include "tests/assets/sample_files.hpp"
#include "tests/support/catch.hpp"

namespace {

using dibhr::read_regions;
using dibhr::Regions;
using dibhr::sample::kColumns;
using dibhr::sample::kFramesPerSecond;
using dibhr::sample::kLabelPictures;
using dibhr::sample::kLabelStep;
using dibhr::sample::kRegionStep;
using dibhr::sample::kRows;
using dibhr::sample::kSampleRegions;

std::shared_ptr<const Regions> sample_regions() {
    auto regions = read_regions(dibhr::test::asset("sample/depth.mp4"), kColumns, kRows);
    REQUIRE(regions);
    return regions;
}

}  // namespace

TEST_CASE("the sample has twelve named regions that each have a text", "[sample]") {
    const auto regions = sample_regions();
    REQUIRE(regions->regions.size() == kSampleRegions);
    std::set<std::string> names;
    for (const dibhr::Region& region : regions->regions) {
        CAPTURE(region.name);
        CHECK(names.insert(region.name).second);
        CHECK(region.text.ends_with('.'));
    }
}

TEST_CASE("every label picture of the sample shows all regions and belongs to nothing else",
          "[sample]") {
    const auto regions = sample_regions();
    REQUIRE(regions->pictures == kLabelPictures);
    for (int picture = 0; picture < kLabelPictures; ++picture) {
        CAPTURE(picture);
        std::set<int> seen;
        for (int j = 0; j < regions->rows; ++j)
            for (int i = 0; i < regions->columns; ++i) seen.insert(regions->label(picture, i, j));
        CHECK(seen.size() == kSampleRegions);
        CHECK(*seen.begin() == 1);
    }
}

TEST_CASE("the label pictures are those that the program in the repository makes", "[sample]") {
    const auto regions = sample_regions();
    const int picture = GENERATE(0, 29);
    const int frame = dibhr::sample::frame_of_labels(picture);
    CHECK(regions->picture_at(static_cast<double>(frame) / kFramesPerSecond) == picture);
    const auto made = dibhr::sample::labels_of(frame);
    REQUIRE(made.size() ==
            static_cast<std::size_t>(regions->columns) * static_cast<std::size_t>(regions->rows));
    std::size_t others = 0;
    std::size_t k = 0;
    for (int j = 0; j < kRows / kLabelStep; ++j)
        for (int i = 0; i < kColumns / kLabelStep; ++i, ++k)
            others += made[k] == kRegionStep * regions->label(picture, i, j) ? 0 : 1;
    CHECK(others <= 4);  // another compiler's last bit
}
