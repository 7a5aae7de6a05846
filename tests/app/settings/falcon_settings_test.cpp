// The Falcon's settings, and the actions of its buttons.
#include <cstdint>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "app/settings/button_action_names.hpp"
#include "app/settings/settings.hpp"
#include "device/falcon/packet.hpp"
#include "device/falcon/settings.hpp"
#include "device/force_devices.hpp"
#include "tests/app/settings/own_settings.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using falcon::Button;
using falcon::FalconSettings;

namespace {

/// The settings rows that are numbers.
std::vector<DeviceRow> numbers_of(FalconSettings& settings) {
    std::vector<DeviceRow> rows = settings.rows();
    std::erase_if(rows,
                  [](const DeviceRow& row) { return !std::holds_alternative<double*>(row.value); });
    return rows;
}

double& value_of(const DeviceRow& number) {
    return *std::get<double*>(number.value);
}

std::uint8_t bit(Button button) {
    return static_cast<std::uint8_t>(button);
}

std::string line_of(const DeviceRow& number, double value) {
    std::ostringstream line;
    line << "[falcon]\n" << number.name << " = " << std::fixed << value << "\n";
    return line.str();
}

Settings loaded(const std::string& text, std::vector<std::string>& warnings) {
    const TemporaryFolder folder;
    std::ofstream(folder / "settings.toml") << text;
    return load_settings(folder / "settings.toml", warnings);
}

}  // namespace

TEST_CASE("what is kept about the Falcon comes back exactly, whatever its serial is",
          "[falcon][settings]") {
    const TemporaryFolder folder;
    Settings settings;
    auto& own = own_settings<FalconSettings>(settings);
    own.connection = {GENERATE("", "SIM00001", "a \"b\" \\c\n\u00fc"), GENERATE(false, true),
                      GENERATE(false, true)};
    own.buttons = {ButtonAction::none, ButtonAction::clutch, ButtonAction::clutch,
                   ButtonAction::take_screenshot};
    settings.force_in_front_only = false;
    for (const DeviceRow& number : numbers_of(own)) {
        value_of(number) = number.lowest + 0.123456789 * (number.highest - number.lowest);
    }
    save_settings(settings, folder / "settings.toml");
    std::vector<std::string> warnings;
    Settings back = load_settings(folder / "settings.toml", warnings);
    CHECK(warnings.empty());
    CHECK(same_settings(back, settings));
    CHECK(own_settings<FalconSettings>(back).connection.serial == own.connection.serial);
    CHECK_FALSE(same_settings(back, Settings{}));
    CHECK(back.devices.size() == force_device_kinds().size());
}

TEST_CASE("each number of the Falcon has its own name, a help, and a default inside its range",
          "[falcon][settings]") {
    std::set<std::string> names;
    FalconSettings usual;
    for (const DeviceRow& number : numbers_of(usual)) {
        CAPTURE(number.name);
        CHECK(names.emplace(number.name).second);
        CHECK(std::string(number.help).size() > 10);
        CHECK(value_of(number) >= number.lowest);
        CHECK(value_of(number) <= number.highest);
    }
    CHECK(names.size() == 10 + 2 + 7);  // Geometry, Motors, WorkspaceOptions
}

TEST_CASE("a number of the Falcon out of its range keeps its default and is told with its line",
          "[falcon][settings]") {
    FalconSettings usual;
    for (const DeviceRow& number : numbers_of(usual)) {
        const double span = number.highest - number.lowest;
        for (const double wrong : {number.lowest - 0.5 * span, number.highest + 0.5 * span}) {
            CAPTURE(number.name, wrong);
            std::vector<std::string> warnings;
            const Settings settings = loaded(line_of(number, wrong), warnings);
            CHECK(same_settings(settings, Settings{}));
            REQUIRE(warnings.size() == 1);
            CHECK(warnings[0].find("settings.toml:2: falcon." + std::string(number.name)) !=
                  std::string::npos);
        }
    }
}

TEST_CASE("a button keeps its job when the file asks for one that there is not",
          "[falcon][settings]") {
    const std::string wrong = GENERATE("button-plus = \"dance\"", "button-plus = 3", "serial = 7",
                                       "button-up = \"none\"");
    CAPTURE(wrong);
    std::vector<std::string> warnings;
    CHECK(same_settings(loaded("[falcon]\n" + wrong + "\n", warnings), Settings{}));
    CHECK(warnings.size() == 1);
}

TEST_CASE("every job of a button is found by its name", "[falcon][buttons]") {
    for (const ButtonJob& job : button_jobs()) {
        CHECK(std::string_view(job.name) == name_of(job.value));
        CHECK(button_action_named(job.name) == job.value);
    }
    CHECK_FALSE(button_action_named("dance"));
}

TEST_CASE("the clutch is the centre button, and wherever else it is wished", "[falcon][buttons]") {
    CHECK(buttons_for(ButtonAction::clutch, FalconSettings{}.buttons) == bit(Button::centre));
    CHECK(buttons_for(ButtonAction::clutch, {}) == 0);
    const ButtonActions two{ButtonAction::clutch, ButtonAction::none, ButtonAction::record,
                            ButtonAction::clutch};
    CHECK(buttons_for(ButtonAction::clutch, two) == (bit(Button::plus) | bit(Button::minus)));
}
