// What every force device gives as data.
#include "device/force_devices.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <variant>

#include "device/falcon/falcon_device.hpp"
#include "device/forcedimension/forcedimension_device.hpp"
#include "device/hand_device.hpp"
#include "device/inverse3/inverse3_device.hpp"
#include "device/openhaptics/openhaptics_device.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;

// What a value has to be, so that the file and the panel can be made of its row.

void check_value(const DeviceRow& row, const double* value) {
    CHECK(*value >= row.lowest);
    CHECK(*value <= row.highest);
    CHECK((row.topic.empty() || *row.format == '%' || std::string_view(row.format) == "x %.2f"));
    CHECK(row.panel_factor > 0.0);
}
void check_value(const DeviceRow& row, const int* value) {
    const double number = *value;
    CHECK(number >= row.lowest);
    CHECK(number <= row.highest);
}
void check_value(const DeviceRow& row, const std::string* value) {
    CHECK(static_cast<double>(value->size()) <= row.highest);
    CHECK(row.highest < 128.0);
}
void check_value(const DeviceRow&, const DeviceEnum& word) {
    CHECK(*word < word.names.size());
    CHECK(word.names.size() == word.labels.size());
}
template <typename Other>
void check_value(const DeviceRow&, const Other*) {}

}  // namespace

TEST_CASE("every force device has a name of its own, and does all that the program asks for",
          "[force_device]") {
    std::set<std::string> names{"auto", "mouse"};
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        CAPTURE(kind->name);
        CHECK(names.insert(kind->name).second);
        for (const char* const text :
             {kind->title, kind->short_name, kind->article, kind->which, kind->no_pose_advice})
            CHECK_FALSE(std::string(text).empty());
        const bool all = kind->make_settings != nullptr && kind->make != nullptr &&
                         kind->why_none != nullptr && kind->attached != nullptr &&
                         kind->survey != nullptr && kind->print_attached != nullptr;
        CHECK(all);
    }
}

TEST_CASE(
    "every value of a force device has a name of its own, a meaning, and a usual value that "
    "can be",
    "[force_device]") {
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        const auto settings = kind->make_settings();
        std::set<std::string_view> names;
        std::size_t buttons = 0;
        for (const DeviceRow& row : settings->rows()) {
            CAPTURE(kind->name, row.name);
            CHECK(names.insert(row.name).second);
            CHECK_FALSE(std::string(row.label).empty());
            CHECK(std::string(row.help).size() > 10);
            std::visit([&](const auto& value) { check_value(row, value); }, row.value);
            buttons += std::holds_alternative<ButtonAction*>(row.value) ? 1 : 0;
        }
        const auto idle =
            std::count(settings->buttons.begin(), settings->buttons.end(), ButtonAction::none);
        CHECK(buttons <= kDeviceButtonCount);
        // Every button with an action has a row.
        CHECK(buttons + static_cast<std::size_t>(idle) >= kDeviceButtonCount);
        CHECK(settings->limits() == usable(settings->limits()));
        CHECK(settings->limits().max_force_newton > 0.0);
        CHECK_FALSE(number_facts(*settings).empty());
    }
}

TEST_CASE("every value of a force device that people see has its heading on the panel",
          "[force_device]") {
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        CAPTURE(kind->name);
        const auto settings = kind->make_settings();
        std::set<std::string_view> headings;
        int placing = 0;
        for (const DeviceTopic& topic : settings->topics()) {
            CHECK(headings.insert(topic.name).second);
            placing += *topic.fit_help == '\0' ? 0 : 1;
        }
        CHECK(placing == 1);
        std::set<std::string_view> topics;
        for (const DeviceRow& row : settings->rows())
            if (!row.topic.empty()) topics.insert(row.topic);
        CHECK(topics == headings);
    }
}

TEST_CASE("a copy of all devices' settings has values of its own", "[force_device]") {
    AllDeviceSettings settings;
    const AllDeviceSettings usual = settings;
    REQUIRE(settings.size() == force_device_kinds().size());
    for (std::size_t k = 0; k < settings.size(); ++k) {
        CAPTURE(force_device_kinds()[k]->name);
        const double before = settings[k].scale();
        settings[k].fit({.columns = 3000, .rows = 2000, .relief_px = 100.0});
        settings[k].buttons.fill(ButtonAction::take_screenshot);
        CHECK(settings[k].scale() != before);
        CHECK(usual[k].scale() == before);
        CHECK(usual[k].buttons != settings[k].buttons);
    }
    AllDeviceSettings other;
    other = settings;
    for (std::size_t k = 0; k < settings.size(); ++k) {
        CHECK(other[k].scale() == settings[k].scale());
        CHECK(other[k].buttons == settings[k].buttons);
        other[k].buttons = usual[k].buttons;
        CHECK(other[k].buttons != settings[k].buttons);
    }
}

TEST_CASE("the panel gets a Falcon's firmware, progress, axes and lamp at their stages",
          "[force_device]") {
    const auto at = [](falcon::Stage stage) {
        falcon::Status status;
        status.stage = stage;
        status.loaded = 0.4;
        status.load_try = 2;
        status.reply.homed = 2;
        status.reply.encoder = {1, 2, 3};
        return state_of(status);
    };
    CHECK(at(falcon::Stage::no_firmware).firmware->needed);
    CHECK_FALSE(at(falcon::Stage::loading).firmware->needed);
    CHECK(at(falcon::Stage::loading).progress->text == "40 %, try 2");
    CHECK_FALSE(at(falcon::Stage::homing).progress);
    const DeviceState homing = at(falcon::Stage::homing);
    REQUIRE(homing.homing.size() == 3);
    CHECK_FALSE(homing.homing[0].homed);
    CHECK(homing.homing[1].homed);
    CHECK(homing.homing[2].counts == 3);
    CHECK(homing.pushing_lamp->colour == DeviceLamp::Colour::red);
    const DeviceState ready = at(falcon::Stage::ready);
    CHECK(ready.homing.empty());
    CHECK(ready.lamp->colour == DeviceLamp::Colour::blue);
    CHECK(ready.pushing_lamp->colour == DeviceLamp::Colour::green);
    CHECK(ready.lines.front().text == "0 per second");
    CHECK(at(falcon::Stage::looking).lines.empty());
}

TEST_CASE("the panel gets an Inverse3's service, and its exchange once it is ready",
          "[force_device]") {
    inverse3::Status status;
    status.version = "3.5.0";
    status.grip.emplace().battery = 0.5;
    REQUIRE(state_of(status).lines.size() == 1);
    CHECK(state_of(status).lines[0].text == "3.5.0");
    CHECK(state_of(status).name_line.text == "none attached");
    status.stage = inverse3::Stage::ready;
    status.id = "049D";
    status.exchange_ms = 0.26;
    PoseAges ages;
    ages.add(std::chrono::seconds(1));
    const DeviceState state = state_of(status, ages);
    CHECK(state.full_name == "Haply Inverse3 049D");
    REQUIRE(state.lines.size() == 5);
    CHECK(state.lines[1].text == "0 per second, 0.3 ms each");
    CHECK(state.lines[2].text == "20 ms or more, 99 % below 20 ms or more");
    CHECK(state.lines[3].text == "not known yet");
    CHECK(state.lines[4].text == "awake, battery 50 %");
}

TEST_CASE("one button takes the force off and one holds the point, and agreeing protects the first",
          "[force_device]") {
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        CAPTURE(kind->name);
        const auto settings = kind->make_settings();
        if (settings->buttons == ButtonActions{}) continue;  // a device without buttons
        CHECK(buttons_for(ButtonAction::clutch, settings->buttons) != 0);
        CHECK(buttons_for(ButtonAction::force_off, settings->buttons) != 0);
        for (const DeviceRow& row : settings->rows()) {
            const auto* const button = std::get_if<ButtonAction*>(&row.value);
            if (button == nullptr) continue;
            CHECK(row.protection.has_value() == (**button == ButtonAction::force_off));
        }
    }
}

TEST_CASE("sessions number the devices as they always have", "[force_device]") {
    const auto kinds = force_device_kinds();
    REQUIRE(kinds.size() >= 4);
    CHECK(std::string(kinds[0]->name) == "falcon");
    CHECK(std::string(kinds[1]->name) == "inverse3");
    CHECK(std::string(kinds[2]->name) == "forcedimension");
    CHECK(std::string(kinds[3]->name) == "openhaptics");
}

TEST_CASE("a device is named by its kind, or as one of it", "[force_device]") {
    for (const char* const name :
         {"auto", "mouse", "falcon", "falcon:A1", "inverse3", "inverse3:left",
          "forcedimension:1234", "openhaptics:Left one", "goals:a.csv"}) {
        CAPTURE(name);
        CHECK(names_device(name));
    }
    for (const char* const name :
         {"", "falcon:", "inverse3:", "goals:", "falcons", "inverse", "auto:A1", "mouse:1"}) {
        CAPTURE(name);
        CHECK_FALSE(names_device(name));
    }
    const std::string names = device_names();
    CHECK(names.starts_with("auto, falcon, falcon:SERIAL, inverse3, inverse3:ID, "));
    CHECK(names.ends_with(", mouse or goals:FILE"));
    const std::string meaning = meaning_of_auto();
    CHECK(meaning.starts_with(" (a Falcon or an Inverse3"));
    CHECK(meaning.ends_with(", and the mouse until one is there)"));
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        const std::string name = kind->name;
        CAPTURE(name);
        CHECK(names.find(", " + name + ", " + name + ":" + kind->which + ", ") !=
              std::string::npos);
        CHECK(meaning.find(kind->article) != std::string::npos);
        CHECK(names_device(name));
        CHECK(names_device(name + ":A1"));
        CHECK_FALSE(names_device(name + ":"));
    }
}

TEST_CASE("a device is absent, needs its person, or is ready, at each of its stages",
          "[force_device]") {
    const auto check = [](const DeviceState& state) {
        CAPTURE(state.stage);
        const int kinds_of_state =
            (state.absent ? 1 : 0) + (state.needs_person ? 1 : 0) + (state.ready ? 1 : 0);
        CHECK(kinds_of_state == 1);
        CHECK((state.may_be_ready || !state.ready));
        CHECK(state.sentence == "a sentence");
        CHECK(state.trouble);
        CHECK(state.presses[2] == 7U);
    };
    for (int k = 0; k <= static_cast<int>(falcon::Stage::ready); ++k) {
        falcon::Status status;
        status.stage = static_cast<falcon::Stage>(k);
        status.sentence = "a sentence";
        status.trouble = true;
        status.presses[2] = 7U;
        status.serial = "A1";
        check(state_of(status));
        CHECK(state_of(status).stage == k);
        CHECK(state_of(status).facts == DeviceFacts{{"serial", "A1"}});
    }
    for (int k = 0; k <= static_cast<int>(inverse3::Stage::ready); ++k) {
        inverse3::Status status;
        status.stage = static_cast<inverse3::Stage>(k);
        status.sentence = "a sentence";
        status.trouble = true;
        status.presses[2] = 7U;
        status.id = "049D";
        check(state_of(status));
        CHECK(state_of(status).stage == k);
        CHECK(state_of(status).facts[1] == DeviceFacts::value_type{"id", "049D"});
    }
    for (int k = 0; k <= static_cast<int>(forcedimension::Stage::ready); ++k) {
        forcedimension::Status status;
        status.stage = static_cast<forcedimension::Stage>(k);
        status.sentence = "a sentence";
        status.trouble = true;
        status.presses[2] = 7U;
        status.serial = "1234";
        status.type = 33;
        check(state_of(status));
        CHECK(state_of(status).stage == k);
        CHECK(state_of(status).full_name == "Force Dimension omega.3");
        CHECK(state_of(status).facts[2] == DeviceFacts::value_type{"serial", "1234"});
    }
    for (int k = 0; k <= static_cast<int>(openhaptics::Stage::ready); ++k) {
        openhaptics::Status status;
        status.stage = static_cast<openhaptics::Stage>(k);
        status.sentence = "a sentence";
        status.trouble = true;
        status.presses[2] = 7U;
        status.model = "Touch";
        status.serial = "12-3456";
        check(state_of(status));
        CHECK(state_of(status).stage == k);
        CHECK(state_of(status).full_name == "3D Systems Touch");
        CHECK(state_of(status).facts[3] == DeviceFacts::value_type{"serial", "12-3456"});
        // Where the library owns the device, no guardian can: that is said.
        CHECK(state_of(status).unguarded.empty() == state_of(status).absent);
    }
}
