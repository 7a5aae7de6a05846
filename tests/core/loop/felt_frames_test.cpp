// The frames that wait for the recorder.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "core/loop/felt_frames.hpp"
#include "core/video/sources/preview_picture.hpp"
#include "tests/core/loop/loop_bench.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr double kInterval_s = 0.04;

/// Frames that follow each other, of which a player publishes two at a time.
class Film {
  public:
    [[nodiscard]] Frame frame(std::size_t k) {
        while (frames_.size() <= k) {
            Frame next = flat_frame(32, 16, static_cast<float>(frames_.size()));
            next.media = 1;
            next.media_s = kInterval_s * static_cast<double>(frames_.size());
            frames_.push_back(next);
        }
        return frames_[k];
    }
    [[nodiscard]] FrameWindow window(std::size_t first) {
        FrameWindow window;
        window.frames[0] = frame(first);
        window.frames[1] = frame(first + 1);
        window.count = 2;
        return window;
    }
    [[nodiscard]] TickRecord tick(std::size_t from, std::size_t to) {
        TickRecord tick;
        const Frame first = frame(from);
        const Frame second = frame(to);
        tick.frames.source.media = 1;
        tick.frames.from_s = first.media_s;
        tick.frames.to_s = second.media_s;
        tick.mark = {.from = first.depth.get(), .to = second.depth.get()};
        return tick;
    }

  private:
    std::vector<Frame> frames_{};
};

}  // namespace

TEST_CASE("while a recording is on frames are kept until later ones are asked for", "[felt]") {
    Film film;
    FeltFrames felt;
    felt.keep(true);
    for (std::size_t k = 0; k < 20; ++k) felt.add(film.window(k));
    for (std::size_t k = 0; k < 20; ++k) {
        CAPTURE(k);
        const auto surface = felt.surface_of(film.tick(k, k + 1));
        REQUIRE(surface);
        REQUIRE(surface->images.size() == 2);
        CHECK(surface->images[0].levels == film.frame(k).depth);
        CHECK(surface->images[1].levels == film.frame(k + 1).depth);
    }
    CHECK_FALSE(felt.surface_of(film.tick(3, 4)));
    CHECK(felt.surface_of(film.tick(19, 20)));  // still shown
}

TEST_CASE("of each second of a video that is recorded there is one small picture", "[felt]") {
    constexpr std::size_t kFrames = 60;  // of 2.4 s
    Film film;
    FeltFrames felt;
    std::vector<std::weak_ptr<const ColourImage>> colours;
    const auto coloured = [&](std::size_t k) {
        auto colour = std::make_shared<ColourImage>(ColourImage{1300, 20, {}});
        colour->rgb.assign(std::size_t{3} * 1300 * 20, static_cast<std::uint8_t>(2 * k));
        colours.emplace_back(colour);
        return colour;
    };
    const auto record_all = [&](bool pictures) {
        felt.keep(true, pictures);
        std::shared_ptr<const ColourImage> colour = coloured(0);
        for (std::size_t k = 0; k < kFrames; ++k) {
            FrameWindow window = film.window(k);
            window.frames[0].colour = std::exchange(colour, coloured(k + 1));
            window.frames[1].colour = colour;
            felt.add(window);
        }
    };
    const auto pictured = [&] {
        std::vector<std::size_t> frames;
        for (std::size_t k = 0; k + 1 < kFrames; ++k) {
            REQUIRE(felt.surface_of(film.tick(k, k + 1)));
            const auto picture = picture_of_preview(felt.preview());
            if (!picture) continue;
            CHECK(picture->columns == 433);
            CHECK(picture->rows == 6);
            CHECK(std::abs(picture->rgb[0] - static_cast<int>(2 * k)) <= 2);
            frames.push_back(k);
        }
        return frames;
    };
    record_all(true);
    const auto alive = std::ranges::count_if(colours, [](const auto& c) { return !c.expired(); });
    CHECK(alive <= 6);  // one a second, and those of the last window
    CHECK(pictured() == std::vector<std::size_t>{0, 25, 50});
    record_all(false);
    CHECK(pictured().empty());
}

TEST_CASE("without a recording only what is shown is kept", "[felt]") {
    Film film;
    FeltFrames felt;
    for (std::size_t k = 0; k < 5; ++k) felt.add(film.window(k));
    CHECK_FALSE(felt.surface_of(film.tick(3, 4)));
    felt.keep(true);
    CHECK(felt.surface_of(film.tick(4, 5)));
}

TEST_CASE("a recorder whose disk hangs finds the newest frames, and the older ones are given up",
          "[felt]") {
    FeltFrames felt;
    felt.keep(true);
    std::vector<std::weak_ptr<const DepthImage>> published;
    for (int k = 0; k < 40; ++k) {
        FrameWindow window;
        window.frames[0] = flat_frame(2048, 2048, 1.0F);  // 16 MB
        window.count = 1;
        published.emplace_back(window.frames[0].depth);
        felt.add(window);
    }
    std::size_t alive = 0;
    for (const auto& image : published) alive += image.expired() ? 0 : 1;
    CHECK(alive >= 8);
    CHECK(alive <= 20);
    CHECK_FALSE(published.back().expired());
    felt.keep(false);
    CHECK(published[38].expired());
}

TEST_CASE("a tick finds the motion and the in-betweens that it had, also where they came later",
          "[felt]") {
    Film film;
    FeltFrames felt;
    felt.keep(true);
    felt.add(film.window(0));
    FrameWindow connected = film.window(0);
    connected.frames[0].motion = std::make_shared<MotionField>();
    connected.frames[0].in_betweens =
        std::make_shared<std::vector<Frame>>(2, flat_frame(32, 16, 0.5F));
    felt.add(connected);
    felt.add(film.window(1));
    TickRecord tick = film.tick(0, 1);
    const auto plain = felt.surface_of(tick);
    REQUIRE(plain);
    CHECK_FALSE(plain->motion);
    CHECK(plain->images.size() == 2);
    tick.mark.motion = connected.frames[0].motion.get();
    tick.mark.in_betweens = connected.frames[0].in_betweens.get();
    const auto moving = felt.surface_of(tick);
    REQUIRE(moving);
    CHECK(moving->motion == connected.frames[0].motion);
    CHECK(moving->images.size() == 4);
    CHECK(felt.surface_of(film.tick(1, 2)));
}

TEST_CASE("a frame that blends with itself is one image without motion", "[felt]") {
    Film film;
    FeltFrames felt;
    FrameWindow window = film.window(0);
    window.frames[0].motion = std::make_shared<MotionField>();
    felt.add(window);
    const auto surface = felt.surface_of(film.tick(0, 0));
    REQUIRE(surface);
    CHECK(surface->images.size() == 1);
    CHECK_FALSE(surface->motion);
}
