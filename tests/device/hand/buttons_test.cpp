// The grip's buttons without their bounce.
#include "device/hand/buttons.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <random>

#include "tests/support/catch.hpp"

namespace {

using dibhr::ButtonDebounce;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using Presses = std::array<std::uint32_t, 4>;

/// Replies that come once a millisecond.
struct Replies {
    ButtonDebounce buttons{};
    ButtonDebounce::Time now{};

    Replies() { reply(0); }
    std::uint8_t reply(int raw) {
        now += milliseconds(1);
        return buttons.add(static_cast<std::uint8_t>(raw), now);
    }
    std::uint8_t hold(int raw, int replies) {
        for (int k = 0; k < replies; ++k) reply(raw);
        return buttons.steady();
    }
};

}  // namespace

TEST_CASE("a press is as old as the first reading in which its button was down", "[buttons]") {
    Replies grip;
    grip.hold(0, 5);
    const auto before = grip.now;
    grip.hold(2, 20);
    CHECK(grip.buttons.presses() == Presses{0, 1, 0, 0});
    CHECK(grip.buttons.pressed_at()[1] == before + milliseconds(1));
}

TEST_CASE("a button counts once it has been down for 8 ms, not before", "[buttons]") {
    const int bit = GENERATE(1, 2, 4, 8);
    Replies grip;
    grip.reply(0);
    for (int k = 0; k < 8; ++k) CHECK(grip.reply(bit) == 0);
    CHECK(grip.reply(bit) == bit);
    for (int k = 0; k < 8; ++k) CHECK(grip.reply(0) == bit);
    CHECK(grip.reply(0) == 0);
}

TEST_CASE("a press is counted once, when the button goes down", "[buttons]") {
    Replies grip;
    grip.hold(4, 500);
    CHECK(grip.buttons.presses() == Presses{0, 0, 1, 0});
    grip.hold(0, 20);
    CHECK(grip.buttons.presses() == Presses{0, 0, 1, 0});
    grip.hold(4 + 1, 20);
    CHECK(grip.buttons.presses() == Presses{1, 0, 2, 0});
}

TEST_CASE("bounces shorter than 8 ms neither press nor release", "[buttons]") {
    const int resting = GENERATE(0, 15);
    Replies grip;
    grip.hold(resting, 20);
    const Presses before = grip.buttons.presses();
    std::mt19937 random(1);
    for (int k = 0; k < 2000; ++k) {
        grip.hold(resting ^ 15, 1 + static_cast<int>(random() % 8));
        CHECK(grip.hold(resting, 1) == resting);
    }
    CHECK(grip.buttons.presses() == before);
}

TEST_CASE("each button is steadied by itself", "[buttons]") {
    Replies grip;
    for (int k = 0; k < 40; ++k) grip.reply(k % 2 == 0 ? 1 : 1 + 8);
    CHECK(grip.buttons.steady() == 1);
    CHECK(grip.buttons.presses() == Presses{1, 0, 0, 0});
}

TEST_CASE("time counts, not the number of replies", "[buttons]") {
    ButtonDebounce buttons;
    ButtonDebounce::Time now{};
    for (int k = 0; k < 79; ++k) CHECK(buttons.add(2, now += microseconds(100)) == 0);
    buttons.add(2, now += microseconds(200));
    CHECK(buttons.steady() == 2);
}

TEST_CASE("time that runs backwards presses nothing", "[buttons]") {
    ButtonDebounce buttons;
    const ButtonDebounce::Time late{milliseconds(1000)};
    buttons.add(1, late);
    CHECK(buttons.add(1, late - milliseconds(500)) == 0);
    CHECK(buttons.add(1, late - milliseconds(495)) == 0);
    CHECK(buttons.add(1, late - milliseconds(492)) == 1);
}

TEST_CASE("a lost device holds no button, and what was pressed stays counted", "[buttons]") {
    Replies grip;
    grip.hold(3, 20);
    grip.hold(12, 5);
    grip.buttons.release();
    CHECK(grip.buttons.steady() == 0);
    CHECK(grip.buttons.presses() == Presses{1, 1, 0, 0});
    grip.hold(0, 1);
    CHECK(grip.hold(15, 8) == 0);
    CHECK(grip.hold(15, 2) == 15);
    CHECK(grip.buttons.presses() == Presses{2, 2, 1, 1});
}

TEST_CASE("a button that is held while a device is linked is down, but was not pressed",
          "[buttons]") {
    ButtonDebounce buttons;
    ButtonDebounce::Time now{};
    const auto hold = [&](int raw, int replies) {
        for (int k = 0; k < replies; ++k) {
            buttons.add(static_cast<std::uint8_t>(raw), now += milliseconds(1));
        }
        return buttons.steady();
    };
    const bool linked_before = GENERATE(false, true);
    CAPTURE(linked_before);
    if (linked_before) {
        hold(0, 1);
        hold(4, 20);
        CHECK(buttons.presses() == Presses{0, 0, 1, 0});
        buttons.release();
    }
    const Presses before = buttons.presses();
    CHECK(hold(4, 8) == 0);
    CHECK(hold(4, 2) == 4);
    CHECK(buttons.presses() == before);
    CHECK(hold(4 + 1, 20) == 4 + 1);  // another one, pressed meanwhile
    CHECK(buttons.presses() == Presses{1, 0, before[2], 0});
    hold(0, 20);
    CHECK(hold(4, 20) == 4);
    CHECK(buttons.presses() == Presses{1, 0, before[2] + 1, 0});
}

TEST_CASE("bits that are no button are none", "[buttons]") {
    Replies grip;
    CHECK(grip.hold(0xF0, 50) == 0);
}
