// The materials: their maps are made by the program, tile without a seam and feel like what they
// are called.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <toml++/toml.h>
#include <opencv2/imgcodecs.hpp>

#include "assets/materials/materials.hpp"
#include "core/error.hpp"
#include "tests/assets/sample_files.hpp"
#include "tests/support/catch.hpp"

namespace {

using dibhr::materials::kSide;
using Map = std::vector<std::uint8_t>;

/// Made once.
const Map& map_of(const std::string& name) {
    static std::map<std::string, Map> made;
    const auto found = made.find(name);
    return found != made.end() ? found->second
                               : made.emplace(name, dibhr::materials::map_of(name)).first->second;
}

int level(const Map& map, int column, int row) {
    const auto wrapped = [](int i) { return (i % kSide + kSide) % kSide; };
    return map[static_cast<std::size_t>(wrapped(row)) * kSide +
               static_cast<std::size_t>(wrapped(column))];
}

/// Mean difference from one column or row to the next; `from` = kSide - 1 is the seam.
double step_after(const Map& map, int from, bool between_columns) {
    double sum = 0.0;
    for (int k = 0; k < kSide; ++k) {
        const auto at = [&](int i) {
            return between_columns ? level(map, i, k) : level(map, k, i);
        };
        sum += std::abs(at(from) - at(from + 1));
    }
    return sum / kSide;
}

double mean_step(const Map& map, bool between_columns) {
    double sum = 0.0;
    for (int i = 0; i < kSide; ++i) sum += step_after(map, i, between_columns);
    return sum / kSide;
}

/// How alike a map is to itself, moved: 1 the same, 0 nothing in common.
class Likeness {
  public:
    explicit Likeness(const Map& map) {
        const double mean =
            std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
        for (const std::uint8_t level : map) {
            from_mean_.push_back(static_cast<float>(level - mean));
            all_ += (level - mean) * (level - mean);
        }
    }
    /// By less than a map to the right and down.
    [[nodiscard]] double moved(int right, int down) const {
        double same = 0.0;
        for (int row = 0; row < kSide; ++row) {
            const float* const here = row_at(row);
            const float* const there = row_at((row + down) % kSide);
            float sum = 0.0F;
            for (int k = 0; k < kSide - right; ++k) sum += here[k] * there[k + right];
            for (int k = kSide - right; k < kSide; ++k) sum += here[k] * there[k + right - kSide];
            same += static_cast<double>(sum);
        }
        return same / all_;
    }

  private:
    [[nodiscard]] const float* row_at(int row) const {
        return from_mean_.data() + static_cast<std::ptrdiff_t>(row) * kSide;
    }

    std::vector<float> from_mean_{};
    double all_{0.0};
};

toml::table sheet_of(const std::string& name) {
    return toml::parse_file(dibhr::test::asset("materials/" + name + ".toml").string());
}

double number(const std::string& name, const char* key) {
    return sheet_of(name)[key].value<double>().value();
}

/// Millimetres up for each millimetre along, from pixel to pixel: the steepest and the mean.
struct Slopes {
    double steepest{};
    double mean{};
};

Slopes slopes_of(const std::string& name) {
    const Map& map = map_of(name);
    int steepest = 0;
    for (int row = 0; row < kSide; ++row)
        for (int column = 0; column < kSide; ++column) {
            const int here = level(map, column, row);
            steepest = std::max({steepest, std::abs(level(map, column + 1, row) - here),
                                 std::abs(level(map, column, row + 1) - here)});
        }
    const double a_level = number(name, "height") / 255.0 / (number(name, "width") / kSide);
    return {steepest * a_level, 0.5 * (mean_step(map, true) + mean_step(map, false)) * a_level};
}

std::string each_name() {
    const auto all = dibhr::materials::names();
    return all[static_cast<std::size_t>(GENERATE(range(0, 9)))];
}

}  // namespace

TEST_CASE("there are nine materials, each a map and a sheet of figures", "[materials]") {
    CHECK(dibhr::materials::names() == std::vector<std::string>{"bark", "ice", "linen", "rubber",
                                                                "sandpaper", "skin", "stone",
                                                                "wood", "wool"});
    std::vector<std::string> sheets, maps;
    for (const auto& entry : std::filesystem::directory_iterator(dibhr::test::asset("materials"))) {
        const auto& file = entry.path();
        if (file.extension() == ".toml") sheets.push_back(file.stem().string());
        if (file.extension() == ".png") maps.push_back(file.stem().string());
    }
    std::sort(sheets.begin(), sheets.end());
    std::sort(maps.begin(), maps.end());
    CHECK(sheets == dibhr::materials::names());
    CHECK(maps == dibhr::materials::names());
    CHECK_THROWS_AS(map_of("velvet"), dibhr::InputError);
}

TEST_CASE("the maps in the repository are those the program makes, to the level", "[materials]") {
    const std::string name = each_name();
    CAPTURE(name);
    const auto file = dibhr::test::asset("materials/" + name + ".png");
    const cv::Mat stored = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    REQUIRE(stored.type() == CV_8UC1);
    REQUIRE(stored.cols == kSide);
    REQUIRE(stored.rows == kSide);
    CHECK(std::filesystem::file_size(file) <= 60'000U);
    const Map& made = map_of(name);
    CHECK(std::equal(made.begin(), made.end(), stored.data));
}

TEST_CASE("a material's map uses all levels from 0 to 255", "[materials]") {
    const Map& map = map_of(each_name());
    const auto ends = std::minmax_element(map.begin(), map.end());
    CHECK(*ends.first == 0);
    CHECK(*ends.second == 255);
}

TEST_CASE("a material's map laid beside itself shows no seam", "[materials]") {
    const std::string name = each_name();
    CAPTURE(name);
    const Map& map = map_of(name);
    for (const bool between_columns : {true, false}) {
        double largest = 0.0;
        for (int i = 0; i < kSide - 1; ++i)
            largest = std::max(largest, step_after(map, i, between_columns));
        CHECK(step_after(map, kSide - 1, between_columns) <= largest);
    }
}

TEST_CASE("a material's figures are in range and stay where a Falcon is stable", "[materials]") {
    const std::string name = each_name();
    CAPTURE(name);
    CHECK(sheet_of(name)["map"].value<std::string>() == name + ".png");
    const double pixel_mm = number(name, "width") / kSide;
    CHECK(pixel_mm >= 0.1);
    CHECK(pixel_mm <= 0.25);
    CHECK(number(name, "height") > 0.0);
    CHECK(number(name, "dynamic-friction") > 0.0);
    CHECK(number(name, "dynamic-friction") <= number(name, "static-friction"));
    CHECK(number(name, "static-friction") <= 1.5);
    CHECK(number(name, "stiffness") >= 0.2);
    CHECK(number(name, "stiffness") <= 1.2);
    CHECK(number(name, "damping") >= 0.0);
    CHECK(number(name, "damping") <= 3.0);
}

TEST_CASE("what is hard rings, higher and longer than what is soft", "[materials]") {
    for (const char* hard : {"ice", "stone", "wood"})
        for (const char* soft : {"linen", "rubber", "skin", "wool"}) {
            CAPTURE(hard, soft);
            CHECK(number(hard, "sound-frequency") > 2.0 * number(soft, "sound-frequency"));
            CHECK(number(hard, "sound-decay") > 2.0 * number(soft, "sound-decay"));
            CHECK(number(hard, "sound-loudness") < 1.0);
        }
    for (const std::string& other : dibhr::materials::names())
        CHECK(number(other, "sound-hiss") <= number("sandpaper", "sound-hiss"));
}

TEST_CASE("only bark has walls, and even these can be climbed", "[materials]") {
    const std::string name = each_name();
    CAPTURE(name);
    CHECK(slopes_of(name).steepest <= (name == "bark" ? 5.5 : 3.5));
}

TEST_CASE("ice is by far the smoothest and the most slippery", "[materials]") {
    const double ice = slopes_of("ice").mean;
    for (const std::string& other : dibhr::materials::names()) {
        if (other == "ice") continue;
        CAPTURE(other);
        CHECK(ice * 5.0 < slopes_of(other).mean);
        CHECK(number("ice", "static-friction") * 5.0 < number(other, "static-friction"));
    }
}

TEST_CASE("what is woven, knitted or moulded repeats from thread to thread", "[materials]") {
    const Likeness linen(map_of("linen")), wool(map_of("wool")), rubber(map_of("rubber"));
    for (const int pairs : {1, 2, 5}) {
        CAPTURE(pairs);
        CHECK(linen.moved(16 * pairs, 0) > 0.6);
        CHECK(linen.moved(0, 16 * pairs) > 0.6);
        CHECK(linen.moved(8 * pairs + 4, 0) < 0.3);
        CHECK(linen.moved(0, 8 * pairs + 4) < 0.3);
        CHECK(wool.moved(32 * pairs, 0) > 0.6);
        CHECK(rubber.moved(16 * pairs, 16) > 0.999);
    }
    CHECK(wool.moved(0, 128) > 0.6);
    CHECK(wool.moved(16, 0) < 0.4);
}

TEST_CASE("what grew or broke repeats nowhere within its map", "[materials]") {
    const std::string name = GENERATE("bark", "ice", "sandpaper", "skin", "stone");
    CAPTURE(name);
    const Likeness map(map_of(name));
    double most = -1.0;
    for (int down = 0; down < kSide; down += 8)
        for (int right = 0; right <= kSide / 2; right += 8) {
            const int away = std::min(down, kSide - down);
            if (std::max(right, away) >= 32) most = std::max(most, map.moved(right, down));
        }
    CHECK(most < 0.6);
}

TEST_CASE("wood is smooth along its grain, bark along its furrows, and sand either way",
          "[materials]") {
    const auto across_to_along = [](const std::string& name, bool grain_to_the_right) {
        const Map& map = map_of(name);
        return mean_step(map, !grain_to_the_right) / mean_step(map, grain_to_the_right);
    };
    CHECK(across_to_along("wood", true) > 5.0);
    CHECK(across_to_along("bark", false) > 1.5);
    CHECK(std::abs(across_to_along("sandpaper", true) - 1.0) < 0.15);
}

TEST_CASE("sandpaper is rougher than stone from pixel to pixel, and stone the higher",
          "[materials]") {
    CHECK(mean_step(map_of("sandpaper"), true) > 2.0 * mean_step(map_of("stone"), true));
    CHECK(number("stone", "height") > 5.0 * number("sandpaper", "height"));
}
