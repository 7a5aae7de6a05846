// What the force switch and the text over the relief say where the force is held back.
#include <string>

#include "app/panels/panels.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

TEST_CASE("nothing holds the force back by itself", "[force]") {
    CHECK(why_held(ViewerState{}).empty());
}

TEST_CASE("the force is held while it is asked which depth is right, and while the answer is read",
          "[force]") {
    ViewerState state;
    state.ui.depth_question.emplace();
    state.touch.depth_in_question = true;
    CHECK(why_held(state) == "which depth is right?");
    state.ui.depth_question->answered = true;
    CHECK(why_held(state) == "reading the files again");
}

TEST_CASE("the force is held while the device is not ready, and not by a single late tick",
          "[force]") {
    ViewerState state;
    state.touch.haptic.touch.cut = SafetyCut::device_not_ready;
    CHECK(why_held(state) == "device not ready");
    state.touch.haptic.touch.cut = SafetyCut::late_tick;
    CHECK(why_held(state).empty());
}

TEST_CASE("in a replay no force is held back", "[force]") {
    ViewerState state;
    state.touch.haptic.touch.cut = SafetyCut::device_not_ready;
    state.touch.replay.emplace();
    CHECK(why_held(state).empty());
}
