// What is kept about the Inverse3.
#include "app/settings/inverse3_settings.hpp"

#include <set>
#include <string>

#include "app/panels/device_state.hpp"
#include "app/settings/settings.hpp"
#include "device/device_or_mouse.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

TEST_CASE("every number of the Inverse3 has a name of its own, and a default within its range",
          "[inverse3][settings]") {
    std::set<std::string_view> names;
    Inverse3Settings standard;
    for (const Inverse3Number& number : inverse3_numbers()) {
        CAPTURE(number.name);
        CHECK(names.insert(number.name).second);
        CHECK(number.in(standard) >= number.lowest);
        CHECK(number.in(standard) <= number.highest);
    }
    CHECK(names.size() == 9);
}

TEST_CASE("what is set for the Inverse3 is kept, and reaches the device", "[inverse3][settings]") {
    const test::TemporaryFolder folder;
    const auto file = folder / "settings.toml";
    Settings settings;
    settings.inverse3.device = "left";
    settings.inverse3.port = 12345;
    settings.inverse3.dialect = Dialect::values;
    settings.inverse3.tuning.tilt_deg = 30.0;
    settings.inverse3.buttons[1] = ButtonAction::clutch;
    save_settings(settings, file);
    const Settings kept = load_settings(file);
    const inverse3::ConnectionOptions connection = connection_of(kept.inverse3);
    CHECK(connection.device == "left");
    CHECK(connection.port == 12345);
    CHECK(connection.dialect == inverse3::ForceDialect::values);
    CHECK(connection.preset.view() == "defaults");
    const inverse3::Tuning tuning = tuning_of(kept.inverse3, 2.5, 7);
    CHECK_THAT(tuning.tilt_deg, WithinAbs(30.0, 1e-12));
    CHECK_THAT(tuning.max_force_newton, WithinAbs(2.5, 1e-12));
    CHECK(tuning.clutch_buttons == 3);  // A from the start, and B
    CHECK(tuning.centred == 7);
}

TEST_CASE("the window says over the relief what an Inverse3 that is there lacks",
          "[inverse3][banner]") {
    ViewerState state;
    inverse3::Status& status = state.inverse3.emplace().status;
    status.sentence = "do this";
    CHECK(device_banner(state).empty());  // no service, and nobody asked for one
    CHECK_FALSE(inverse3_in_sight(state));
    status.stage = inverse3::Stage::no_device;
    CHECK(device_banner(state).empty());
    status.stage = GENERATE(inverse3::Stage::no_power, inverse3::Stage::not_calibrated,
                            inverse3::Stage::locked, inverse3::Stage::in_use, inverse3::Stage::deaf,
                            inverse3::Stage::too_old, inverse3::Stage::not_understood);
    CHECK(device_banner(state) == "do this");
    CHECK(inverse3_in_sight(state));
    status.stage = inverse3::Stage::ready;
    CHECK(device_banner(state).empty());
}

TEST_CASE("what the Falcon lacks is not said while an Inverse3 touches", "[inverse3][banner]") {
    ViewerState state;
    state.falcon.emplace().status.stage = falcon::Stage::homing;
    state.falcon->status.sentence = "pull it out";
    state.inverse3.emplace().status.stage = inverse3::Stage::ready;
    CHECK(device_banner(state) == "pull it out");
    state.haptic.hand.which = static_cast<std::uint8_t>(Touching::inverse3);
    CHECK(device_banner(state).empty());
    state.haptic.hand.buttons = 1;
    CHECK(clutched(state));  // its own button A, not the Falcon's
}
