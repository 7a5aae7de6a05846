// The Inverse3's settings.
#include "device/inverse3/settings.hpp"

#include <set>
#include <string>
#include <variant>

#include "app/settings/settings.hpp"
#include "tests/app/settings/own_settings.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using inverse3::Inverse3Settings;

TEST_CASE("every number of the Inverse3 has a name of its own, and a default within its range",
          "[inverse3][settings]") {
    std::set<std::string_view> names;
    Inverse3Settings standard;
    for (const DeviceRow& number : standard.rows()) {
        if (!std::holds_alternative<double*>(number.value)) continue;
        CAPTURE(number.name);
        CHECK(names.insert(number.name).second);
        CHECK(*std::get<double*>(number.value) >= number.lowest);
        CHECK(*std::get<double*>(number.value) <= number.highest);
    }
    CHECK(names.size() == 9);
}

TEST_CASE("what is set for the Inverse3 is kept, and reaches the device", "[inverse3][settings]") {
    const test::TemporaryFolder folder;
    const auto file = folder / "settings.toml";
    Settings settings;
    auto& own = test::own_settings<Inverse3Settings>(settings);
    own.device = "left";
    own.port = 12345;
    own.dialect = inverse3::Dialect::values;
    own.tuning.tilt_deg = 30.0;
    own.buttons[1] = ButtonAction::clutch;
    save_settings(settings, file);
    Settings loaded = load_settings(file);
    const auto& kept = test::own_settings<Inverse3Settings>(loaded);
    const inverse3::ConnectionOptions connection = connection_of(kept);
    CHECK(connection.device == "left");
    CHECK(connection.port == 12345);
    CHECK(connection.dialect == inverse3::ForceDialect::values);
    CHECK(connection.preset.view() == "defaults");
    const inverse3::Tuning tuning = tuning_of(kept, {2.5, 7});
    CHECK_THAT(tuning.tilt_deg, WithinAbs(30.0, 1e-12));
    CHECK_THAT(tuning.max_force_newton, WithinAbs(2.5, 1e-12));
    CHECK(tuning.clutch_buttons == 3);  // A by default, and B
    CHECK(tuning.centre_count == 7);
}
