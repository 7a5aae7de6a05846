// A touch session without a window: when a recording may begin, and what a replay leaves alone.
#include "app/touching/touch_session.hpp"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/session/session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/listed_media.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// A device whose goal stays a little below the middle of the surface.
class RestingHand final : public Device {
  public:
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return specification_;
    }
    HandReading read(const HandContext& context) noexcept override {
        const double x = 0.5 * context.surface.columns();
        const double y = 0.5 * context.surface.rows();
        return {.goal_in_grid = {x, y, context.surface.elevation_at(x, y) - 2.0}};
    }
    void send(Vec3) noexcept override {}

  private:
    DeviceSpecification specification_{.name = "a resting hand"};
};

Settings silent_settings() {
    Settings settings;
    settings.mute = true;
    settings.game_pad = false;
    return settings;
}

HandDevice resting_hand() {
    HandDevice hand;
    hand.device = std::make_unique<RestingHand>();
    return hand;
}

/// The state of a window, and the calls of a picture.
struct Touched {
    Touched() {
        std::vector<DepthImage> frames(2, image_of(32, 24, 255.0, [](int, int) { return 100.0; }));
        session.play(std::make_unique<ListedMedia>(std::move(frames), 0.04));
        session.start();
    }

    void show_picture() {
        heart.beat();
        static_cast<void>(session.poll(true));
        session.recording().poll();
        session.publish();
    }
    void show_until(const std::function<bool()>& is_so) {
        const bool came = eventually([&] {
            show_picture();
            return is_so();
        });
        REQUIRE(came);
    }
    void record(const std::filesystem::path& file) {
        session.recording().start(file);
        show_until([this] { return touch.recording && touch.recording->status.rows > 20; });
    }

    Settings settings{silent_settings()};
    TouchState touch{};
    MediaState media{};
    Heartbeat heart{};
    std::atomic<bool> without_force{false};
    CrashNote crash_note{};
    TouchSession session{
        resting_hand(), {heart, without_force, crash_note}, {settings, touch, media}};
};

}  // namespace

TEST_CASE("a recording begins only once the loop has seen the end of the last one",
          "[touching][recording]") {
    const TemporaryFolder folder;
    Touched window;
    window.show_until([&] { return window.session.may_record(); });
    window.record(folder / "first.dibhr");
    CHECK_FALSE(window.session.may_record());
    CHECK(window.session.recording().stop().find("Recorded ") == 0);
    window.session.publish();
    CHECK_FALSE(window.session.may_record());  // its last ticks may be on their way
    window.show_until([&] { return window.session.may_record(); });
    window.record(folder / "second.dibhr");
    static_cast<void>(window.session.recording().stop());
    CHECK(Session(folder / "first.dibhr").end_s() < Session(folder / "second.dibhr").begin_s());
}

TEST_CASE("after a session replay a recording begins, however long the loop before it ran",
          "[touching][recording]") {
    const TemporaryFolder folder;
    Touched window;
    window.record(folder / "before.dibhr");
    window.show_until([&] { return window.touch.haptic.ticks > 50; });
    static_cast<void>(window.session.recording().stop());
    REQUIRE(window.session.stop().has_value());
    window.touch.replay.emplace();
    window.show_picture();  // publishes nothing to a loop
    CHECK_FALSE(window.session.runs());
    window.touch.replay.reset();
    window.session.start();
    CHECK(window.touch.haptic.ticks == 0);
    CHECK_FALSE(window.session.may_record());
    window.show_until([&] {
        // Only ticks of this loop count: from the second one on.
        CHECK(window.session.may_record() == (window.touch.haptic.ticks > 1));
        return window.session.may_record();
    });
    window.record(folder / "after.dibhr");
    static_cast<void>(window.session.recording().stop());
    CHECK(Session(folder / "after.dibhr").rows() > 20);
}

TEST_CASE("the mouse touches only where there is one", "[touching]") {
    Touched window;
    CHECK_FALSE(window.session.by_mouse());
    window.show_until([&] { return window.touch.haptic.touchable; });
    CHECK(window.session.frames_now().makes_surface());
    CHECK(window.session.frames_now().nearest().media == window.session.media_number());
}

TEST_CASE("while it is asked which depth is right a hand in the surface gets no force",
          "[touching]") {
    Touched window;
    const auto sent_newton = [&window] {
        return glm::length(window.touch.haptic.touch.sent_force_newton);
    };
    window.show_until([&] { return sent_newton() > 0.0; });
    window.touch.depth_in_question = true;
    window.show_until([&] { return sent_newton() == 0.0; });
    const std::uint64_t ticks = window.touch.haptic.ticks;
    window.show_until([&] {
        CHECK(sent_newton() == 0.0);
        return window.touch.haptic.ticks > ticks + 100;
    });
    window.touch.depth_in_question = false;
    window.show_until([&] { return sent_newton() > 0.0; });
}
