// `dibhr devices` and the start of the viewer, as the real program with simulated Falcons on its
// USB.
#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr::test;

namespace {

using Words = std::vector<std::string>;

struct Case {
    std::string what;
    Words host;       ///< options of the simulated bus
    Words arguments;  ///< of dibhr
    std::string says;
    std::string next_step;
};

ProgramResult run_with(const TemporaryFolder& folder, const Words& options,
                       const Words& arguments) {
    Words host{FALCON_HOST};
    host.insert(host.end(), options.begin(), options.end());
    host.emplace_back("--");
    return run_dibhr(folder, arguments, host);
}

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

long lines_of(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

void check_one_line(const ProgramResult& result, const Case& one) {
    INFO(one.what << ": " << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(lines_of(result.errors) == 1);
    CHECK(result.errors.starts_with("dibhr: "));
    CHECK(says(result.errors, one.says));
    CHECK(says(result.errors, one.next_step));
}

/// The other states and their sentences: tests/device/falcon/survey_test.cpp.
std::vector<Case> unusable_falcons() {
    return {
        {"no firmware", {}, {"devices"}, "no firmware", "--firmware FILE"},
        {"another serial, and no permission",
         {"--serial", "FALC-7", "--command", "refuse 13"},
         {"devices"},
         "FALC-7",
         "70-dibhr-falcon"},
    };
}

}  // namespace

TEST_CASE("a Falcon that cannot be used is told with its next step, and the command ends with 1",
          "[falcon][devices]") {
    const TemporaryFolder folder;
    for (const Case& one : unusable_falcons()) {
        const ProgramResult result = run_with(folder, one.host, one.arguments);
        check_one_line(result, one);
        INFO(result.output);
        // One each for the mouse, the Falcon and the Inverse3; nothing on devices whose maker's
        // library is not installed.
        CHECK(lines_of(result.output) == 3);
        CHECK(says(result.output, "mouse: usable"));
        CHECK(says(result.output, one.says));
        CHECK(says(result.output, one.next_step));
    }
}

TEST_CASE("a homed Falcon is usable, and another one beside it may lack what it likes",
          "[falcon][devices]") {
    const TemporaryFolder folder;
    const ProgramResult result = run_with(folder,
                                          {"--serial", "SIM00001", "--serial", "SIM00002",
                                           "--command", "firmware", "--command", "home"},
                                          {"devices"});
    CHECK(result.exit_code == 0);
    CHECK(result.errors.empty());
    CHECK(says(result.output, "Novint Falcon SIM00001"));
    CHECK(says(result.output, "usable, ready to touch"));
    CHECK(says(result.output, "SIM00002"));
}

TEST_CASE("firmware that is given once is loaded, kept, and loaded again after the power was off",
          "[falcon][devices]") {
    const TemporaryFolder folder;
    write_firmware(folder / "firmware.bin");
    const ProgramResult first = run_with(folder, {}, {"devices", "--firmware", "firmware.bin"});
    CHECK(says(first.errors, "homing"));
    CHECK(read_text(folder / "dibhr/falcon-firmware.bin") == read_text(folder / "firmware.bin"));
    const ProgramResult second =
        run_with(folder, {}, {"devices"});  // a unit without firmware again
    CHECK(says(second.errors, "homing"));
}

TEST_CASE("a file that is no firmware is refused with its reason, and nothing is kept",
          "[falcon][devices]") {
    const TemporaryFolder folder;
    write_text(folder / "text.bin", "this is no firmware");
    const auto [command, file] =
        GENERATE(table<std::string, std::string>({{"devices", "text.bin"}, {"view", "."}}));
    const ProgramResult result = run_with(folder, {}, {command, "--firmware", file});
    check_one_line(result, {file, {}, {}, file, "nvent_firmware.bin"});
    CHECK_FALSE(std::filesystem::exists(folder / "dibhr/falcon-firmware.bin"));
}

TEST_CASE("the viewer refuses a Falcon that it cannot open in one line, before there is a window",
          "[falcon][view]") {
    const TemporaryFolder folder;
    const Words two{"--serial", "SIM00001", "--serial", "SIM00002"};
    const Words falcon{"view", "--device", "falcon"};
    const std::vector<Case> cases{
        {"two, and none chosen", two, falcon, "SIM00001, SIM00002", "falcon:SERIAL"},
        {"another one chosen",
         two,
         {"view", "--device", "falcon:SIM00003"},
         "SIM00003",
         "SIM00001, SIM00002"},
    };
    for (const Case& one : cases) {
        const ProgramResult result = run_with(folder, one.host, one.arguments);
        check_one_line(result, one);
        CHECK(result.output.empty());
    }
    const ProgramResult none = run_dibhr(folder, falcon);
    check_one_line(none, {"none", {}, {}, "no Novint Falcon is attached", "--device mouse"});
}

TEST_CASE("the serial of the settings chooses among several Falcons", "[falcon][view]") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "dibhr");
    write_text(folder / "dibhr/settings.toml", "[falcon]\nserial = \"SIM00002\"\n");
    const ProgramResult result = run_with(folder, {"--serial", "SIM00001", "--serial", "SIM00002"},
                                          {"view", "--device", "falcon"});
    CHECK(result.exit_code == 1);
    CHECK(says(result.errors, "display"));  // the program came to opening the window
}

TEST_CASE("falcon_host says how it is used: asked for, or after a wrong command line", "[falcon]") {
    const TemporaryFolder folder;
    const auto told = [&folder](const Words& options) {
        Words host{FALCON_HOST};
        host.insert(host.end(), options.begin(), options.end());
        return run_dibhr(folder, {}, host);
    };
    const ProgramResult help = told({"--help"});
    CHECK(help.exit_code == 0);
    CHECK(help.errors.empty());
    for (const char* word : {"Usage: ", "hand X Y Z [SECONDS]", "mm", "Examples"}) {
        CHECK(says(help.output, word));
    }
    struct Wrong {
        Words host;
        std::string reason;
    };
    for (const Wrong& wrong : {Wrong{{"--nonsense", "1"}, "no option is called --nonsense"},
                               Wrong{{"--serial", "A", "--socket"}, "name the program"},
                               Wrong{{}, "the program comes after --"}}) {
        const ProgramResult result = told(wrong.host);
        CHECK(result.exit_code == 2);
        CHECK(result.output.empty());
        CHECK(result.errors.starts_with(help.output));
        CHECK(says(result.errors, "falcon_host: "));
        CHECK(says(result.errors, wrong.reason));
    }
    const ProgramResult no_script = told({"--script", "none.txt", "--"});
    CHECK(no_script.exit_code == 1);
    CHECK(no_script.errors == "falcon_host: none.txt: cannot be read; give a file of commands\n");
}
