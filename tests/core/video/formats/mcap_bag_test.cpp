// What only MCAP has: chunks and their indexes, recordings without an end, other encodings.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/bag_writers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// A depth topic of so many pictures, whose levels tell their numbers, ten in a second.
void write_pictures(const fs::path& file, const BagForm& form, int count) {
    Bag bag(file, form);
    const int depth = bag.topic("/depth", "Image");
    for (int n = 0; n < count; ++n) bag.add(depth, depth_image(1.0 + 0.1 * n, n + 1));
}

std::vector<int> levels_of(PictureSource& source) {
    std::vector<int> levels;
    while (const auto taken = source.next())
        levels.push_back(taken->picture.at<std::uint16_t>(3, 3));
    return levels;
}

/// None where the file is refused.
std::vector<int> levels_in(const fs::path& file) {
    std::vector<int> levels;
    const std::string said =
        refusal([&] { levels = levels_of(*open_picture_source(file, PictureRole::depth)); });
    REQUIRE(said.find('\n') == std::string::npos);
    return levels;
}

std::vector<int> numbers_to(std::size_t last) {
    std::vector<int> numbers(last);
    std::iota(numbers.begin(), numbers.end(), 1);
    return numbers;
}

}  // namespace

TEST_CASE("a bag in MCAP is read from any time to any other", "[bag][mcap]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    CAPTURE(form.name());
    const fs::path file = folder / ("a" + form.ending);
    write_pictures(file, form, 40);
    const auto source = open_picture_source(file, PictureRole::depth);
    for (const int n : {39, 0, 20, 21, 3, 38, 2, 37}) {
        source->seek(0.1 * n + 0.01);
        CHECK(source->next()->picture.at<std::uint16_t>(3, 3) == n + 1);
    }
}

TEST_CASE("a recording in MCAP that was cut off plays what is whole of it, and this is said",
          "[bag][mcap]") {
    const TemporaryFolder folder;
    BagForm form = GENERATE(from_range(mcap_forms()));
    form.chunk_bytes = 1;  // each message has its own
    CAPTURE(form.name());
    constexpr std::size_t kPictures = 4;
    write_pictures(folder / "whole.mcap", form, kPictures);
    const std::string whole = read_text(folder / "whole.mcap");
    const fs::path part = folder / "part.mcap";
    std::size_t before = 0;
    for (std::size_t missing = whole.size() - 9; missing > 0;
         missing -= std::min<std::size_t>(3, missing)) {
        CAPTURE(missing);
        write_text(part, whole.substr(0, whole.size() - missing));
        const std::vector<int> levels = levels_in(part);
        REQUIRE(levels == numbers_to(levels.size()));
        REQUIRE((levels.size() == before || levels.size() == before + 1));
        before = levels.size();
    }
    CHECK(before == kPictures);
    const auto notice = [](const fs::path& file) { return open_depth(file)->description().notice; };
    write_text(part, whole.substr(0, whole.size() - 1));
    CHECK(contains(notice(part), "was cut off"));
    CHECK(notice(folder / "whole.mcap").empty());
    write_text(part, whole.substr(0, whole.size() - 1) + std::string(5000, '\0'));
    CHECK(levels_in(part) == numbers_to(kPictures));
}

TEST_CASE("a recorder that crashed left its last chunk half written: its whole messages play",
          "[bag][mcap]") {
    const TemporaryFolder folder;
    BagForm form{.finished = false, .chunk_bytes = 900};
    form.packing = GENERATE("", "zstd", "lz4");
    write_pictures(folder / "a.mcap", form, 20);
    const std::string bytes = read_text(folder / "a.mcap");
    const std::vector<int> all = levels_in(folder / "a.mcap");
    CHECK(all == numbers_to(all.size()));
    CHECK(all.size() >= 16);
    write_text(folder / "a.mcap", bytes.substr(0, bytes.size() - 200));
    const std::vector<int> fewer = levels_in(folder / "a.mcap");
    CHECK(fewer == numbers_to(fewer.size()));
    CHECK(fewer.size() < all.size());
    CHECK(fewer.size() >= all.size() - (form.packing.empty() ? 1U : 5U));
}

TEST_CASE("an MCAP file whose lengths lie ends in a line or in what is left", "[bag][mcap]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(mcap_forms()));
    CAPTURE(form.name());
    constexpr std::size_t kPictures = 3;
    write_pictures(folder / "whole.mcap", form, kPictures);
    const std::string whole = read_text(folder / "whole.mcap");
    const std::string lie =
        GENERATE(std::string(8, '\xff'), std::string("\xff\xff\xff\x7f", 4), std::string(8, '\0'));
    for (std::size_t at = 8; at + lie.size() <= whole.size(); at += 5) {
        CAPTURE(at);
        std::string lying = whole;
        lying.replace(at, lie.size(), lie);
        write_text(folder / "lying.mcap", lying);
        REQUIRE(levels_in(folder / "lying.mcap").size() <= kPictures);
    }
}

TEST_CASE("messages that a recorder packed one by one are unpacked", "[bag][mcap]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    CAPTURE(form.name());
    const fs::path file = folder / ("a" + form.ending);
    const bool broken = GENERATE(false, true);
    {
        Bag bag(file, form);
        const int depth = bag.topic("/depth", "Image");
        for (const int n : {3, 2, 4}) {
            const std::string packed = packed_bytes(depth_image(n, n, 800, 600), "zstd");
            bag.add(depth, broken && n == 4 ? packed.substr(0, 20) : packed, 1 + depth);
        }
    }
    const auto source = open_picture_source(file, PictureRole::depth);
    // Without its stamp the broken one makes all play by when they were recorded, which is once.
    CHECK(levels_of(*source) == (broken ? std::vector<int>{3} : std::vector<int>{2, 3, 4}));
}

TEST_CASE("recordings of other systems in MCAP say what they hold", "[bag][mcap]") {
    const TemporaryFolder folder;
    {
        Bag bag(folder / "ros1.mcap", {});
        bag.add(bag.other_topic("/camera", "sensor_msgs/Image", "ros1"), "any");
    }
    const std::string said = refusal([&] { (void)open_depth(folder / "ros1.mcap"); });
    CHECK(contains(said, "/camera: sensor_msgs/Image in ros1"));
    write_pictures(folder / "bz2.mcap", {.packing = "bz2"}, 2);
    CHECK(contains(refusal([&] { (void)open_depth(folder / "bz2.mcap"); }), "packed with bz2"));
}

TEST_CASE("a packed bag beside its unpacked files is passed over", "[bag][mcap]") {
    const TemporaryFolder folder;
    write_pictures(folder / "walk_0.mcap", {}, 3);
    write_text(folder / "walk_0.mcap.zstd", packed_bytes("any", "zstd"));
    CHECK(levels_in(folder.path()) == numbers_to(3));
    write_text(folder / "walk_1.mcap.zstd", packed_bytes("any", "zstd"));
    CHECK(contains(refusal([&] { (void)open_depth(folder.path()); }), "zstd -d"));
}

TEST_CASE("a long packed bag takes its times from the recording, less the delay, and says so",
          "[bag][mcap][long]") {
    const TemporaryFolder folder;
    constexpr int kPictures = 36;  // 15 MB each that must be unpacked: more than half a gigabyte
    constexpr std::size_t kBetween_bytes = 15 << 20;
    {
        Bag bag(folder / "a.mcap", {.packing = "zstd", .chunk_bytes = kBetween_bytes + 3000});
        const int points = bag.topic("/points", "PointCloud2");
        const int depth = bag.topic("/depth", "Image");
        for (int n = 0; n < kPictures; ++n) {
            const std::int64_t jitter_ns = n == 7 ? 30'000'000 : 0;
            bag.add(points, std::string(kBetween_bytes, '\0'));
            bag.add(depth, depth_image(1.0 + 0.1 * n, n + 1, 64, 48),
                    1'050'000'000 + 100'000'000LL * n + jitter_ns);
        }
    }
    const auto source = open_picture_source(folder / "a.mcap", PictureRole::depth);
    CHECK(contains(source->facts().notice, "too long"));
    CHECK(std::abs(source->facts().start_s - 1.0) < 1e-6);
    std::vector<double> times_s;
    while (const auto taken = source->next()) times_s.push_back(taken->time_s);
    REQUIRE(times_s.size() == std::size_t{kPictures});
    CHECK(std::abs(times_s[6] - 0.6) < 1e-6);
    CHECK(std::abs(times_s[7] - 0.73) < 1e-6);
}
