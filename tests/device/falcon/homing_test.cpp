// When poses may be trusted, and when a person needs a hint.
#include "device/falcon/homing_watch.hpp"

#include <chrono>
#include <cstdint>
#include <string>

#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::falcon;
using dibhr::Epoch;
using dibhr::kNoEpoch;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// A watch that gets a reply every millisecond.
struct Replies {
    HomingWatch watch{};
    HomingWatch::Time now{};

    Replies() { watch.begin(now); }
    void come(std::uint8_t homed, Counts encoder = {}, milliseconds how_long = milliseconds(1)) {
        for (auto left = how_long; left > milliseconds(0); left -= milliseconds(1)) {
            now += milliseconds(1);
            watch.add({.encoder = encoder, .buttons = 0, .homed = homed}, now);
        }
    }
};

constexpr std::uint8_t kAll = 7;

}  // namespace

TEST_CASE("poses count from the second reply in a row with all three axes homed", "[homing]") {
    Replies replies;
    replies.come(0);
    replies.come(3);
    CHECK_FALSE(replies.watch.ready());
    replies.come(kAll);
    CHECK_FALSE(replies.watch.ready());
    CHECK(replies.watch.epoch() == kNoEpoch);
    replies.come(kAll);
    CHECK(replies.watch.ready());
    CHECK(replies.watch.epoch() != kNoEpoch);
}

TEST_CASE("a single reply that seems homed makes nothing ready", "[homing]") {
    Replies replies;
    const auto others = static_cast<std::uint8_t>(GENERATE(0, 1, 2, 3, 4, 5, 6));
    for (int k = 0; k < 20; ++k) {
        replies.come(kAll);
        CHECK_FALSE(replies.watch.ready());
        replies.come(others);
    }
}

TEST_CASE("a lost axis ends it at once, and every homing and every link is another epoch",
          "[homing]") {
    Replies replies;
    replies.come(kAll, {}, milliseconds(10));
    const Epoch first = replies.watch.epoch();
    replies.come(5);
    CHECK_FALSE(replies.watch.ready());
    replies.come(kAll, {}, milliseconds(2));
    const Epoch second = replies.watch.epoch();
    CHECK(second != first);
    CHECK(second != kNoEpoch);
    replies.watch.begin(replies.now);
    CHECK_FALSE(replies.watch.ready());
    replies.come(kAll, {}, milliseconds(2));
    CHECK(replies.watch.epoch() != second);
    CHECK(replies.watch.epoch() != kNoEpoch);
}

TEST_CASE("without a motion and without a homed axis it is idle after twenty seconds", "[homing]") {
    Replies replies;
    replies.come(0, {10, -3, 7}, milliseconds(19'900));
    CHECK_FALSE(replies.watch.idle(replies.now));
    SECTION("an encoder's tremble is no motion") {
        replies.come(0, {11, -4, 7}, milliseconds(200));
        CHECK(replies.watch.idle(replies.now));
    }
    SECTION("a motion begins the time anew") {
        replies.come(0, {10, 97, 7}, milliseconds(200));
        CHECK_FALSE(replies.watch.idle(replies.now));
        replies.come(0, {10, 97, 7}, seconds(20));
        CHECK(replies.watch.idle(replies.now));
    }
    SECTION("so does a homed axis") {
        replies.come(4, {10, -3, 7}, milliseconds(200));
        CHECK_FALSE(replies.watch.idle(replies.now));
    }
}

TEST_CASE("a homed Falcon is never idle, however long it rests", "[homing]") {
    Replies replies;
    replies.come(kAll, {1, 2, 3}, seconds(30));
    CHECK_FALSE(replies.watch.idle(replies.now));
}

TEST_CASE("the way to home says how many axes are done", "[homing]") {
    CHECK(homed_axes(0) == 0);
    CHECK(homed_axes(5) == 2);
    CHECK(homed_axes(kAll) == 3);
    CHECK(how_to_home(2).find("2 of 3") != std::string::npos);
    CHECK(how_to_home(0).find("pull the grip") != std::string::npos);
}
