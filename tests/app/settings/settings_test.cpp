// The settings file: what it keeps, and what happens to one that is wrong.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <filesystem>
#include <iterator>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/keys.hpp"
#include "app/settings/settings.hpp"
#include "app/viewer/files.hpp"
#include "app/viewer/input.hpp"
#include "core/error.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/player.hpp"
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
    settings.material = "my \"old\" oak";
    settings.touch.friction = {0.7, 0.3};
    settings.touch.coupling.damping_cutoff_hz = 62.5;
    settings.cleaning.own.fill_holes = false;
    settings.look.light = 0.125;
    settings.straight_view = true;
    settings.others = true;
    settings.screenshot_name.text = "shots/\"{file}\" 100%% {frame}";
    settings.max_force_newton = 2.5;
    settings.sound_volume = 0.25;
    settings.mute = true;
    return settings;
}

}  // namespace

TEST_CASE("settings come back exactly as they were saved", "[settings]") {
    const TemporaryFolder folder;
    const auto file = folder / "new/settings.toml";
    save_settings(unusual_settings(), file);
    std::vector<std::string> warnings;
    CHECK(same_settings(load_settings(file, warnings), unusual_settings()));
    CHECK(warnings.empty());
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
    CHECK(text.find("mend or delete") != std::string::npos);
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
    SettingsKeeper keeper(in_file, started, file);
    Settings now = started;
    keeper.finish(now);
    CHECK_FALSE(std::filesystem::exists(file));
    now.touch.friction = {0.9, 0.9};
    keeper.look(now, 1.0);
    CHECK_FALSE(std::filesystem::exists(file));
    keeper.look(now, 3.5);
    const Settings saved = load_settings(file);
    CHECK_THAT(saved.touch.shape.relief_px, WithinAbs(100.0, 1e-12));
    CHECK_THAT(saved.touch.friction.static_coefficient, WithinAbs(0.9, 1e-12));
}

TEST_CASE("no key does two things, and every job is on the help sheet", "[keys]") {
    for (const KeyBinding& one : key_bindings()) {
        for (const char c : one.characters) {
            CAPTURE(c);
            CHECK(action_of_character(static_cast<unsigned>(c)) == one.action);
        }
        for (const int key : one.keys) {
            CAPTURE(key);
            if (key == 0) continue;
            CHECK(action_of_key(key, one.with_control, false, false, one.with_shift) == one.action);
        }
        bool shown = false;
        for (const KeyBinding& other : key_bindings()) {
            shown = shown ||
                    (other.action == one.action && !other.shown.empty() && !other.help.empty());
        }
        CHECK(shown);
    }
}

TEST_CASE("one key takes the force off, also while text is typed, and never puts it on", "[keys]") {
    bool reachable = false;
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.action == Action::force_off) reachable = reachable || binding.while_typing;
    }
    CHECK(reachable);
    Player player;
    ViewerState state;
    perform(Action::force_off, state, player);
    CHECK_FALSE(state.force_enabled);
    perform(Action::force_off, state, player);
    CHECK_FALSE(state.force_enabled);
}

TEST_CASE("a key held down does not switch anything again and again", "[keys]") {
    CHECK(action_of_character('F') == Action::toggle_force);
    CHECK_FALSE(action_of_character('F', true));
    CHECK_FALSE(action_of_character('s', true));
    CHECK(action_of_character('.', true) == Action::step_forward);
}

TEST_CASE("Shift makes a seek small, and takes nothing from the other keys", "[keys]") {
    const auto pressed = [](int key, bool shift) {
        return action_of_key(key, false, false, false, shift);
    };
    CHECK(pressed(GLFW_KEY_RIGHT, false) == Action::seek_forward);
    CHECK(pressed(GLFW_KEY_RIGHT, true) == Action::seek_forward_little);
    CHECK(pressed(GLFW_KEY_LEFT, true) == Action::seek_back_little);
    CHECK(pressed(GLFW_KEY_F8, true) == Action::force_off);
}

TEST_CASE("the speed goes by a tenth or by two, within bounds, and never past the normal one",
          "[keys]") {
    Player player;
    ViewerState state;
    const auto told = [&](Action action, double speed) {
        state.playback.speed = speed;
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
    for (const KeyBinding& binding : key_bindings()) {
        const bool of_program = binding.group == "Program";  // it opens something that is seen
        const bool told_elsewhere =
            binding.action == Action::record || binding.action == Action::mark ||
            binding.action == Action::toggle_full_screen || binding.action == Action::explain ||
            binding.action == Action::copy_view || binding.action == Action::paste_view;
        if (of_program || told_elsewhere || binding.action == Action::show_as_recorded) continue;
        CAPTURE(std::string(binding.shown));
        const Answer answer = perform(binding.action, state, player);
        CHECK((answer.place || !answer.words.empty()));
    }
    state.media.still = true;
    CHECK(perform(Action::seek_forward, state, player).words == "A still picture: nothing plays");
}
