// Whether teeth and pimples are counted where they are, and nothing else is.
#include "tests/bench/blemishes.hpp"

#include <cmath>
#include <functional>

#include "tests/support/catch.hpp"

namespace dibhr::bench {

namespace {

using Catch::Matchers::WithinAbs;

constexpr int kSide = 100;  // 10,000 px: one is 10 per 100,000
constexpr double kOneTooth = 10.0;

using Level = std::function<double(int i, int j)>;

DepthImage picture(const Level& level) {
    return image_of(kSide, kSide, 255.0, level);
}

Blemishes of(const Level& level) {
    BlemishMeter meter;
    meter.add(picture(level), picture(level));
    return meter.blemishes();
}

}  // namespace

TEST_CASE("straight and slanted outlines have no teeth", "[blemishes][long]") {
    CHECK(of([](int i, int) { return i < 40 ? 50.0 : 150.0; }).teeth == 0.0);
    CHECK(of([](int i, int j) { return 3 * i < 100 + j ? 50.0 : 150.0; }).teeth == 0.0);
    CHECK(of([](int i, int j) { return 3 * j < 100 + i ? 50.0 : 150.0; }).teeth == 0.0);
    CHECK(of([](int i, int j) { return i < j ? 50.0 : 150.0; }).teeth == 0.0);
}

TEST_CASE("a pixel that stands out of an outline is a tooth, and so is a notch",
          "[blemishes][long]") {
    const Blemishes out =
        of([](int i, int j) { return i < 40 || (i == 40 && j == 50) ? 50.0 : 150.0; });
    CHECK_THAT(out.teeth, WithinAbs(kOneTooth, 1e-9));
    const Blemishes notch =
        of([](int i, int j) { return j < 40 && (j != 39 || i != 50) ? 50.0 : 150.0; });
    CHECK_THAT(notch.teeth, WithinAbs(kOneTooth, 1e-9));
}

TEST_CASE("steps below a twentieth of the range, lone pixels, lines and holes have no teeth",
          "[blemishes][long]") {
    CHECK(of([](int i, int j) { return i < 40 || (i == 40 && j == 50) ? 140.0 : 150.0; }).teeth ==
          0.0);
    CHECK(of([](int i, int j) { return i == 40 && j == 50 ? 50.0 : 150.0; }).teeth == 0.0);
    CHECK(of([](int i, int) { return i == 40 ? 50.0 : 150.0; }).teeth == 0.0);
    CHECK(of([](int i, int j) { return i < 40 || (i == 40 && j == 50) ? 0.0 : 150.0; }).teeth ==
          0.0);
}

TEST_CASE("a pimple is higher or lower than half a pixel on ground that is flat but for it",
          "[blemishes][long]") {
    const auto with = [](double high_px) {
        return of([high_px](int i, int j) {
            return 100.0 + 0.3 * i + 0.2 * j + (i == 40 && j == 50 ? high_px : 0.0);
        });
    };
    constexpr double kOnePimple = 1e3 / (92.0 * 92.0);
    for (const double high_px : {0.8, -0.8}) {
        const Blemishes found = with(high_px);
        CHECK_THAT(found.pimples, WithinAbs(kOnePimple, 1e-9));
        CHECK_THAT(found.pimples_again, WithinAbs(kOnePimple, 1e-9));
        CHECK(found.flat == 1.0);
    }
    CHECK(with(0.4).pimples == 0.0);
    CHECK(of([](int i, int) { return 100.0 + 0.9 * i; }).flat == 0.0);
}

TEST_CASE("a pimple that is gone or turned in the next frame is not there again",
          "[blemishes][long]") {
    const auto with = [](int at, double high_px) {
        return picture([=](int i, int j) { return i == at && j == 50 ? 100.0 + high_px : 100.0; });
    };
    const auto again = [&](const DepthImage& next) {
        BlemishMeter meter;
        meter.add(with(40, 0.8), next);
        return meter.blemishes().pimples_again > 0.0;
    };
    CHECK(again(with(41, 0.7)));
    CHECK_FALSE(again(with(43, 0.8)));
    CHECK_FALSE(again(with(40, -0.8)));
    CHECK_FALSE(again(with(40, 0.4)));
}

TEST_CASE("ground that is known to be flat has its pimples counted whatever noise is on it",
          "[blemishes][long]") {
    const DepthImage rough =
        picture([](int i, int j) { return 100.0 + ((i * 7919 + j * 104729) % 97) % 9; });
    BlemishMeter unknown;
    unknown.add(rough, rough);
    CHECK(unknown.blemishes().flat < 0.01);
    BlemishMeter known(true);
    known.add(rough, rough);
    CHECK(known.blemishes().flat == 1.0);
    CHECK(known.blemishes().pimples > 50.0);
}

}  // namespace dibhr::bench
