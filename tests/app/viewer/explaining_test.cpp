// Explain: what its keys do, and that its steps are the update that a hand would have made.
#include "app/viewer/explaining.hpp"

#include <memory>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/dibhr.hpp"
#include "core/video/playing/player.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

/// A hand that touches a ground of slopes.
class ExplainedScene {
  public:
    ExplainedScene() {
        frame_.depth =
            std::make_shared<const DepthImage>(image_of(kSide, kSide, 255.0, [](int i, int j) {
                return 90.0 + 0.2 * i + 0.1 * ((3 * i + 5 * j) % 11);
            }));
        state_.media.depth_columns = state_.media.depth_rows = kSide;
        state_.settings.touch.friction = {0.2, 0.1};
        state_.touch.haptic.touchable = true;
        state_.touch.haptic.shape = state_.settings.touch.shape;
        camera_.frame_relief(kSide, kSide, 255.0);
        move_hand({10.0, 10.0, 120.0});
        move_hand({10.3, 10.2, 80.0});
    }

    /// One update, as the loop makes it.
    void move_hand(Vec3 goal) {
        state_.touch.haptic.touch.goal = goal;
        state_.touch.haptic.touch.proxy =
            hand_.update(surface(), goal, state_.settings.touch.friction);
    }

    /// The result of an update to that goal, without making it.
    [[nodiscard]] Proxy if_moved(Vec3 goal) const {
        Dibhr other = hand_;
        return other.update(surface(), goal, state_.settings.touch.friction);
    }

    std::optional<Answer> press(Action action) {
        return explaining_.perform(action, state_, player_, nullptr);
    }
    const ExplainedInfo& show(double now_s = 0.0) {
        explaining_.advance(blend(), state_, camera_, now_s);
        return *state_.ui.explained;
    }
    ViewerState& state() { return state_; }
    [[nodiscard]] glm::dmat4 view() const { return camera_.clip_from_grid(1.5); }
    void keep_camera() { explaining_.keep_camera(); }
    void finish() { explaining_.advance(blend(), state_, camera_, 0.0); }

  private:
    static constexpr int kSide = 40;

    [[nodiscard]] DepthBlend blend() const { return {&frame_, &frame_, 0.0}; }
    [[nodiscard]] DepthSurface surface() const { return blend().surface(state_.shape()); }

    Frame frame_{};
    ViewerState state_{};
    Camera camera_{};
    Player player_{};
    Dibhr hand_{};
    ViewerExplaining explaining_{};
};

bool ends_as(const ExplainedInfo& info, const Proxy& proxy) {
    const Proxy& result = info.update.result;
    return result.position == proxy.position && result.active == proxy.active &&
           result.moves == proxy.moves;
}

}  // namespace

TEST_CASE("Explain shows the update from where the proxy was to where the hand presses",
          "[explain]") {
    ExplainedScene scene;
    const Vec3 to(24.0, 17.0, 84.0);
    const Proxy expected = scene.if_moved(to);
    REQUIRE(scene.press(Action::explain));
    scene.move_hand(to);
    const ExplainedInfo& info = scene.show();
    CHECK(ends_as(info, expected));
    CHECK(info.update.steps.size() > 10);
    CHECK(info.taken == 0);

    scene.move_hand({24.0, 17.0, 200.0});  // lifted: the goal stays where it was pressed
    CHECK(ends_as(scene.show(), expected));
}

TEST_CASE("from the first step on the goal stays, and steps go forth and back", "[explain]") {
    ExplainedScene scene;
    REQUIRE(scene.press(Action::explain));
    scene.move_hand({24.0, 17.0, 84.0});
    const Proxy expected = scene.show().update.result;
    scene.press(Action::step_forward);
    scene.press(Action::step_forward);
    scene.move_hand({5.0, 30.0, 84.0});
    CHECK(ends_as(scene.show(), expected));
    CHECK(scene.show().taken == 2);
    scene.press(Action::step_back);
    CHECK(scene.show().taken == 1);
    for (int k = 0; k < 200; ++k) scene.press(Action::step_forward);
    CHECK(scene.show().taken == scene.show().update.steps.size());
    for (int k = 0; k < 200; ++k) scene.press(Action::step_back);
    CHECK_FALSE(scene.show().held);  // the hand may choose another goal
    CHECK_FALSE(ends_as(scene.show(), expected));
}

TEST_CASE("in slow motion the steps are taken one after the other, and it stops after the last",
          "[explain]") {
    ExplainedScene scene;
    scene.press(Action::explain);
    scene.move_hand({24.0, 17.0, 84.0});
    scene.show(1.0);
    scene.press(Action::play_or_pause);
    std::size_t before = 0;
    for (double now_s = 1.0; now_s < 30.0; now_s += 0.1) {
        const std::size_t taken = scene.show(now_s).taken;
        CHECK(taken - before <= 1);
        before = taken;
    }
    CHECK(before == scene.show(40.0).update.steps.size());
    CHECK_FALSE(scene.show(40.0).runs);
}

TEST_CASE("at its end the view is as before, and Esc ends it after what lies on top", "[explain]") {
    ExplainedScene scene;
    const glm::dmat4 before = scene.view();
    scene.press(Action::explain);
    scene.show();
    CHECK(scene.view() != before);
    scene.state().ui.message = "That did not work";
    CHECK_FALSE(scene.press(Action::close_topmost));
    scene.state().ui.message.clear();
    CHECK(scene.press(Action::close_topmost));
    scene.finish();
    CHECK_FALSE(scene.state().ui.explained);
    CHECK(scene.view() == before);
    CHECK_FALSE(scene.press(Action::step_forward));
}

TEST_CASE("at its end the view stays where a person took it meanwhile", "[explain]") {
    ExplainedScene scene;
    scene.press(Action::explain);
    scene.show();
    const glm::dmat4 there = scene.view();
    scene.keep_camera();
    scene.press(Action::explain);
    scene.finish();
    CHECK(scene.view() == there);
}

TEST_CASE("without a surface nothing is explained, and it says so", "[explain]") {
    ExplainedScene scene;
    scene.state().touch.haptic.touchable = false;
    const auto answer = scene.press(Action::explain);
    REQUIRE(answer);
    CHECK(answer->words.find("No surface") == 0);
    CHECK_FALSE(scene.state().ui.explained);
}
