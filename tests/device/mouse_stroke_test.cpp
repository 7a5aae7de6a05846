// The virtual hand with the rendered touch: clicks that are felt, and strokes over outlines.
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "core/haptics/touch.hpp"
#include "device/mouse_hand.hpp"
#include "tests/device/hand_in_loop.hpp"
#include "tests/support/catch.hpp"

namespace {

using dibhr::HandReading;
using dibhr::MouseHand;
using dibhr::MouseHandOptions;
using dibhr::Touch;
using dibhr::Vec2;
using dibhr::Vec3;
using dibhr::test::cliff;
using dibhr::test::flat;
using dibhr::test::kPitch_mm;
using dibhr::test::SmallRelief;

constexpr double kTick_s = 0.001;

/// The hand and what it feels, as the loop runs them.
class Stroke {
  public:
    explicit Stroke(SmallRelief relief) : relief_(std::move(relief)), surface_(relief_.surface()) {}
    Stroke(const Stroke&) = delete;
    Stroke& operator=(const Stroke&) = delete;

    MouseHand hand{};
    dibhr::TouchParameters parameters{.friction = {0.4, 0.4}};
    dibhr::MouseTarget cursor{.pointing = true};
    HandReading reading{};
    Touch felt{};

    void tick() {
        hand.target().publish(cursor);
        const auto& proxy = felt.proxy;
        reading = hand.read({kTick_s, surface_, kPitch_mm,
                             proxy.contact ? std::optional(proxy.position) : std::nullopt});
        if (reading.lifted && proxy.contact) renderer_.release_contact();
        felt = renderer_.update(surface_, reading.goal_in_grid, parameters, {}, {});
        hand.send(felt.sent_force_newton);
    }
    void run(double seconds) {
        for (double t = 0.0; t < seconds; t += kTick_s) tick();
    }
    void move_to(Vec2 place) { cursor.cursor_in_grid = place; }
    void hover_at(Vec2 place) {
        move_to(place);
        cursor.pressed = false;
        run(0.8);
    }
    void press_at(Vec2 place) {
        hover_at(place);
        cursor.pressed = true;
        run(0.5);
    }
    void click(Vec2 place, bool pressed, double after_s) {
        hand.clicks().push({place, pressed, after_s});
        cursor = {.cursor_in_grid = place,
                  .pointing = true,
                  .pressed = pressed,
                  .clicks = cursor.clicks + 1};
    }

    [[nodiscard]] const dibhr::DepthSurface& surface() const { return surface_; }
    [[nodiscard]] double below_px() const {
        const Vec3& goal = reading.goal_in_grid;
        return surface_.elevation_at(goal.x, goal.y) - goal.z;
    }
    [[nodiscard]] Vec2 proxy() const { return felt.proxy.position; }

  private:
    SmallRelief relief_;
    dibhr::DepthSurface surface_;
    dibhr::TouchRenderer renderer_{};
};

/// A wall with bodies before it: round ones, boxes, a pencil, all with upright outlines.
SmallRelief bodies() {
    return {400, 300, [](int i, int j) {
                const double ball = 60.0 * 60.0 - std::pow(i - 110, 2) - std::pow(j - 90, 2);
                if (ball > 0.0) return 120.0 + std::sqrt(ball);
                if (i > 220 && i < 320 && j > 30 && j < 140) return j < 80 ? 60.0 : 200.0;
                if (j > 200 && j < 206) return 40.0;
                if (i > 60 && i < 180 && j > 220) return 25.0 + 0.3 * (i - 60);
                return 10.0;
            }};
}

/// The longest time for which the proxy stood while the cursor was far ahead of it [s].
double longest_stand_s(Stroke& at, Vec2 from, Vec2 to, double px_per_s) {
    constexpr double kAhead_px = 75.0;  // what friction explains on slopes of 45 degrees is less
    at.press_at(from);
    int stood = 0;
    int longest = 0;
    const double lasts_s = glm::distance(from, to) / px_per_s;
    for (double t = 0.0; t < lasts_s + 0.6; t += kTick_s) {
        at.move_to(from + (to - from) * std::min(t / lasts_s, 1.0));
        const Vec2 before = at.proxy();
        at.tick();
        const bool stands = at.felt.proxy.contact &&
                            glm::distance(at.proxy(), before) < 20.0 * kTick_s &&
                            glm::distance(at.proxy(), at.cursor.cursor_in_grid) > kAhead_px;
        stood = stands ? stood + 1 : 0;
        longest = std::max(longest, stood);
    }
    return longest * kTick_s;
}

}  // namespace

TEST_CASE("each click is felt, however short, and in its order", "[mouse]") {
    const double lasts_s = GENERATE(0.0, 0.005, 0.02, 0.2);
    CAPTURE(lasts_s);
    Stroke at(flat());
    at.hover_at({50.0, 50.0});
    const std::vector<Vec2> places{{60.0, 50.0}, {60.0, 50.0}, {300.0, 250.0}, {62.0, 52.0}};
    for (const Vec2 place : places) {  // all of them at once, as after a slow picture
        at.click(place, true, 0.1);
        at.click(place, false, lasts_s);
    }
    std::vector<Vec2> felt_at;
    bool before = false;
    int longest = 0;
    int pressed = 0;
    for (int k = 0; k < 3000; ++k) {
        at.tick();
        if (at.felt.proxy.contact && !before) felt_at.push_back(at.proxy());
        before = at.felt.proxy.contact;
        pressed = at.reading.buttons != 0 ? pressed + 1 : 0;
        longest = std::max(longest, pressed);
    }
    REQUIRE(felt_at.size() == places.size());
    for (std::size_t k = 0; k < places.size(); ++k)
        CHECK(glm::distance(felt_at[k], places[k]) < 6.0);
    CHECK(longest * kTick_s >= lasts_s - 1e-9);
    CHECK(at.reading.buttons == 0);
    CHECK(at.hand.rests());
}

TEST_CASE("a drag between two late clicks comes to its end before the button goes up", "[mouse]") {
    Stroke at(flat());
    at.hover_at({50.0, 150.0});
    at.click({50.0, 150.0}, true, 1.0);
    at.click({150.0, 150.0}, false, 0.03);
    double furthest = 0.0;
    for (int k = 0; k < 1000; ++k) {
        at.tick();
        if (at.felt.proxy.contact) furthest = std::max(furthest, at.proxy().x);
    }
    CHECK(furthest > 130.0);
    CHECK(at.reading.buttons == 0);
}

TEST_CASE("clicks of before move nothing once they are forgotten", "[mouse]") {
    Stroke at(flat());
    at.hover_at({50.0, 50.0});
    at.click({50.0, 50.0}, true, 0.1);
    at.tick();
    at.click({90.0, 50.0}, false, 0.1);
    at.click({200.0, 50.0}, true, 0.1);
    at.hand.forget_clicks();
    at.cursor.pressed = false;
    at.run(0.5);
    CHECK(at.reading.buttons == 0);
    CHECK(at.below_px() < 0.0);
}

TEST_CASE("a hand that a wall stops rises over it in 60 ms, softly, and presses on behind it",
          "[mouse]") {
    const double height_px = GENERATE(6.0, 30.0, 150.0, 240.0);
    CAPTURE(height_px);
    Stroke at(cliff(10.0, 10.0 + height_px));
    at.press_at({150.0, 150.0});
    at.move_to({260.0, 150.0});
    const double fastest_px = MouseHandOptions{}.max_speed_mm_per_s / kPitch_mm * kTick_s;
    int at_wall = 0;
    double last = at.reading.goal_in_grid.z;
    double highest_above = -1e9;
    double most_rise = 0.0;
    for (int k = 0; k < 600; ++k) {
        const Vec2 before = at.proxy();
        at.tick();
        const double z = at.reading.goal_in_grid.z;
        const bool waits = at.felt.proxy.contact && before.x > 198.0 && at.proxy().x < 200.5;
        at_wall += waits ? 1 : 0;
        if (waits) CHECK(z >= last - 1e-9 - fastest_px);
        most_rise = std::max(most_rise, z - last);
        highest_above = std::max(highest_above, -at.below_px());
        last = z;
    }
    CHECK(at_wall <= 100);
    CHECK(most_rise <= fastest_px + 1e-9);
    CHECK(highest_above <= 1.0 + fastest_px);
    CHECK(at.felt.proxy.contact);
    CHECK(at.proxy().x > 240.0);
    CHECK(at.below_px() > 5.0);
}

TEST_CASE("a stroke falls off behind an edge, and presses on below it", "[mouse]") {
    Stroke at(cliff(170.0, 20.0));
    at.press_at({150.0, 150.0});
    at.move_to({260.0, 150.0});
    at.run(0.6);
    CHECK(at.felt.proxy.contact);
    CHECK(std::abs(at.felt.proxy.position.z - 20.0) < 1.0);
    CHECK(at.proxy().x > 235.0);
}

TEST_CASE("a slope is no wall: the hand stays pressed all the way up", "[mouse]") {
    const double slope = GENERATE(0.3, 0.7, 1.0);
    CAPTURE(slope);
    Stroke at({400, 300, [slope](int i, int) { return 0.6 * slope * i; }});
    at.press_at({60.0, 150.0});
    bool pressed = true;
    for (int k = 0; k < 1000; ++k) {
        at.move_to({60.0 + 0.2 * k, 150.0});
        at.tick();
        pressed = pressed && at.felt.proxy.contact && !at.reading.lifted;
    }
    CHECK(pressed);
}

TEST_CASE("of 200 strokes over outlines none stands for longer than 100 ms", "[mouse]") {
    std::mt19937 random(44);
    std::uniform_real_distribution<double> column(15.0, 385.0);
    std::uniform_real_distribution<double> row(15.0, 285.0);
    std::uniform_real_distribution<double> speed(150.0, 600.0);
    Stroke at(bodies());
    double longest_s = 0.0;
    for (int k = 0; k < 200; ++k) {
        const Vec2 from{column(random), row(random)};
        const Vec2 to{column(random), row(random)};
        longest_s = std::max(longest_s, longest_stand_s(at, from, to, speed(random)));
    }
    CHECK(longest_s <= 0.1);
}
