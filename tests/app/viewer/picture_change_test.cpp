// When a window draws its next picture.
#include "app/viewer/picture_change.hpp"

#include <chrono>

#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace std::chrono_literals;

namespace {

SceneMark scene_with_hand_at(double x) {
    SceneMark scene;
    scene.markers.goal = {x, 0.0, 0.0};
    return scene;
}

}  // namespace

TEST_CASE("while a video runs a hand that moves waits for its next frame, but not for a late one",
          "[rest]") {
    const PanelChanges runs{.video_runs = true};
    const PictureChange::Time begin{1h};
    PictureChange change;
    const auto is_drawn = [&](const SceneMark& scene, PictureChange::Time now) {
        const SceneMark mark = change.with_drawn_hand(scene, now);
        return change.may_differ(mark, runs, now) && change.take({mark, 0}, now);
    };
    REQUIRE(is_drawn(scene_with_hand_at(1.0), begin));
    CHECK_FALSE(is_drawn(scene_with_hand_at(2.0), begin + 50ms));
    SceneMark next = scene_with_hand_at(3.0);
    next.blend = 0.5;
    CHECK(is_drawn(next, begin + 60ms));
    // The frame after it does not come.
    next.markers.goal.x = 4.0;
    CHECK_FALSE(is_drawn(next, begin + 150ms));
    CHECK(is_drawn(next, begin + 170ms));
    CHECK_FALSE(is_drawn(next, begin + 180ms));
    CHECK_FALSE(is_drawn(next, begin + 10s));
}

TEST_CASE("after input the panels are laid out in each turn, also while a video runs", "[rest]") {
    const SceneMark scene = scene_with_hand_at(1.0);
    const PictureChange::Time begin{1h};
    for (const bool runs : {false, true}) {
        PictureChange change;
        REQUIRE(change.take({scene, 0}, begin));
        REQUIRE_FALSE(change.take({scene, 0}, begin + 1s));
        CHECK_FALSE(change.may_differ(scene, {.video_runs = runs}, begin + 1100ms));
        CHECK(change.may_differ(scene, {.input = true, .video_runs = runs}, begin + 1110ms));
        CHECK(change.may_differ(scene, {.video_runs = runs}, begin + 1150ms));
        CHECK_FALSE(change.take({scene, 0}, begin + 1400ms));
        CHECK_FALSE(change.may_differ(scene, {.video_runs = runs}, begin + 1500ms));
    }
}

TEST_CASE("where pictures give way to frames they are as far apart as asked, but for a person",
          "[rest]") {
    const PictureChange::Time begin{1h};
    PictureChange change;
    CHECK_FALSE(change.waits(10.0, {}, begin));  // none is drawn yet
    REQUIRE(change.take({}, begin));
    CHECK(change.waits(10.0, {}, begin + 90ms));
    CHECK_FALSE(change.waits(10.0, {}, begin + 110ms));
    CHECK_FALSE(change.waits(0.0, {}, begin + 1ms));
    CHECK_FALSE(change.waits(10.0, {.in_use = true}, begin + 1ms));
    const PanelChanges typed{.input = true};
    CHECK_FALSE(change.waits(10.0, typed, begin + 1ms));
    REQUIRE(change.may_differ({}, typed, begin + 1ms));
    CHECK_FALSE(change.waits(10.0, {}, begin + 2ms));  // a panel may answer
}
