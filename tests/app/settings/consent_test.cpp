// Settings, estimators and studies of others: what needs the user's consent.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/settings/consent.hpp"
#include "app/settings/study_values.hpp"
#include "app/viewer/files.hpp"
#include "app/viewer/input.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "device/falcon/settings.hpp"
#include "tests/app/settings/own_settings.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// A machine on which nobody has agreed to anything.
struct Machine {
    TemporaryFolder folder{};
    EnvironmentVariable home{"XDG_STATE_HOME", folder.path().c_str()};
    Consent consent{};

    [[nodiscard]] Settings file(const std::string& text) const {
        write_text(folder / "settings.toml", text);
        std::vector<std::string> warnings;
        Settings settings = load_settings(folder / "settings.toml", warnings);
        CHECK(warnings.empty());
        return settings;
    }
};

std::vector<std::string> records_of(const std::vector<UnsafeSetting>& unsafe_settings) {
    std::vector<std::string> records;
    for (const UnsafeSetting& doubt : unsafe_settings) records.push_back(doubt.record);
    return records;
}

Protocol study_with(const TouchValues& values, const std::string& varied = {}) {
    Protocol protocol;
    protocol.conditions = {{.name = "usual"}, {.name = "other", .values = values}};
    protocol.blocks.resize(1);
    protocol.blocks[0].variation.parameter = varied;
    return protocol;
}

}  // namespace

TEST_CASE("what protects the hand less in a file of others is held until a person agrees, once",
          "[consent]") {
    const auto [table, value] = GENERATE(Catch::Generators::table<std::string, std::string>(
        {{"device", "max-force = 8.0"},
         {"device", "max-force = 4.001"},
         {"touch", "stability = false"},
         {"touch", "damping-as-needed = false"},
         {"falcon", "force-in-front-only = false"},
         {"falcon", "button-minus = \"record\""},
         {"falcon", "button-minus = \"none\""},
         {"inverse3", "button-b = \"toggle-force\""},
         {"falcon", "boundary-stiffness = 0.0"},
         {"falcon", "boundary-stiffness = 0.29"},
         {"falcon", "radius = 55.0"},
         {"falcon", "centre-z = 150.0"},
         {"falcon", "gear = 4.0"},
         {"falcon", "angle-at-zero = 70.0"},
         {"falcon", "thigh = 0.09"},
         {"falcon", "shin = 0.07"},
         {"falcon", "shin-end-d = 0.0"},
         {"falcon", "shin-end-e = 0.03"},
         {"falcon", "platform-radius = 0.03"},
         {"falcon", "base-radius = 0.06"},
         {"falcon", "platform-shift = 0.04"},
         {"falcon", "base-shift = -0.04"}}));
    CAPTURE(table, value);
    const Machine machine;
    const Settings requested = machine.file('[' + table + "]\n" + value + '\n');
    Settings held = requested;
    const std::vector<UnsafeSetting> unsafe_settings = machine.consent.replace_unsafe(held);
    REQUIRE(unsafe_settings.size() == 1);
    CHECK(same_settings(held, Settings{}));
    CHECK(unsafe_settings[0].usual != unsafe_settings[0].requested);
    CHECK_FALSE(unsafe_settings[0].what.empty());
    const std::string told = warning_text(unsafe_settings, "sent.toml");
    CHECK(
        contains(told, unsafe_settings[0].requested + " in place of " + unsafe_settings[0].usual));
    copy_unsafe(unsafe_settings, requested, held);
    CHECK(same_settings(held, requested));
    machine.consent.agree(unsafe_settings);
    CHECK(Consent().replace_unsafe(held).empty());
    CHECK(same_settings(held, requested));
}

TEST_CASE("what protects the hand as usual or more, or has nothing to do with it, is not asked",
          "[consent]") {
    const std::string text =
        GENERATE(as<std::string>(), "", "[device]\nmax-force = 4.0\n", "[device]\nmax-force = 0\n",
                 "[falcon]\nradius = 20.0\nboundary-stiffness = 0.5\n",
                 "[falcon]\ncounts-per-newton-metre = 3600.0\nfull-scale-counts = 1000.0\n",
                 "[falcon]\nbutton-plus = \"force-off\"\nscale = 4.0\n",
                 "[touch]\nstiffness = 10.0\ndamping = 100.0\nmaterial = \"bark\"\n");
    const Machine machine;
    const Settings requested = machine.file(text);
    Settings held = requested;
    CHECK(machine.consent.replace_unsafe(held).empty());
    CHECK(same_settings(held, requested));
}

TEST_CASE("who agreed to a limit agreed to lower ones, and is asked about higher ones",
          "[consent]") {
    const Machine machine;
    const auto doubted = [&](const char* newton) {
        Settings settings = machine.file(std::string("[device]\nmax-force = ") + newton + "\n");
        return machine.consent.replace_unsafe(settings);
    };
    machine.consent.agree(doubted("6.5"));
    CHECK(doubted("6.5").empty());
    CHECK(doubted("5").empty());
    CHECK(doubted("6.6").size() == 1);
    CHECK(read_text(consent_path()) ==
          "# Agreed to on this machine. Delete a line to be asked.\ndevice.max-force 6.5\n");
}

TEST_CASE("everything that turns a force into what the Falcon's motors do is asked about",
          "[consent]") {
    Settings all;
    for (const DeviceRow& row : own_settings<falcon::FalconSettings>(all).rows()) {
        double* const* const number = std::get_if<double*>(&row.value);
        const bool of_motors =
            row.name == "counts-per-newton-metre" || row.name == "full-scale-counts";
        if (number != nullptr && row.topic == "Calibration" && !of_motors)
            **number = row.lowest + 0.37 * (row.highest - row.lowest);
    }
    for (std::size_t k = 0; k < all.devices.size(); ++k) {
        ButtonActions& actions = all.devices[k].buttons;
        std::replace(actions.begin(), actions.end(), ButtonAction::force_off, ButtonAction::none);
    }
    const Settings usual;
    std::size_t changed = 0;
    Settings first = usual;
    Settings second = all;
    for (std::size_t k = 0; k < all_settings(first).size(); ++k)
        changed += same(all_settings(first)[k], all_settings(second)[k]) ? 0 : 1;
    CHECK(changed > 10);
    CHECK(Machine().consent.replace_unsafe(second).size() == changed);
}

TEST_CASE("a record that is damaged or not there means that nobody has agreed", "[consent]") {
    const Machine machine;
    const std::string record =
        GENERATE(as<std::string>(), "", "device.max-force\n", "device.max-force nan\n",
                 "device.max-force inf\n", "device.max-force 1e999\n", "device.max-force 8 N\n",
                 " device.max-force 8\n", "device.max-force8\n", "touch.max-force 8\n",
                 "max-force 8\n", "\xff\x00\n");
    CAPTURE(record);
    std::filesystem::create_directories(consent_path().parent_path());
    write_text(consent_path(), record);
    Settings settings = machine.file("[device]\nmax-force = 8.0\n");
    CHECK(machine.consent.replace_unsafe(settings).size() == 1);
}

TEST_CASE("what a person changes in the window is their word, and is not asked about later",
          "[consent]") {
    const Machine machine;
    const auto file = machine.folder / "settings.toml";
    const Settings in_file = machine.file("[touch]\nstability = false\n");
    Settings started = in_file;
    std::vector<UnsafeSetting> unsafe_settings = machine.consent.replace_unsafe(started);
    REQUIRE(unsafe_settings.size() == 1);
    TaskGroup tasks;
    TaskQueue writing(tasks);
    SettingsSaver keeper(in_file, started, file, writing);
    Settings now = started;
    now.max_force_newton = 7.0;
    now.force_in_front_only = false;
    keeper.finish(now);
    writing.finish(std::chrono::seconds(60));
    Settings next = load_settings(file);
    CHECK_FALSE(next.stability);  // the file's value, to be asked about again
    CHECK(records_of(machine.consent.replace_unsafe(next)) ==
          std::vector<std::string>{"touch.stability false"});
    CHECK(next.max_force_newton > 6.9);
    CHECK_FALSE(next.force_in_front_only);
}

TEST_CASE("a value of the file that a person sets in the window is their word, too", "[consent]") {
    const Machine machine;
    const auto file = machine.folder / "settings.toml";
    const Settings in_file = machine.file("[device]\nmax-force = 8.0\n");
    Settings started = in_file;
    REQUIRE(machine.consent.replace_unsafe(started).size() == 1);
    TaskGroup tasks;
    TaskQueue writing(tasks);
    SettingsSaver keeper(in_file, started, file, writing);
    Settings now = started;
    now.max_force_newton = in_file.max_force_newton;
    keeper.finish(now);
    writing.finish(std::chrono::seconds(60));
    Settings next = load_settings(file);
    CHECK(machine.consent.replace_unsafe(next).empty());
}

TEST_CASE("words that are given at once are all kept", "[consent]") {
    const Machine machine;
    constexpr int kEach = 20;
    std::vector<std::thread> people;
    for (int person = 0; person < 4; ++person)
        people.emplace_back([person] {
            for (int k = 0; k < kEach; ++k)
                Consent().agree("run " + std::to_string(person) + " " + std::to_string(k));
        });
    for (std::thread& one : people) one.join();
    for (int person = 0; person < 4; ++person)
        for (int k = 0; k < kEach; ++k)
            CHECK(
                Consent().has_agreed_to("run " + std::to_string(person) + " " + std::to_string(k)));
}

TEST_CASE("an option of the command line is a word for one run alone", "[consent]") {
    const Machine machine;
    const auto file = machine.folder / "settings.toml";
    Settings started = machine.file("");
    started.stability = false;
    TaskGroup tasks;
    TaskQueue writing(tasks);
    SettingsSaver keeper({}, started, file, writing);
    Settings now = started;
    now.mute = true;
    keeper.finish(now);
    writing.finish(std::chrono::seconds(60));
    CHECK_FALSE(std::filesystem::exists(consent_path()));
    CHECK(load_settings(file).stability);
}

TEST_CASE("a value that a person changes, or gives on the command line, is not asked about",
          "[consent]") {
    const Machine machine;
    Settings now =
        machine.file("[touch]\nstability = false\n[device]\nmax-force = 8.0\n[falcon]\ngear = 5\n");
    std::vector<UnsafeSetting> unsafe_settings = machine.consent.replace_unsafe(now);
    REQUIRE(unsafe_settings.size() == 3);
    drop_changed(unsafe_settings, now);
    CHECK(unsafe_settings.size() == 3);
    now.stability = false;
    now.max_force_newton = 3.0;
    drop_changed(unsafe_settings, now);
    REQUIRE(unsafe_settings.size() == 1);
    CHECK(unsafe_settings[0].name == "gear");
}

TEST_CASE("whoever keeps the usual values finds them in the file", "[consent]") {
    const Machine machine;
    const auto file = machine.folder / "settings.toml";
    const Settings in_file =
        machine.file("[device]\nmax-force = 8.0\n[touch]\nstiffness = 0.4\n[sound]\nmute = true\n");
    Settings started = in_file;
    const std::vector<UnsafeSetting> unsafe_settings = machine.consent.replace_unsafe(started);
    TaskGroup tasks;
    TaskQueue writing(tasks);
    SettingsSaver keeper(in_file, started, file, writing);
    keeper.finish(started);
    writing.finish(std::chrono::seconds(60));
    CHECK(load_settings(file).max_force_newton > 7.9);  // no answer yet
    keeper.use_defaults(unsafe_settings);
    keeper.finish(started);
    writing.finish(std::chrono::seconds(60));
    const Settings kept = load_settings(file);
    CHECK(same_settings(kept, started));
    CHECK(kept.mute);
    CHECK_FALSE(std::filesystem::exists(consent_path()));
}

TEST_CASE("whoever closes the question says nothing, and a replay has none to close", "[consent]") {
    ViewerState state;
    state.ui.unsafe_settings.resize(2);
    state.ui.help_open = true;
    state.touch.replay.emplace();
    CHECK(close_topmost(state));
    CHECK(state.ui.unsafe_settings.size() == 2);
    CHECK_FALSE(state.ui.help_open);
    state.touch.replay.reset();
    CHECK(close_topmost(state));
    CHECK(state.ui.unsafe_settings.empty());
    CHECK(state.commands.empty());
    CHECK_FALSE(close_topmost(state));
}

TEST_CASE("a command is known as it was agreed to, to the last byte, and is seen whole",
          "[consent]") {
    const Machine machine;
    const std::string agreed = "env -C ~/MiDaS run {frames} {output}";
    machine.consent.agree(agreed);
    CHECK(Consent().has_agreed_to(agreed));
    const std::string other = GENERATE_COPY(
        as<std::string>(), "", agreed + " ", ' ' + agreed, agreed + '\n', agreed + ";x",
        "env -C ~/MiDaS run  {frames} {output}", "env -C ~/MiDaS run\t{frames} {output}",
        "env -C ~/MiDa\xd0\x85 run {frames} {output}", agreed + std::string(1, '\0'),
        agreed + "\xe2\x80\xae", agreed + "\xe2\x80\x8b", agreed + "\x1b[2K", agreed + "\x7f",
        agreed + "\b\b\b", agreed + "\r# harmless", agreed + "\ndevice.max-force 8",
        "env -C \\x7e/MiDaS run {frames} {output}", "env -C ~\\/MiDaS run {frames} {output}",
        "env -C ~/midas run {frames} {output}", agreed + std::string(5000, ' ') + "x",
        "sh -c \"rm -rf ~\" {frames} {output}");
    CAPTURE(other);
    Settings sent;
    sent.estimators = {{"mine", other, {}}};
    save_settings(sent, machine.folder / "sent.toml");
    CHECK(load_settings(machine.folder / "sent.toml").estimators == sent.estimators);
    CHECK_FALSE(Consent().has_agreed_to(other));
    const std::string seen = escaped_text(other);
    CHECK(seen != escaped_text(agreed));
    CHECK(std::all_of(seen.begin(), seen.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    machine.consent.agree(other);
    CHECK(Consent().has_agreed_to(other));
    Settings settings = machine.file("[device]\nmax-force = 8.0\n");
    CHECK(Consent().replace_unsafe(settings).size() == 1);  // no command is a line of another kind
}

TEST_CASE("a study that has stability or the hand's damping off is asked about", "[consent]") {
    const Machine machine;
    const auto doubted = [&](const Protocol& protocol) {
        return records_of(unsafe_settings_of(protocol, machine.consent));
    };
    const std::vector<std::string> stability{"touch.stability false"};
    const std::vector<std::string> damping{"touch.damping-as-needed false"};
    CHECK(doubted(study_with({})).empty());
    CHECK(doubted(study_with({.words = {{"stability", "on"}}}, "friction")).empty());
    CHECK(doubted(study_with({.words = {{"stability", "off"}}})) == stability);
    CHECK(doubted(study_with({.numbers = {{"damping", 0.0}}})) == damping);
    CHECK(doubted(study_with({.numbers = {{"damping-cutoff", 0.0}}})) == damping);
    CHECK(doubted(study_with({}, "damping")) == damping);
    machine.consent.agree(
        unsafe_settings_of(study_with({.words = {{"stability", "off"}}}), machine.consent));
    CHECK(doubted(study_with({.words = {{"stability", "off"}}}, "damping")) == damping);
}
