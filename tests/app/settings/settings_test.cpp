// The settings file: what is saved, and what happens to an invalid one.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <filesystem>
#include <future>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/commands/documentation.hpp"
#include "app/panels/viewer_state.hpp"
#include "app/settings/keys.hpp"
#include "app/settings/settings.hpp"
#include "app/viewer/files.hpp"
#include "app/viewer/input.hpp"
#include "core/error.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/playing/player.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

Settings unusual_settings() {
    Settings settings;
    settings.width = 900;
    settings.panels.touch = false;
    settings.panels_visible = false;
    settings.touch.shape.relief_px = 123.456789012345;
    settings.touch.algorithm = Algorithm::neighborhood;
    CHECK_FALSE(settings.touch.carry);
    settings.touch.carry = true;
    settings.material = "my \"old\" oak";
    settings.touch.friction = {0.7, 0.3};
    settings.touch.coupling.damping_cutoff_hz = 62.5;
    settings.cleaning.own.fill_holes = false;
    settings.relief_style.light = 0.125;
    settings.straight_view = true;
    settings.others = true;
    settings.screenshot_name.text = "shots/\"{file}\" 100%% {frame}";
    settings.max_force_newton = 2.5;
    settings.sound_volume = 0.25;
    settings.mute = true;
    settings.game_pad = false;
    settings.open_with = OpenWith::desktop;
    settings.keys = {{"play-or-pause", {"Space"}},
                     {"mark", {"F7", "Shift+\"", "\\"}},
                     {"toggle-sound", {}},
                     {"no-action", {"F5", "no\nkey"}}};
    return settings;
}

std::optional<Action> pressed(const KeyTable& keys, const Key& key) {
    return key.typed ? keys.action_of_character(static_cast<unsigned>(key.code), false, key.shift)
                     : keys.action_of_key(key.code, key.control, false, false, key.shift);
}

}  // namespace

TEST_CASE("no two settings are kept in one place, and none has the name of another one",
          "[settings]") {
    Settings settings;
    std::set<const void*> places;
    std::set<std::string> names;
    for (const Setting& setting : all_settings(settings)) {
        const std::string name = std::string(setting.table) + "." + std::string(setting.name);
        CAPTURE(name);
        CHECK(names.insert(name).second);
        const void* const place =
            std::visit([](const auto& value) -> const void* { return &*value; }, setting.value);
        CHECK(places.insert(place).second);
    }
    CHECK(places.size() > 100);
}

TEST_CASE("settings come back exactly as they were saved", "[settings]") {
    const TemporaryFolder folder;
    const auto file = folder / "new/settings.toml";
    save_settings(unusual_settings(), file);
    std::vector<std::string> warnings;
    CHECK(same_settings(load_settings(file, warnings), unusual_settings()));
    CHECK(warnings.size() == 2);  // about keys
    CHECK(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}) == 1);
}

TEST_CASE("a folder that cannot be made is named when settings are not kept", "[settings]") {
    const TemporaryFolder folder;
    write_text(folder / "home", "no folder");
    const auto place = folder / "home/dibhr";
    std::string said;
    try {
        save_settings({}, place / "settings.toml");
    } catch (const InputError& error) {
        said = error.what();
    }
    CHECK(said == "the settings are not kept: the folder " + place.string() +
                      " cannot be written (Not a directory); make it writable");
}

TEST_CASE("a settings file that does not exist gives the defaults", "[settings]") {
    const TemporaryFolder folder;
    CHECK(same_settings(load_settings(folder / "settings.toml"), Settings{}));
}

TEST_CASE("each setting that does not fit keeps its default and is told with file and line",
          "[settings]") {
    const TemporaryFolder folder;
    const auto file = folder / "settings.toml";
    const std::string wrong = GENERATE(
        "[touch]\nstiffness = -1.0", "[touch]\nstiffness = 'hard'", "[touch]\nsoftness = 1.0",
        "[touch]\nstiffness = nan", "[touch]\ndamping-cutoff = 801", "[window]\nwidth = 3",
        "[panels]\nvideo = 1", "[cleaning]\nfill-holes = 0.5", "#\nflavour = 1", "#\ntouch = 3",
        "[window]\nscreenshot-name = \"%Q\"");
    CAPTURE(wrong);
    write_text(file, wrong + "\n[device]\nmax-force = 3.5\n");
    std::vector<std::string> warnings;
    const Settings settings = load_settings(file, warnings);
    Settings expected;
    expected.max_force_newton = 3.5;
    CHECK(same_settings(settings, expected));
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find(file.string() + ":2: ") == 0);
}

TEST_CASE("what is said of a settings file is one line, whatever the file holds", "[settings]") {
    const TemporaryFolder folder;
    const auto file = folder / "settings.toml";
    std::vector<std::string> warnings;
    write_text(file, "[touch]\n\"soft\\nness\\u001b[31m\" = 1\n");
    static_cast<void>(load_settings(file, warnings));
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find_first_of("\n\x1b") == std::string::npos);
    write_text(file, "[panels]\nvideo = tru\nesurface = false\n");
    try {
        static_cast<void>(load_settings(file, warnings));
        FAIL("it was understood");
    } catch (const InputError& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
    }
}

TEST_CASE("an integer is a number, for who types 1 and means 1.0", "[settings]") {
    const TemporaryFolder folder;
    const auto file = folder / "settings.toml";
    write_text(file, "[touch]\nstiffness = 1\n");
    std::vector<std::string> warnings;
    CHECK_THAT(load_settings(file, warnings).touch.coupling.stiffness_newton_per_mm,
               WithinAbs(1.0, 1e-12));
    CHECK(warnings.empty());
}

TEST_CASE("a settings file that cannot be understood is an error that names it, and is left alone",
          "[settings]") {
    const TemporaryFolder folder;
    const auto file = folder / "settings.toml";
    const std::string broken = "[touch\nstiffness = = 3";
    write_text(file, broken);
    std::string text;
    try {
        static_cast<void>(load_settings(file));
    } catch (const InputError& error) {
        text = error.what();
    }
    CHECK(text.find(file.string()) != std::string::npos);
    CHECK(text.find("correct or delete") != std::string::npos);
    CHECK(text.find('\n') == std::string::npos);
    CHECK(read_text(file) == broken);
}

TEST_CASE("a folder in the settings file's place is an error that names it", "[settings]") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(load_settings(folder.path()), InputError);
}

TEST_CASE("only what a person changed in the window gets into the file", "[settings]") {
    const TemporaryFolder folder;
    const auto file = folder / "settings.toml";
    Settings in_file;
    in_file.touch.shape.relief_px = 100.0;
    Settings started = in_file;
    started.touch.shape.relief_px = 300.0;  // the command line's
    TaskGroup tasks;
    TaskQueue writing(tasks);
    SettingsSaver keeper(in_file, started, file, writing);
    Settings now = started;
    keeper.finish(now);
    writing.finish(std::chrono::seconds(60));
    CHECK_FALSE(std::filesystem::exists(file));
    now.touch.friction = {0.9, 0.9};
    keeper.poll(now, 1.0);
    CHECK_FALSE(std::filesystem::exists(file));
    keeper.poll(now, 3.5);
    writing.finish(std::chrono::seconds(60));
    const Settings saved = load_settings(file);
    CHECK_THAT(saved.touch.shape.relief_px, WithinAbs(100.0, 1e-12));
    CHECK_THAT(saved.touch.friction.static_coefficient, WithinAbs(0.9, 1e-12));
}

TEST_CASE("what is to last is written in order, and whoever asks for it waits for no disk",
          "[settings]") {
    TaskGroup tasks;
    TaskQueue writing(tasks);
    std::promise<void> disk;
    std::vector<int> written;  // by threads that run one after the other
    writing.add([&, answers = disk.get_future().share()] {
        answers.wait();
        written.push_back(1);
    });
    writing.add([&] {
        written.push_back(2);
        throw InputError("no room");
    });
    writing.add([&] { written.push_back(3); });
    writing.poll();
    CHECK(writing.done_so_far().wait_for(std::chrono::seconds(0)) == std::future_status::timeout);
    CHECK_THROWS_AS(writing.finish(std::chrono::seconds(0)), InputError);  // the task hangs
    disk.set_value();
    CHECK_THROWS_AS(writing.finish(std::chrono::seconds(60)), InputError);
    writing.finish(std::chrono::seconds(60));
    CHECK(written == std::vector{1, 2, 3});
    CHECK(tasks.wait_all(std::chrono::seconds(60)));
}

TEST_CASE("no key does two things, and every job is on the help sheet", "[keys]") {
    const KeyTable keys;
    std::set<Action> actions;
    std::set<std::string_view> names;
    for (const KeyJob& job : key_jobs()) {
        CAPTURE(std::string(job.name));
        CHECK_FALSE(job.help.empty());
        CHECK_FALSE(keys.keys_for(job.action).empty());
        CHECK(job_of(job.action).name == job.name);
        actions.insert(job.action);
        names.insert(job.name);
        for (const Key& key : keys.keys_for(job.action)) {
            CAPTURE(name_of(key));
            if (!job.held) CHECK(pressed(keys, key) == job.action);
        }
    }
    CHECK(actions.size() == kActions);
    CHECK(names.size() == kActions);
}

TEST_CASE("a key is read as it is written, capital or small, and as nothing else", "[keys]") {
    for (const KeyJob& job : key_jobs()) {
        const KeyTable keys;
        for (const Key& key : keys.keys_for(job.action)) {
            CAPTURE(name_of(key));
            CHECK(key_named(name_of(key)) == key);
        }
    }
    for (const std::string name : {"Ctrl+Shift+F12", "Page up", "Shift+Page down", "F24", "Shift+G",
                                   "Ctrl+[", "+", "#", "Ctrl+Shift+Space", "\u00e4", "\u0444"}) {
        CAPTURE(name);
        const auto key = key_named(name);
        REQUIRE(key);
        CHECK(name_of(*key) == name);
    }
    CHECK(key_named("ctrl + r") == key_named("Ctrl+R"));
    CHECK(key_named("pageUp") == key_named("Page up"));
    CHECK(key_named("g") == key_named("G"));
    for (const char* const wrong :
         {"", " ", "Spcae", "Ctrl+", "Shift+", "Alt+X", "F0", "F25", "Shift+[", "Ctrl+{",
          "Shift+Ctrl+R", "ab", "\n", "\xc3", "\xa4"}) {
        CAPTURE(wrong);
        CHECK_FALSE(key_named(wrong));
    }
}

TEST_CASE("a person's own keys take the place of the usual ones, and are lost to what had them",
          "[keys]") {
    const std::vector<OwnKeys> own{{"play-or-pause", {"F5", "F"}},
                                   {"toggle-sound", {}},
                                   {"mark", {"Shift+L"}},
                                   {"show-as-recorded", {"F6"}},
                                   {"record", {"ctrl+shift+r"}}};
    std::vector<std::string> complaints;
    const KeyTable keys(own, &complaints);
    CHECK(complaints == std::vector<std::string>(own.size()));
    CHECK(pressed(keys, *key_named("F5")) == Action::play_or_pause);
    CHECK(pressed(keys, *key_named("F")) == Action::play_or_pause);
    CHECK_FALSE(pressed(keys, *key_named("Space")));
    CHECK_FALSE(pressed(keys, *key_named("U")));
    CHECK(keys.names_for(Action::toggle_force) == "no key");
    CHECK(keys.names_for(Action::toggle_sound) == "no key");
    CHECK(keys.names_for(Action::play_or_pause) == "F5 or F");
    CHECK(pressed(keys, *key_named("Shift+L")) == Action::mark);
    CHECK(pressed(keys, *key_named("L")) == Action::toggle_loop);
    CHECK(keys.held_keys(Action::show_as_recorded) == std::vector<int>{GLFW_KEY_F6});
    CHECK(pressed(keys, *key_named("Ctrl+Shift+R")) == Action::record);
    CHECK_FALSE(pressed(keys, *key_named("Ctrl+R")));
    CHECK(pressed(keys, *key_named("S")) == Action::take_screenshot);
}

TEST_CASE("wherever a key is named it is the person's own, and none where there is none",
          "[keys]") {
    Player player;
    ViewerState state;
    state.keys = KeyTable(std::vector<OwnKeys>{{"toggle-panels", {"F4"}}, {"loop-part", {}}});
    CHECK(perform(Action::toggle_panels, state, player).words == "Panels hidden: F4 shows them");
    CHECK(perform(Action::loop_part, state, player).words == "Loop from 00:00.000");
    CHECK(state.keys.in_brackets(Action::toggle_panels) == " (F4)");
    CHECK(state.keys.in_brackets(Action::step_forward) == " ( . )");
    CHECK(state.keys.in_brackets(Action::loop_part).empty());
    CHECK(contains(keys_help(state.keys), "F4"));
}

TEST_CASE("a wish for a key that cannot be is told with file and line, and the rest holds",
          "[keys]") {
    const TemporaryFolder folder;
    const auto file = folder / "settings.toml";
    const auto [wrong, said] = GENERATE(table<std::string, std::string>(
        {{"plai = \"F5\"", "keys.plai is not an action: dibhr help keys lists them"},
         {"\"a b\" = \"F5\"", "keys.a b is not an action: dibhr help keys lists them"},
         {"mark = \"Spcae\"",
          "keys.mark names 'Spcae', which is not a key: write one as dibhr help keys does, like "
          "Space or Ctrl+R; the default keys stay"},
         {"mark = [\"F5\", \"\"]",
          "keys.mark names '', which is not a key: write one as dibhr help keys does, like Space "
          "or "
          "Ctrl+R; the default keys stay"},
         {"mark = \"F7\"",
          "keys.mark names 'F7', which is already for record: choose another one; the default keys "
          "stay"},
         {"mark = \"Shift+F8\"",
          "keys.mark names 'Shift+F8', which always takes the force off: choose another one; the "
          "default keys stay"},
         {"show-as-recorded = \"Ctrl+B\"",
          "keys.show-as-recorded names 'Ctrl+B', which cannot be held: choose one key without "
          "Ctrl and Shift; the default keys stay"},
         {"force-off = \"\"",
          "keys.force-off cannot be without a key: F8 always takes the force off; remove the "
          "entry"},
         {"mark = 5",
          "keys.mark is neither a key in quotes nor a list of them; the default is kept"}}));
    CAPTURE(wrong);
    write_text(file,
               "[keys]\nrecord = \"F7\"\n" + wrong + "\nquit = \"F10\"\n[sound]\nmute = true\n");
    std::vector<std::string> warnings;
    const Settings settings = load_settings(file, warnings);
    CHECK(warnings == std::vector<std::string>{file.string() + ":3: " + said});
    CHECK(settings.mute);
    const KeyTable keys(settings.keys);
    CHECK(keys.names_for(Action::record) == "F7");
    CHECK(keys.names_for(Action::quit) == "F10");
    CHECK(keys.names_for(Action::mark) == "M");
    CHECK(keys.names_for(Action::show_as_recorded) == "B, held");
    // The invalid entry stays in the file until it is corrected.
    save_settings(settings, file);
    CHECK(same_settings(load_settings(file, warnings), settings));
}

TEST_CASE("one key takes the force off, also while text is typed, and never puts it on", "[keys]") {
    const std::vector<OwnKeys> own = GENERATE(
        std::vector<OwnKeys>{}, std::vector<OwnKeys>{{"mark", {"F8"}}, {"quit", {"Shift+F8"}}},
        std::vector<OwnKeys>{{"force-off", {}}},
        std::vector<OwnKeys>{{"force-off", {"X"}}, {"record", {"f8"}}});
    const KeyTable keys(own);
    for (const bool shift : {false, true})
        for (const bool typing : {false, true})
            CHECK(keys.action_of_key(GLFW_KEY_F8, false, typing, false, shift) ==
                  Action::force_off);
    CHECK(keys.name_for(Action::force_off) == "F8");
    Player player;
    ViewerState state;
    perform(Action::force_off, state, player);
    CHECK_FALSE(state.touch.force_enabled);
    perform(Action::force_off, state, player);
    CHECK_FALSE(state.touch.force_enabled);
}

TEST_CASE("what a text field takes does nothing else while it has the keyboard", "[keys]") {
    const KeyTable keys(std::vector<OwnKeys>{
        {"record", {"Delete", "F7", "Ctrl+V"}}, {"toggle-help", {"Left"}}, {"mark", {"F6"}}});
    const auto typing = [&keys](int key, bool control) {
        return keys.action_of_key(key, control, true);
    };
    CHECK(typing(GLFW_KEY_F7, false) == Action::record);
    CHECK_FALSE(typing(GLFW_KEY_DELETE, false));
    CHECK_FALSE(typing(GLFW_KEY_V, true));
    CHECK_FALSE(typing(GLFW_KEY_LEFT, false));
    CHECK_FALSE(typing(GLFW_KEY_F6, false));
    CHECK(keys.action_of_key(GLFW_KEY_DELETE, false, false) == Action::record);
}

TEST_CASE("a key held down does not switch anything again and again", "[keys]") {
    const KeyTable keys;
    CHECK(keys.action_of_character('F') == Action::toggle_force);
    CHECK_FALSE(keys.action_of_character('F', true));
    CHECK_FALSE(keys.action_of_character('s', true));
    CHECK(keys.action_of_character('.', true) == Action::step_forward);
}

TEST_CASE("Shift makes a seek small, and takes nothing from the other keys", "[keys]") {
    const KeyTable keys;
    CHECK(keys.action_of_key(GLFW_KEY_RIGHT, false, false) == Action::seek_forward);
    CHECK(pressed(keys, *key_named("Shift+Right")) == Action::seek_forward_little);
    CHECK(pressed(keys, *key_named("Shift+Left")) == Action::seek_back_little);
    CHECK(pressed(keys, *key_named("Shift+F8")) == Action::force_off);
    CHECK(keys.action_of_character('?', false, true) == Action::toggle_help);
}

TEST_CASE("the speed goes by a tenth or by two, within bounds, and never past the normal one",
          "[keys]") {
    Player player;
    ViewerState state;
    const auto told = [&](Action action, double speed) {
        state.media.playback.speed = speed;
        return perform(action, state, player).words;
    };
    CHECK(told(Action::faster, 1.0) == "Speed 1.1x");
    CHECK(told(Action::slower, 1.1) == "Speed 1x");
    CHECK(told(Action::faster, 0.95) == "Speed 1x");
    CHECK(told(Action::slower, 1.05) == "Speed 1x");
    CHECK(told(Action::double_speed, 0.25) == "Speed 0.5x");
    CHECK(told(Action::half_speed, 1.0) == "Speed 0.5x");
    CHECK(told(Action::double_speed, 3.0) == "Speed 4x");
    CHECK(told(Action::half_speed, 0.15) == "Speed 0.1x");
    CHECK(told(Action::normal_speed, 3.3) == "Speed 1x");
}

TEST_CASE("a key that changes how it plays, touches or looks says so", "[keys]") {
    Player player;
    ViewerState state;
    for (const KeyJob& job : key_jobs()) {
        const bool of_program = job.group == "Program";  // the effect is visible: no notice
        const bool told_elsewhere =
            job.action == Action::record || job.action == Action::mark ||
            job.action == Action::toggle_full_screen || job.action == Action::explain ||
            job.action == Action::copy_view || job.action == Action::paste_view ||
            job.action == Action::toggle_brush || job.action == Action::undo ||
            job.action == Action::redo || job.action == Action::turn_depth ||
            job.action == Action::touch_by_keys || job.action == Action::next_pane ||
            job.action == Action::previous_pane;
        if (of_program || told_elsewhere || job.action == Action::show_as_recorded) continue;
        CAPTURE(std::string(job.name));
        const Answer answer = perform(job.action, state, player);
        CHECK((answer.place || !answer.words.empty()));
    }
    state.media.still = true;
    CHECK(perform(Action::seek_forward, state, player).words == "A still picture: nothing plays");
}
